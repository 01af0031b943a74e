#include "programs/constrained_equations.hpp"

#include <optional>
#include <utility>

#include "ir/compose.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::programs {

using ir::Builder;
using ir::Column;
using ir::FunctionId;
using ir::LeafKind;
using ir::Signed;

namespace {

/// Rounding is divided by it where rows are redundant.
loops::Regularisation regularisation(const loops::LoopPlan& plan, const std::vector<std::size_t>& rows) {
  constexpr double kRedundant = 1e3;
  if (rows.size() == plan.solved_rows().size()) return {plan.regularisation, plan.corrections};
  return {kRedundant * plan.closing_regularisation, 2};
}

Column velocity_leaves(Builder& builder, const loops::LoopSystem& system) {
  Column leaves;
  for (std::size_t k = 0; k < system.layout.velocity_count(); ++k)
    leaves.push_back(builder.leaf(LeafKind::kVelocity, k));
  return leaves;
}

}  // namespace

ConstrainedEquations::ConstrainedEquations(Builder& builder, const loops::LoopSystem& system,
                                           std::vector<std::size_t> rows)
    : builder_(builder),
      system_(system),
      rows_(std::move(rows)),
      constraints_(builder, system),
      solver_(builder, system, loops::tree_mass_matrix(builder, system), constraints_, rows_,
              regularisation(system.plan, rows_)),
      rates_(loops::constraint_rates(builder, system, velocity_leaves(builder, system))) {}

ConstrainedEquations::Motion ConstrainedEquations::motion() const {
  const Column at_rest(system_.layout.velocity_count(), builder_.literal(0));
  const Column r = residual(at_rest, Column(rows_.size(), builder_.literal(0)));
  return solved(r, acceleration_rows(at_rest));
}

ConstrainedEquations::Motion ConstrainedEquations::solved(Column r, const Column& c) const {
  for (Signed& entry : r) entry = -entry;
  const Column pushed = solver_.lowered(r);
  Column right = solver_.constrained(pushed);
  for (std::size_t i = 0; i < rows_.size(); ++i) right[i] = builder_.add(right[i], c[i]);
  const Column lambda = solver_.multipliers(right);
  return {solver_.accelerations(pushed, lambda), lambda};
}

Column ConstrainedEquations::residual(const Column& zdot, const Column& lambda) const {
  Column r = ir::insert(builder_, system_.tree(FunctionId::kResidual), [&](LeafKind kind, std::size_t k) {
    return kind == LeafKind::kAcceleration ? std::optional(zdot[k]) : std::nullopt;
  });
  for (std::size_t k = 0; k < r.size(); ++k)
    for (std::size_t i = 0; i < rows_.size(); ++i)
      r[k] = builder_.add(r[k], builder_.multiply(constraints_.G(rows_[i], k), lambda[i]));
  return r;
}

Column ConstrainedEquations::acceleration_rows(const Column& zdot) const {
  const double s = system_.plan.stabilisation;
  Column c;
  for (const std::size_t r : rows_) {
    Signed sum = rates_.gamma[r];
    sum = builder_.add(sum, builder_.multiply(builder_.literal(2 * s), rates_.rate[r]));
    sum = builder_.add(sum, builder_.multiply(builder_.literal(s * s), constraints_.g(r)));
    for (std::size_t k = 0; k < zdot.size(); ++k)
      sum = builder_.add(sum, builder_.multiply(constraints_.G(r, k), zdot[k]));
    c.push_back(sum);
  }
  return c;
}

ConstrainedMotion constrained_motion(const loops::LoopSystem& system) {
  const std::vector<std::size_t> rows = system.plan.solved_rows();
  const auto program = [&](const char* name, const auto& write) {
    Builder builder;
    const ConstrainedEquations equations(builder, system, rows);
    const auto output = [&](const char* member, const Column& values) {
      for (std::size_t i = 0; i < values.size(); ++i)
        builder.output(member, static_cast<int>(i), -1, values[i]);
    };
    Column zdot, lambda;
    for (std::size_t k = 0; k < system.layout.velocity_count(); ++k)
      zdot.push_back(builder.leaf(LeafKind::kAcceleration, k));
    for (std::size_t i = 0; i < rows.size(); ++i) lambda.push_back(builder.leaf(LeafKind::kMultiplier, i));
    write(equations, zdot, lambda, output);
    return passes::remove_dead_code(builder.finish(name));
  };
  const auto write_motion = [](const ConstrainedEquations::Motion& motion, const auto& output) {
    output("zdot", motion.zdot);
    output("lambda", motion.lambda);
  };
  ConstrainedMotion result;
  result.motion = program("motion", [&](const auto& equations, const Column&, const Column&,
                                        const auto& output) { write_motion(equations.motion(), output); });
  result.equations = program(
      "equations", [](const auto& equations, const Column& zdot, const Column& lambda, const auto& output) {
        output("r", equations.residual(zdot, lambda));
        output("c", equations.acceleration_rows(zdot));
      });
  result.change =
      program("change", [&](const auto& equations, const Column& r, const Column& c, const auto& output) {
        write_motion(equations.solved(r, c), output);
      });
  return result;
}

}  // namespace jourdain::programs
