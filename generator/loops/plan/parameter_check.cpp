#include "loops/plan/parameter_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "loops/closed_form/position_request.hpp"
#include "loops/regularity/regularity_proof.hpp"
#include "loops/rows/configuration.hpp"
#include "model/loop_kinds.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::LeafKind;

namespace {

/// The initial state at other parameters: the independent coordinates stay.
std::vector<double> closed_again(const LoopPlan& plan, const std::vector<double>& parameters) {
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = plan.y;
  leaves[LeafKind::kParameter] = parameters;
  leaves[LeafKind::kTime] = {0};
  std::vector<double> y = plan.y;
  const std::vector<double> found = ir::interpret(plan.closed_form->close, leaves);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ir::Output& output = plan.closed_form->close.outputs[i];
    if (output.name == "y") y[static_cast<std::size_t>(output.row)] = found[i];
  }
  return y;
}

/// Of the closed form the part that sets positions, printed: what regularity is a share of may depend on parameters.
std::string positions_of(const ClosedForm& form) {
  ir::Program close = form.close;
  std::erase_if(close.outputs, [](const ir::Output& output) { return output.name == "regularity"; });
  return ir::print(passes::remove_dead_code(close));
}

std::string why_not_explicit(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                             const LoopPlan& plan, const std::vector<double>& parameters) {
  ClosedFormRequest request = std::get<ClosedFormRequest>(position_request(mechanism, constraints, plan));
  request.initial_y = closed_again(plan, parameters);
  if (std::any_of(request.initial_y.begin(), request.initial_y.end(), [](double y) { return std::isnan(y); }))
    return "the loops cannot be closed at the start";
  request.parameters = parameters;
  request.parameter_range.assign(parameters.size(), {});
  for (const Block& block : plan.blocks)
    if (block.in_order) request.eliminations.push_back({block.rows, block.dependents});
  const auto found = closed_form(request);
  if (const auto* failure = std::get_if<std::string>(&found)) return *failure;
  for (const bool has_pivots : std::get<ClosedForm>(found).has_pivots)
    if (!has_pivots) return "a divisor of the velocities is not proven to stay off zero there";
  const bool same = positions_of(std::get<ClosedForm>(found)) == positions_of(*plan.closed_form);
  return same ? "" : "the closed form is another one there";
}

std::string why_not_partitioned(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                const LoopPlan& plan, const std::vector<double>& parameters) {
  const NumericClosure closure(mechanism, constraints, parameters);
  std::vector<bool> moving(closure.velocity_count(), true);
  for (const std::size_t k : plan.independent) moving[k] = false;
  Configuration start;
  start.y = Eigen::Map<const Eigen::VectorXd>(plan.y.data(), static_cast<Eigen::Index>(plan.y.size()))
                .cast<long double>();
  start = closure.assembled(start, moving);
  if (!closure.closes(start)) return "the loops cannot be closed at the start";
  RegularityRequest request = regularity_request(mechanism, constraints, plan);
  for (std::size_t i = 0; i < request.initial_y.size(); ++i)
    request.initial_y[i] = static_cast<double>(start.y[static_cast<Eigen::Index>(i)]);
  request.parameters = parameters;
  request.parameter_range.assign(parameters.size(), {});
  const auto found = prove_regular(request);
  const auto* failure = std::get_if<std::string>(&found);
  return failure ? *failure : "";
}

}  // namespace

std::optional<std::string> unproven_at(const model::Mechanism& mechanism, const LoopPlan& plan,
                                       const std::vector<double>& parameters) {
  if (!(plan.closed_form || plan.proof) || parameters == model::default_values(mechanism)) return {};
  dynamics::DerivationOptions options;
  options.closures_only = options.for_derivatives = true;
  const ConstraintPrograms constraints =
      constraint_programs(mechanism, dynamics::derive_equations(mechanism, options)).front();
  std::vector<std::string> changed;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const model::Parameter& parameter = mechanism.parameters[k];
    const auto enters_in = [k](const ir::Program& rows) {
      return std::any_of(rows.nodes.begin(), rows.nodes.end(), [k](const ir::Node& node) {
        return node.op == ir::Op::kLeaf && node.leaf == LeafKind::kParameter && node.index == k;
      });
    };
    const bool enters = enters_in(constraints.value) ||
                        (model::binds_velocities(mechanism) && enters_in(constraints.jacobian));
    if (enters && !parameter.range && parameters[k] != parameter.value)
      changed.push_back(fmt::format("{} = {}", parameter.name, parameters[k]));
  }
  if (changed.empty()) return {};
  const std::string failure = plan.closed_form
                                  ? why_not_explicit(mechanism, constraints, plan, parameters)
                                  : why_not_partitioned(mechanism, constraints, plan, parameters);
  if (failure.empty()) return {};
  return fmt::format("the loops are not proven to close at {}: {}", fmt::join(changed, ", "), failure);
}

}  // namespace jourdain::loops
