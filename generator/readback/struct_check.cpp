// Members, sizes, defaults and names.
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "readback/api.hpp"
#include "readback/header_check.hpp"
#include "readback/interpreter.hpp"
#include "readback/node_table.hpp"
#include "readback/struct_members.hpp"

namespace jourdain::readback {

namespace {

std::map<std::string, double> constants_of_model(const Expected& expected) {
  std::map<std::string, double> list = {{"position_count", double(expected.positions.size())},
                                        {"velocity_count", double(expected.velocities.size())},
                                        {"input_count", double(expected.inputs.size())},
                                        {"output_count", double(expected.outputs.size())},
                                        {"parameter_count", double(expected.parameters.size())}};
  if (expected.constraints.empty()) return list;
  list["constraint_count"] = double(expected.constraints.size());
  list["least_regularity"] = expected.least_regularity;
  list["greatest_opening"] = expected.greatest_opening;
  if (!expected.proven_positions.empty()) list["range_count"] = double(expected.proven_positions.size());
  return list;
}

void check_model_constants(const Unit& unit, const Struct& model, const Expected& expected,
                           Findings& findings) {
  std::map<std::string, double> wanted = constants_of_model(expected);
  NodeTable table;
  Interpreter run(unit, table);
  const Type* type = run.types().instance("Model", {{0, run.types().number(), 0}});
  for (const Member& member : model.members) {
    if (!member.is_static) continue;
    const std::string name = unit.symbols.text(member.declarator.name), kind = text_of(unit, member.type);
    const auto it = wanted.find(name);
    if (it == wanted.end()) {
      findings.add("Model has a constant {}", name);
      continue;
    }
    const Value found = run.constant(type, name);
    const bool is_integer = name.ends_with("_count");
    findings.expect("type of " + name, kind, is_integer ? "int" : "double");
    findings.expect(name, found.kind == Value::Kind::kInteger ? double(found.integer) : found.native,
                    it->second);
    wanted.erase(it);
  }
  for (const auto& [name, value] : wanted) findings.add("Model has no constant {}", name);
}

void check_aliases(const Unit& unit, const Struct& model, const Expected& expected, Findings& findings) {
  std::map<std::string, std::string> wanted = {{"Scalar", "Real"}}, found;
  for (const char* name : {"Parameters", "State", "Input"})
    wanted[name] = fmt::format("{}::{}<Real>", expected.name, name);
  if (!expected.outputs.empty()) wanted["Outputs"] = expected.name + "::Outputs<Real>";
  if (!expected.user_functions().empty()) wanted["Functions"] = expected.name + "::Functions<Real>";
  if (linearizes(expected)) wanted["Linearization"] = expected.name + "::Linearization<Real>";
  for (const auto& [name, type] : model.aliases) found[unit.symbols.text(name)] = text_of(unit, type);
  findings.expect("types of Model", fmt::format("{}", fmt::join(found, "; ")),
                  fmt::format("{}", fmt::join(wanted, "; ")));
}

void check_model(const Unit& unit, const Struct& model, const Expected& expected, Findings& findings) {
  findings.expect("template parameters of Model", template_text(unit, model), "class Real = double");
  check_model_constants(unit, model, expected, findings);
  check_aliases(unit, model, expected, findings);
  Texts functions, wanted = {"explicit Model(const Parameters& = {}) noexcept"};
  for (const Function* function : model.functions) {
    std::string text;
    for (const Parameter& parameter : function->parameters) {
      const Expression* standard = parameter.declarator.initial;
      const bool is_empty =
          standard && standard->kind == ExpressionKind::kList && standard->arguments.empty();
      text += text_of(unit, parameter.type, parameter.declarator) + (is_empty   ? " = {}"
                                                                     : standard ? " = …"
                                                                                : "");
    }
    functions.push_back(
        fmt::format("{}{}{}({}){}", function->is_explicit ? "explicit " : "",
                    function->is_static ? "static " + text_of(unit, function->result) + " " : "",
                    unit.symbols.text(function->name), text, function->is_noexcept ? " noexcept" : ""));
  }
  if (!expected.constraints.empty()) wanted.push_back("static bool loops_closed(const State&) noexcept");
  if (!expected.proven_parameters.empty())
    wanted.push_back("static bool loops_proven(const Parameters&) noexcept");
  findings.expect("functions of Model", fmt::format("{}", fmt::join(functions, "; ")),
                  fmt::format("{}", fmt::join(wanted, "; ")));
}

/// Default values of an object's scalars, as literals.
void check_defaults(const Unit& unit, const Expected& expected, Findings& findings) {
  NodeTable table;
  Interpreter run(unit, table);
  const Value parameters = run.make(run.types().instance("Parameters", {{0, run.types().number(), 0}}));
  for (std::size_t i = 0; i < expected.parameters.size(); ++i) {
    const Cell& found = run.cell(run.field(parameters, expected.parameters[i].name));
    if (found != number_cell(table.literal(expected.parameters[i].value)))
      findings.add("default of parameter {} is not {}", expected.parameters[i].name,
                   expected.parameters[i].value);
  }
  for (const char* name : {"RateHistory", "Accelerations"})
    for (const Struct* known : unit.structs) {
      if (unit.symbols.text(known->name) != name) continue;
      Bindings bindings = {{0, run.types().number(), 0}};
      if (known->parameters_of_template.size() == 2)
        bindings.insert(bindings.begin(), Binding{0, nullptr, 2});
      const Value object = run.make(run.types().instance(name, bindings));
      if (run.cell(object) != integer_cell(0)) findings.add("a fresh {} does not count from 0", name);
      for (std::size_t i = 1; i < object.type->cells; ++i)
        if (run.cell(object, i) != number_cell(table.literal(0.0)))
          findings.add("a fresh {} is not zero", name);
    }
}

void check_names(const Unit& unit, const Expected& expected, Findings& findings) {
  const std::vector<std::pair<std::string, Texts>> wanted = name_arrays(expected);
  std::size_t next = 0;
  for (const Constant* constant : unit.constants) {
    if (!constant->scope.empty()) continue;  // check_indices, check_programs
    const std::string name = unit.symbols.text(constant->declarator.name);
    if (next == wanted.size() || name != wanted[next].first || !constant->is_inline) {
      findings.add("the constant {} does not belong there", name);
      continue;
    }
    Texts texts = wanted[next++].second, found;
    findings.expect("type of " + name, text_of(unit, constant->type, constant->declarator),
                    fmt::format("const char*[{}]", texts.size() + 1));
    texts.push_back("nullptr");
    if (const Expression* list = constant->declarator.initial)
      for (const Expression* entry : list->arguments)
        found.push_back(entry->kind == ExpressionKind::kString ? unquoted(entry->text)
                        : entry->kind == ExpressionKind::kNull ? "nullptr"
                                                               : "?");
    findings.expect(name, fmt::format("{}", fmt::join(found, "; ")),
                    fmt::format("{}", fmt::join(texts, "; ")));
  }
  if (next != wanted.size()) findings.add("{} is missing", wanted[next].first);
}

void check_files(const Unit& unit, const Expected& expected, Findings& findings) {
  std::vector<Texts> wanted = {
      {"#pragma once", "#ifndef JOURDAIN_FUNCTION", "#define JOURDAIN_FUNCTION", "#endif"},
      {"#pragma once", "#include <math.h>", fmt::format("#include \"{}.hpp\"", expected.name)},
      {std::begin(kNarrowVectors), std::end(kNarrowVectors)}};
  if (std::any_of(unit.instantiations.begin(), unit.instantiations.end(),
                  [](const Function* function) { return function->has_stages; }))
    wanted[2].insert(wanted[2].end(), std::begin(kStages), std::end(kStages));
  wanted[2].push_back(fmt::format("#include \"{}_kernels.hpp\"", expected.name));
  if (!expected.user_functions().empty())
    wanted[2].push_back(fmt::format("#include \"{}_functions.hpp\"", expected.name));
  findings.expect("namespace", unit.name_of_namespace, expected.name);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    findings.expect("directives of " + unit.files[i], fmt::format("{}", fmt::join(unit.directives[i], "; ")),
                    fmt::format("{}", fmt::join(wanted[i], "; ")));
}

}  // namespace

std::vector<std::pair<std::string, std::vector<std::string>>> name_arrays(const Expected& expected) {
  std::vector<std::pair<std::string, Texts>> wanted = {{"position_names", expected.positions},
                                                       {"velocity_names", expected.velocities}};
  if (!expected.constraints.empty()) wanted.emplace_back("constraint_names", expected.constraints);
  Texts outputs, parameters;
  for (const ExpectedOutput& output : expected.outputs) outputs.push_back(output.name);
  for (const ExpectedParameter& parameter : expected.parameters) parameters.push_back(parameter.name);
  wanted.insert(
      wanted.end(),
      {{"input_names", expected.inputs}, {"output_names", outputs}, {"parameter_names", parameters}});
  return wanted;
}

void check_structs(const Unit& unit, const Expected& expected, Findings& findings) {
  check_files(unit, expected, findings);
  std::map<std::string, Texts> wanted = struct_members(expected);
  bool has_model = false;
  for (const Struct* found : unit.structs) {
    if (found->scope == "detail") continue;
    const std::string name = unit.symbols.text(found->name);
    if (!found->scope.empty()) findings.add("the struct {} does not belong into {}", name, found->scope);
    if (name == "Model") {
      if (std::exchange(has_model, true)) findings.add("Model once more");
      findings.guarded("Model", [&] { check_model(unit, *found, expected, findings); });
      continue;
    }
    const auto it = wanted.find(name);
    if (it == wanted.end()) {
      findings.add("the struct {} does not belong there", name);
      continue;
    }
    check_struct(unit, *found, it->second, findings);
    wanted.erase(it);
  }
  if (!has_model) findings.add("there is no Model");
  for (const auto& [name, members] : wanted) findings.add("there is no struct {}", name);
  findings.guarded("defaults", [&] { check_defaults(unit, expected, findings); });
  check_names(unit, expected, findings);
}

}  // namespace jourdain::readback
