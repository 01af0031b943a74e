#include "loops/closed_programs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "agreement/shared_data.hpp"
#include "loops/plan/plan.hpp"
#include "programs/closed_system.hpp"
#include "programs/loop_functions.hpp"
#include "validate/kinks.hpp"

namespace jourdain::tests {

using ir::LeafKind;

namespace {

loops::LoopPlan planned(const model::Mechanism& mechanism) {
  support::Diagnostics diagnostics("model", "");
  const auto plan = loops::plan_loops(mechanism, diagnostics);
  JD_CHECK(plan, "{}", diagnostics.format());
  return *plan;
}

}  // namespace

ClosedPrograms::ClosedPrograms(const model::Mechanism& mechanism, bool with_linearization)
    : mechanism_(mechanism), layout_(model::lay_out_coordinates(mechanism)), plan_(planned(mechanism)) {
  const programs::ClosedSystem closed(mechanism_, {}, plan_);
  std::vector<std::string> functions = {"forward_dynamics", "constraint_forces", "constraint_residual",
                                        "kinetic_energy",   "potential_energy",  "position_rate"};
  functions.push_back(plan_.is_reduced() ? "close_loops" : "project");
  ir::Module module;
  for (const std::string& function : functions)
    module.functions.push_back(closed.program(*ir::function_named(function)));
  if (with_linearization)
    for (ir::Program& program : programs::derivative_programs(
             closed.derivative_sources(),
             programs::with_needed({"linearize"}, programs::scene_facts(mechanism, &plan_)),
             programs::DerivativeTerms::kAll))
      module.functions.push_back(std::move(program));
  module_ = passes::optimise(std::move(module)).module;
}

std::size_t ClosedPrograms::operations(const std::string& function) const {
  return ir::count_operations(*ir::find_program(module_, function)).arithmetic();
}

std::map<std::string, double> ClosedPrograms::values(const std::string& function, double t,
                                                     const std::vector<double>& y,
                                                     const std::vector<double>& z,
                                                     const std::vector<double>& u) const {
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kParameter] = model::default_values(mechanism_);
  leaves[LeafKind::kConstant] = ir::interpret(module_.constants, leaves);
  leaves[LeafKind::kPosition] = y;
  leaves[LeafKind::kVelocity] = z;
  leaves[LeafKind::kInput] = u;
  leaves[LeafKind::kTime] = {t};
  const ir::Program* program = ir::find_program(module_, function);
  JD_CHECK(program, "no program '{}'", function);
  const std::vector<double> values = ir::interpret(*program, leaves);
  std::map<std::string, double> named;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = program->outputs[k];
    std::string name = output.name;
    if (output.row >= 0) name += fmt::format("[{}]", output.row);
    if (output.column >= 0) name += fmt::format("[{}]", output.column);
    named[name] = values[k];
  }
  return named;
}

/// Of the independent coordinates.
std::vector<double> ClosedPrograms::velocities(const LoopState& state) const {
  std::vector<double> z;
  for (std::size_t k = 0; k < layout_.velocity_count(); ++k)
    if (!plan_.is_reduced() ||
        std::find(plan_.independent.begin(), plan_.independent.end(), k) != plan_.independent.end())
      z.push_back(static_cast<double>(state.z[Eigen::Index(k)]));
  return z;
}

bool ClosedPrograms::is_on_a_kink(const LoopState& state, const reference::VectorX<long double>& u) const {
  ir::LeafValues<support::ScaledReal> leaves;
  const auto take = [&leaves](LeafKind kind, const std::vector<double>& values) {
    leaves[kind].assign(values.begin(), values.end());
  };
  take(LeafKind::kParameter, model::default_values(mechanism_));
  take(LeafKind::kPosition, {state.y.begin(), state.y.end()});
  take(LeafKind::kVelocity, velocities(state));
  take(LeafKind::kInput, {u.begin(), u.end()});
  take(LeafKind::kTime, {static_cast<double>(state.t)});
  const validate::KinkSurvey::Look look = validate::KinkSurvey(module_).look(leaves);
  // On a kink in doubles, where constraints hold something at it, is near it with more digits.
  return look.is_near || std::any_of(look.distances.begin(), look.distances.end(),
                                     [](const support::ScaledReal& d) { return d == support::ScaledReal(); });
}

reference::VectorX<long double> ClosedPrograms::vector(const std::string& function, const LoopState& state,
                                                       const reference::VectorX<long double>& u) const {
  const auto named = values(function, static_cast<double>(state.t), {state.y.begin(), state.y.end()},
                            velocities(state), {u.begin(), u.end()});
  reference::VectorX<long double> result(Eigen::Index(named.size()));
  const char* name = function == "forward_dynamics" ? "zdot" : "lambda";
  for (std::size_t i = 0; i < named.size(); ++i)
    result[Eigen::Index(i)] = named.at(fmt::format("{}[{}]", name, i));
  return result;
}

reference::VectorX<long double> ClosedPrograms::accelerations(
    const LoopState& state, const reference::VectorX<long double>& u) const {
  return vector("forward_dynamics", state, u);
}

reference::VectorX<long double> ClosedPrograms::multipliers(const LoopState& state,
                                                            const reference::VectorX<long double>& u) const {
  return vector("constraint_forces", state, u);
}

std::vector<std::string> models_with_loops() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(model_path("")))
    if (entry.path().extension() == ".toml" && !read_model(entry.path()).loops.empty())
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace jourdain::tests
