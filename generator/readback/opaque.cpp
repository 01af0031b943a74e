#include "readback/opaque.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "readback/api.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

/// Rounding of 70 digits, carried through a step; anything wrong is off by far more.
constexpr double kTolerance = 1e-40;

void append(ExactVector& list, const ExactVector& more) { list.insert(list.end(), more.begin(), more.end()); }

ExactVector arguments_of(const Expected& expected, const Motion& motion, const ExactVector& input = {},
                         const ExactVector& accelerations = {}) {
  ExactVector list;
  if (expected.clock) list.push_back(motion.t);
  append(list, motion.y);
  append(list, motion.z);
  append(list, input);
  append(list, accelerations);
  return list;
}

}  // namespace

bool is_close(const Exact& a, const Exact& b, double scale) {
  return std::fabs(rough(a - b)) <= kTolerance * scale;
}

const ExactVector& OpaqueSystem::answer(const std::string& function, ExactVector arguments,
                                        std::size_t results) {
  double scale = 1;
  for (const Exact& argument : arguments) scale = std::max(scale, std::fabs(rough(argument)));
  std::vector<Call>& known = calls_[function];
  if (!frozen_) ++counts_[function];
  for (Call& call : known) {
    bool same = true;
    for (std::size_t i = 0; same && i < arguments.size(); ++i)
      same = is_close(call.arguments[i], arguments[i], scale);
    if (!same) continue;
    call.used = call.used || frozen_;
    return call.results;
  }
  if (frozen_) throw Refusal(fmt::format("the method evaluates {} where the text does not", function));
  known.push_back({std::move(arguments), random_.vector(results), false});
  return known.back().results;
}

ExactVector OpaqueSystem::position_rate(const Motion& motion) {
  return answer("position_rate", arguments_of(expected_, motion), expected_.positions.size());
}

ExactVector OpaqueSystem::forward_dynamics(const Motion& motion, const ExactVector& input) {
  return answer("forward_dynamics", arguments_of(expected_, motion, input), expected_.velocities.size());
}

ExactVector OpaqueSystem::residual(const Motion& motion, const ExactVector& input,
                                   const ExactVector& accelerations) {
  return answer("residual", arguments_of(expected_, motion, input, accelerations),
                expected_.velocities.size());
}

ExactVector OpaqueSystem::sample(const Motion& motion) {
  return answer("input", arguments_of(expected_, motion), expected_.inputs.size());
}

const ir::Program& OpaqueSystem::program(const std::string& name) const {
  const ir::Program* found = ir::find_program(*expected_.module, name);
  if (!found) throw Refusal(fmt::format("{} has no program", name));
  return *found;
}

Derivatives OpaqueSystem::residual_derivatives(const Motion& motion, const ExactVector& input,
                                               const ExactVector& accelerations) {
  const std::vector<ir::Output>& outputs = program("residual_derivatives").outputs;
  const ExactVector& values =
      answer("residual_derivatives", arguments_of(expected_, motion, input, accelerations), outputs.size());
  const std::size_t n = expected_.velocities.size();
  Derivatives result = {zero_matrix(n, n), zero_matrix(n, n + expected_.carried.size()), zero_matrix(n, n),
                        zero_matrix(n, expected_.inputs.size()), ExactVector(n, exact(0.0))};
  std::map<std::string, ExactMatrix*> matrices = {
      {"M", &result.M}, {"r_y", &result.r_y}, {"r_z", &result.r_z}, {"r_u", &result.r_u}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto row = static_cast<std::size_t>(outputs[i].row),
               column = static_cast<std::size_t>(outputs[i].column);
    if (outputs[i].name == "r_t")
      result.r_t.at(row) = values[i];
    else
      matrices.at(outputs[i].name)->at(row).at(column) = values[i];
  }
  return result;
}

void OpaqueSystem::take_samples(Motion& motion, const ExactVector& input, const Exact& h) {
  if (!expected_.has_samples) return;
  const std::vector<ir::Output>& outputs = program("sample").outputs;
  ExactVector arguments = arguments_of(expected_, motion, input);
  arguments.push_back(h);
  const ExactVector& values = answer("sample", std::move(arguments), outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i)
    motion.z.at(static_cast<std::size_t>(outputs[i].row)) = values[i];
}

void OpaqueSystem::correct(Motion& motion) {
  const std::string name = correction_of(expected_);
  if (name.empty()) return;
  const std::vector<ir::Output>& outputs = program(name).outputs;
  const ExactVector& values = answer(name, arguments_of(expected_, motion), outputs.size());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const ir::Output& output = outputs[i];
    const auto row = static_cast<std::size_t>(std::max(output.row, 0));
    if (output.name == "y")
      motion.y.at(row) = values[i];
    else if (output.name == "z")
      motion.z.at(row) = values[i];
    else
      motion.guards.at(output.name == "regularity" ? 0 : output.name == "opening" ? 1 : 2 + row) = values[i];
  }
}

std::string OpaqueSystem::unused() const {
  for (const auto& [name, calls] : calls_)
    for (const Call& call : calls)
      if (!call.used) return name;
  return "";
}

int OpaqueSystem::calls(const std::string& function) const {
  const auto it = counts_.find(function);
  return it == counts_.end() ? 0 : it->second;
}

std::size_t OpaqueSystem::operations_of_calls() const {
  std::size_t operations = 0;
  for (const auto& [name, count] : counts_)
    if (name != "input")
      operations += static_cast<std::size_t>(count) * ir::count_operations(program(name)).arithmetic();
  return operations;
}

}  // namespace jourdain::readback
