#include "loops/compiled_swing.hpp"

#include <algorithm>
#include <cmath>

#include "compile/start_check.hpp"
#include "loops/plan/plan.hpp"
#include "model/check/checks.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {

using ir::LeafKind;

std::variant<CompiledLinkage, std::string> compiled_or_refused(const model::Mechanism& mechanism) {
  support::Diagnostics diagnostics("model", "");
  model::check_mechanism(mechanism, diagnostics, support::Severity::kError);
  if (!diagnostics.has_errors()) check_inertia(mechanism, diagnostics);
  if (!diagnostics.has_errors()) check_start(mechanism, diagnostics);
  CompileOptions options;
  options.functions = {"initial_state", "kinetic_energy", "potential_energy", "constraint_residual",
                       "rk4_step"};
  if (!diagnostics.has_errors()) options.loops = loops::plan_loops(mechanism, diagnostics);
  if (diagnostics.has_errors()) return diagnostics.format();
  CompiledModel compiled = compile(mechanism, options);
  if (!compiled.verdict.accepted()) return "rejected: " + compiled.verdict.failures.front();
  return CompiledLinkage{*options.loops, std::move(compiled)};
}

CompiledSwing::CompiledSwing(const model::Mechanism& mechanism, const CompiledModel& compiled)
    : compiled_(compiled),
      position_rate_(find("position_rate")),
      forward_dynamics_(find("forward_dynamics")),
      closing_(find(programs::correction(compiled.facts))) {
  leaves_[LeafKind::kParameter] = model::default_values(mechanism);
  leaves_[LeafKind::kConstant] = ir::interpret(compiled.module.constants, leaves_);
  leaves_[LeafKind::kTime] = {0.0};
  leaves_[LeafKind::kInput].assign(compiled.facts.inputs.size(), 0.0);
}

std::vector<double> CompiledSwing::values(const ir::Program& program, const SwingState& state) const {
  leaves_[LeafKind::kPosition] = state.y;
  leaves_[LeafKind::kVelocity] = state.z;
  leaves_[LeafKind::kTime][0] = state.t;
  return ir::interpret(program, leaves_);
}

double CompiledSwing::scalar(const char* function, const SwingState& state) const {
  return values(*find(function), state).front();
}

namespace {

/// Entries `name` of a program's outputs into `entries`.
void take(const ir::Program& program, const std::vector<double>& values, const char* name,
          std::vector<double>& entries) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (const ir::Output& output = program.outputs[k]; output.row >= 0 && output.name == name)
      entries[static_cast<std::size_t>(output.row)] = values[k];
}

std::optional<double> scalar_output(const ir::Program& program, const std::vector<double>& values,
                                    const char* name) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (program.outputs[k].row < 0 && program.outputs[k].name == name) return values[k];
  return {};
}

std::vector<double> moved(const std::vector<double>& x, double h, const std::vector<double>& rate) {
  std::vector<double> result = x;
  for (std::size_t i = 0; i < x.size(); ++i) result[i] += h * rate[i];
  return result;
}

}  // namespace

SwingState CompiledSwing::start() const {
  SwingState state{0, std::vector<double>(compiled_.facts.positions.size()),
                   std::vector<double>(compiled_.facts.velocities.size())};
  const ir::Program& program = *find("initial_state");
  const std::vector<double> numbers = values(program, state);
  take(program, numbers, "y", state.y);
  take(program, numbers, "z", state.z);
  return state;
}

CompiledSwing::Rates CompiledSwing::rates(const SwingState& state) const {
  Rates result{state.z, std::vector<double>(state.z.size())};
  take(*forward_dynamics_, values(*forward_dynamics_, state), "zdot", result.z);
  if (!position_rate_) return result;
  result.y.assign(state.y.size(), 0);
  take(*position_rate_, values(*position_rate_, state), "ydot", result.y);
  return result;
}

ClosingReport CompiledSwing::step(SwingState& state, double h) const {
  const auto at = [&](double part, const Rates& rate) {
    return SwingState{state.t + part, moved(state.y, part, rate.y), moved(state.z, part, rate.z)};
  };
  const Rates k1 = rates(state), k2 = rates(at(h / 2, k1)), k3 = rates(at(h / 2, k2)), k4 = rates(at(h, k3));
  const auto advance = [h](std::vector<double>& x, const auto& a, const auto& b, const auto& c,
                           const auto& d) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h / 6 * (a[i] + 2 * (b[i] + c[i]) + d[i]);
  };
  advance(state.y, k1.y, k2.y, k3.y, k4.y);
  advance(state.z, k1.z, k2.z, k3.z, k4.z);
  state.t += h;
  for (const model::Tangent::Scalar& turn : compiled_.facts.tangent.quaternions) {
    const auto q = state.y.begin() + static_cast<std::ptrdiff_t>(turn.position);
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (std::ptrdiff_t i = 0; i < 4; ++i) q[i] /= length;
  }
  const std::vector<double> closed = values(*closing_, state);
  take(*closing_, closed, "y", state.y);
  take(*closing_, closed, "z", state.z);
  return {scalar_output(*closing_, closed, "regularity"), scalar_output(*closing_, closed, "opening")};
}

double CompiledSwing::kinetic_energy(const SwingState& state) const {
  return scalar("kinetic_energy", state);
}

double CompiledSwing::energy(const SwingState& state) const {
  return kinetic_energy(state) + scalar("potential_energy", state);
}

double CompiledSwing::opening(const SwingState& state) const {
  const ir::Program& program = *find("constraint_residual");
  const std::vector<double> numbers = values(program, state);
  double worst = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    if (program.outputs[k].name == "g" && !(std::fabs(numbers[k]) <= worst)) worst = std::fabs(numbers[k]);
  return worst;
}

std::size_t CompiledSwing::step_operations() const {
  const auto count = [](const ir::Program* program) {
    return program ? ir::count_operations(*program).arithmetic() : 0;
  };
  return 4 * (count(forward_dynamics_) + count(position_rate_)) + count(closing_);
}

}  // namespace jourdain::tests
