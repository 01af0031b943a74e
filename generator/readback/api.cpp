#include "readback/api.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace jourdain::readback {

namespace {

FunctionApi arrays(const std::string& name, std::vector<ArrayArgument> list, bool takes_input = false,
                   bool takes_acceleration = false) {
  FunctionApi api;
  api.name = name;
  api.arrays = std::move(list);
  api.takes_input = takes_input;
  api.takes_acceleration = takes_acceleration;
  return api;
}

FunctionApi returning(const std::string& name, Result result) {
  FunctionApi api;
  api.name = name;
  api.result = result;
  return api;
}

FunctionApi sparse(FunctionApi api) {
  api.sparse = true;
  const auto is_empty = [](const ArrayArgument& array) {
    return std::find(array.extents.begin(), array.extents.end(), std::size_t(0)) != array.extents.end();
  };
  api.arrays.erase(std::remove_if(api.arrays.begin(), api.arrays.end(), is_empty), api.arrays.end());
  return api;
}

FunctionApi in_struct(const std::string& name, const std::string& structure) {
  FunctionApi api = returning(name, Result::kStruct);
  api.structure = structure;
  api.takes_input = true;
  return api;
}

FunctionApi sampling() {
  FunctionApi api = returning("sample", Result::kSampling);
  api.takes_input = true;
  return api;
}

FunctionApi mass_matrix(std::size_t n) {
  FunctionApi api = arrays("mass_matrix", {{"M", {n, n}}});
  api.symmetric = true;
  return api;
}

std::vector<FunctionApi> programs(const Expected& expected) {
  const std::size_t n = expected.velocities.size(), y = n + expected.carried.size(),
                    u = expected.inputs.size(), g = expected.constraints.size();
  std::vector<ArrayArgument> derivatives = {{"M", {n, n}}, {"r_y", {n, y}}, {"r_z", {n, n}}, {"r_u", {n, u}}};
  if (expected.dynamics_depend_on_time) derivatives.push_back({"r_t", {n}});
  return {returning("initial_state", Result::kState),
          returning("kinetic_energy", Result::kNumber),
          returning("potential_energy", Result::kNumber),
          returning("close_loops", Result::kCorrection),
          returning("project", Result::kCorrection),
          sampling(),
          arrays("position_rate", {{"ydot", {expected.positions.size()}}}),
          mass_matrix(n),
          arrays("k_bar", {{"k", {n}}}, expected.motions_take_inputs),
          arrays("q_bar", {{"q", {n}}}, true),
          arrays("forward_dynamics", {{"zdot", {n}}}, true),
          arrays("inverse_dynamics", {{"tau", {n}}}, expected.motions_take_inputs, true),
          in_struct("outputs", "Outputs"),
          sparse(arrays("constraint_residual", {{"g", {g}}, {"g_rate", {g}}})),
          sparse(arrays("constraint_forces", {{"lambda", {g}}}, true)),
          sparse(arrays("residual", {{"r", {n}}}, true, true)),
          sparse(arrays("residual_derivatives", derivatives, true, true)),
          sparse(arrays("forward_dynamics_derivatives",
                        {{"zdot", {n}}, {"zdot_y", {n, y}}, {"zdot_z", {n, n}}}, true)),
          sparse(in_struct("linearize", "Linearization"))};
}

std::optional<FunctionApi> step(const std::string& name) {
  static const char* const explicit_steps[] = {"euler", "semi_implicit_euler", "heun", "rk4", "rk5"};
  static const char* const implicit_steps[] = {"linearly_implicit_euler", "ros34pw2", "rosw43", "rodas4"};
  FunctionApi api = returning(name, Result::kStep);
  api.takes_input = true;
  for (const char* method : explicit_steps)
    if (name == fmt::format("{}_step", method)) return api;
  api.implicit = true;
  for (const char* method : implicit_steps)
    if (name == fmt::format("{}_step", method)) return api;
  api.implicit = false;
  for (api.history = 1; api.history < 3; ++api.history)
    if (name == fmt::format("adams_bashforth{}_step", api.history + 1)) return api;
  return {};
}

}  // namespace

std::optional<FunctionApi> api_of(const std::string& name, const Expected& expected) {
  for (const FunctionApi& api : programs(expected))
    if (api.name == name) return api;
  for (const ExpectedKinematics& kinematics : expected.kinematics) {
    if (kinematics.name != name) continue;
    std::vector<ArrayArgument> list;
    for (const ExpectedArray& array : kinematics.arrays) list.push_back({array.name, array.extents});
    return sparse(arrays(name, std::move(list), kinematics.takes_input, kinematics.takes_acceleration));
  }
  return step(name);
}

std::string FunctionApi::signature(const Expected& expected, const std::string& real) const {
  const bool in_c = expected.choices.language == ir::Language::kC;
  const char sign = in_c ? '*' : '&';
  std::string list = fmt::format("const Model<{}>{}", real, sign);
  const auto add = [&list](const std::string& argument) { list += ", " + argument; };
  const bool changes =
      result == Result::kCorrection || result == Result::kSampling || result == Result::kStep;
  if (result != Result::kState) add(fmt::format("{}State<{}>{}", changes ? "" : "const ", real, sign));
  if (takes_input) add(fmt::format("const Input<{}>{}", real, sign));
  if (takes_acceleration) add(fmt::format("const {} (&)[{}]", real, expected.velocities.size()));
  if (result == Result::kStep || result == Result::kSampling) add(real);
  if (history > 0)
    add(in_c ? fmt::format("RateHistory{}<{}>*", history, real)
             : fmt::format("RateHistory<{}, {}>&", history, real));
  if (implicit) add(fmt::format("Accelerations<{}>{}", real, sign));
  for (const ArrayArgument& array : arrays) {
    std::string bounds;
    for (const std::size_t extent : array.extents) bounds += fmt::format("[{}]", extent);
    add(fmt::format("{} (&){}", real, bounds));
  }
  if (result == Result::kStruct) add(fmt::format("{}<{}>{}", structure, real, sign));
  const std::string returned = result == Result::kState    ? fmt::format("State<{}>", real)
                               : result == Result::kNumber ? real
                                                           : "void";
  return fmt::format("{} {}({}) noexcept", returned, name, list);
}

std::vector<std::string> FunctionApi::parameter_names() const {
  std::vector<std::string> names = {"model"};
  if (result != Result::kState) names.push_back("state");
  if (takes_input) names.push_back("input");
  if (takes_acceleration) names.push_back("zdot");
  if (result == Result::kStep || result == Result::kSampling) names.push_back("h");
  if (history > 0) names.push_back("history");
  if (implicit) names.push_back("accelerations");
  for (const ArrayArgument& array : arrays) names.push_back(array.name);
  if (result == Result::kStruct) names.push_back("result");
  return names;
}

std::size_t output_numbers(const Expected& expected) {
  std::size_t numbers = 0;
  for (const ExpectedOutput& output : expected.outputs)
    for (const ExpectedMember& member : output.members)
      numbers += static_cast<std::size_t>(member.rows) * static_cast<std::size_t>(member.columns);
  return numbers;
}

std::vector<ArrayArgument> linearization_members(const Expected& expected) {
  const std::size_t x = 2 * expected.velocities.size() - expected.states + expected.carried.size(),
                    u = expected.inputs.size(), o = output_numbers(expected);
  std::vector<ArrayArgument> members = {{"A", {x, x}}};
  if (u > 0) members.push_back({"B", {x, u}});
  if (o > 0) members.push_back({"C", {o, x}});
  if (o > 0 && u > 0) members.push_back({"D", {o, u}});
  if (expected.dynamics_depend_on_time) members.push_back({"rate_t", {x}});
  if (expected.outputs_depend_on_time && o > 0) members.push_back({"output_t", {o}});
  return members;
}

bool has_rate(const Expected& expected) {
  return !expected.quaternions.empty() || expected.is_reduced || expected.states > 0;
}

std::string correction_of(const Expected& expected) {
  if (expected.constraints.empty()) return "";
  return expected.is_reduced ? "close_loops" : "project";
}

}  // namespace jourdain::readback
