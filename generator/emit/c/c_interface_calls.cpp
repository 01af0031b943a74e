#include "emit/c/c_interface_calls.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/c/c_variables.hpp"
#include "emit/parameters.hpp"
#include "programs/output_names.hpp"

namespace jourdain::emit::c {

namespace {

using programs::FunctionInfo;
using programs::Shape;
using PassedArray = InterfaceCalls::PassedArray;

PassedArray passed(const std::string& name, const std::vector<std::size_t>& extents) {
  return {name, extents[0], extents.size() > 1 ? extents[1] : 1, static_cast<int>(extents.size())};
}

std::string write_array(const PassedArray& array, const std::string& from, std::size_t result) {
  if (!array.is_matrix())
    return fmt::format("  write_numbers(results[{}], {}, {});\n", result, from, array.rows);
  return fmt::format("  for (i = 0; i < {}; ++i) write_numbers(results[{}] + i * {}, {}[i], {});\n",
                     array.rows, result, array.columns, from, array.columns);
}

std::string argument_rows(const std::vector<PassedArray>& list) {
  std::string text;
  for (const PassedArray& array : list)
    text += fmt::format("{}{{\"{}\", {}, {}, {}}}", text.empty() ? "" : ", ", array.name, array.rows,
                        array.columns, array.dimensions);
  return text;
}

}  // namespace

std::string InterfaceCalls::arguments(const FunctionInfo& function) const {
  std::string text = "&self->model, &self->state";
  if (function.takes_input) text += ", &self->input";
  return text;
}

std::vector<InterfaceCalls::PassedArray> InterfaceCalls::results(const FunctionInfo& function) const {
  const std::size_t ny = scene_.positions.size(), nz = scene_.velocities.size();
  std::vector<PassedArray> list;
  switch (function.shape) {
    case Shape::kScalar:
      return {{function.name}};
    case Shape::kVector:
      return {passed(function.result, {nz})};
    case Shape::kRate:
      return {passed(function.result, {ny})};
    case Shape::kMatrix:
      return {passed(function.result, {nz, nz})};
    case Shape::kOutputs:
      return {passed(function.name, {scene_.output_numbers()})};
    case Shape::kArrays:
    case Shape::kLinearization:
      for (const programs::ArrayResult& result : function.arrays)
        if (programs::has_entries(scene_, result))
          list.push_back(passed(result.name, extents_of(result, scene_)));
      return list;
    case Shape::kState:
    case Shape::kCorrection:
    case Shape::kSampling:
    case Shape::kStep:
      break;
  }
  return {};
}

std::string InterfaceCalls::call(const FunctionInfo& function) const {
  if (function.shape == Shape::kCorrection)
    return fmt::format(
        "static jourdain_status call_{0}(void *instance, const double *const *given, double *const *results) "
        "{{\n"
        "  (void)given;\n  (void)results;\n"
        "  return instance ? close_all(({1}_instance *)instance) : JOURDAIN_WRONG_CALL;\n}}\n\n",
        function.name, names_.file());
  const std::vector<PassedArray> list = results(function);
  const bool loops =
      std::any_of(list.begin(), list.end(), [](const PassedArray& a) { return a.is_matrix(); });
  std::string locals, after, finite, call = arguments(function);
  if (function.takes_acceleration) {
    locals += fmt::format("  {} zdot[{}];\n", names_.real(), scene_.velocities.size());
    call += ", zdot";
  }
  std::string invocation = fmt::format("  {}({}", names_.global(function.name), call);
  if (function.shape == Shape::kScalar) {
    invocation = fmt::format("  results[0][0] = (double){}({});\n", names_.global(function.name), call);
  } else if (function.shape == Shape::kOutputs || function.shape == Shape::kLinearization) {
    locals += fmt::format(
        "  {} result;\n",
        names_.type(struct_type(function.shape == Shape::kOutputs ? "Outputs" : "Linearization")));
    invocation += ", &result);\n";
    if (function.shape == Shape::kOutputs)
      after = output_numbers();
    else
      for (std::size_t k = 0; k < list.size(); ++k)
        after += write_array(list[k], "result." + list[k].name, k);
  } else {
    for (std::size_t k = 0; k < list.size(); ++k) {
      const PassedArray& array = list[k];
      locals += fmt::format("  {} {}_result[{}]{};\n", names_.real(), array.name, array.rows,
                            array.is_matrix() ? fmt::format("[{}]", array.columns) : "");
      invocation += fmt::format(", {}_result", array.name);
      after += write_array(array, array.name + "_result", k);
    }
    invocation += ");\n";
  }
  for (std::size_t k = 0; k < list.size(); ++k)
    finite += fmt::format("{}numbers_are_finite(results[{}], {})", finite.empty() ? "" : " && ", k,
                          list[k].numbers());
  std::string text = fmt::format(
      "static jourdain_status call_{0}(void *instance, const double *const *given, double *const *results) "
      "{{\n"
      "  {1}_instance *self = ({1}_instance *)instance;\n{2}{3}\n",
      function.name, names_.file(), locals, loops ? "  int i;\n" : "");
  std::string wrong = "!self";
  if (function.takes_acceleration) wrong += " || is_missing(given, 1)";
  if (!list.empty()) wrong += fmt::format(" || is_missing((const double *const *)results, {})", list.size());
  text += fmt::format("  if ({}) return JOURDAIN_WRONG_CALL;\n", wrong);
  if (function.takes_acceleration)
    text += fmt::format(
        "  if (!numbers_are_finite(given[0], {0})) return JOURDAIN_NOT_FINITE;\n"
        "  read_numbers(zdot, given[0], {0});\n",
        scene_.velocities.size());
  else
    text += "  (void)given;\n";
  if (list.empty()) text += "  (void)results;\n";
  return text + invocation + after +
         fmt::format("  return {} ? JOURDAIN_OK : JOURDAIN_NOT_FINITE;\n}}\n\n", finite);
}

std::string InterfaceCalls::output_numbers() const {
  std::string text;
  std::size_t k = 0;
  for (const programs::OutputFacts& output : scene_.outputs)
    for (const programs::OutputMember& member : output.members)
      for (const std::string& number : programs::number_names(output, member))
        text += fmt::format("  results[0][{}] = (double)result.{};\n", k++, number);
  return text;
}

std::string InterfaceCalls::argument_arrays() const {
  std::string text;
  for (const FunctionInfo& function : functions_) {
    if (!is_listed(function)) continue;
    if (function.takes_acceleration)
      text += fmt::format("static const jourdain_argument {}_given[] = {{{}}};\n", function.name,
                          argument_rows({passed("zdot", {scene_.velocities.size()})}));
    if (const std::vector<PassedArray> list = results(function); !list.empty())
      text += fmt::format("static const jourdain_argument {}_results[] = {{{}}};\n", function.name,
                          argument_rows(list));
  }
  return text;
}

std::string InterfaceCalls::row(const FunctionInfo& function) const {
  const std::size_t count = results(function).size();
  const ir::Program* program = ir::find_program(module_, function.name);
  return fmt::format("  {{\"{0}\", {1}, {2}, {3}, {4}, {5}, {6}, {7}L, call_{0}}},\n", function.name,
                     c_string(in_one_line(comment_of(function, scene_))), function.takes_acceleration ? 1 : 0,
                     count, function.takes_acceleration ? function.name + "_given" : "NULL",
                     count > 0 ? function.name + "_results" : "NULL", function.takes_input ? 1 : 0,
                     program ? ir::count_operations(*program).arithmetic() : 0);
}

}  // namespace jourdain::emit::c
