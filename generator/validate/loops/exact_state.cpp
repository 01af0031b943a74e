#include "validate/loops/exact_state.hpp"

#include <algorithm>

#include "support/matrix_index.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

using ir::LeafKind;

namespace {

using support::at;

}  // namespace

ExactClosure::ExactClosure(const model::Mechanism& mechanism, const dynamics::Equations& closures,
                           const loops::LoopPlan& plan)
    : closures_(closures) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  tangent_ = layout.tangent;
  velocities_ = layout.velocity_count();
  carried_ = plan.carried();
  const auto is_among = [](const std::vector<std::size_t>& list, std::size_t k) {
    return std::find(list.begin(), list.end(), k) != list.end();
  };
  for (std::size_t k = 0; plan.is_reduced() && k < velocities_; ++k) {
    if (is_among(plan.independent, k)) continue;
    dependents_.push_back(k);
    if (!is_among(carried_, k)) closed_.push_back(k);
  }
  for (const loops::Block& block : plan.blocks)
    if (block.binds_positions)
      closing_rows_.insert(closing_rows_.end(), block.rows.begin(), block.rows.end());
}

dynamics::ClosureJacobian ExactClosure::jacobian(const ir::LeafValues<ScaledReal>& state) const {
  return dynamics::closure_jacobian(closures_, tangent_, velocities_, leaves_at(state),
                                    state[LeafKind::kHeld]);
}

dynamics::ClosureMotion ExactClosure::motion(const ir::LeafValues<ScaledReal>& state,
                                             const std::vector<ScaledReal>& z) const {
  return dynamics::closure_motion(closures_, tangent_, z, leaves_at(state), state[LeafKind::kHeld]);
}

ExactVector ExactClosure::g(const ir::LeafValues<ScaledReal>& state) const {
  return to_exact(dynamics::closure_values(closures_, leaves_at(state), state[LeafKind::kHeld]));
}

ir::LeafValues<ScaledReal> ExactClosure::holding(const ir::LeafValues<ScaledReal>& state,
                                                 ir::LeafValues<ScaledReal> moved) const {
  moved[LeafKind::kHeld] = dynamics::moved_points(closures_, leaves_at(state), leaves_at(moved));
  return moved;
}

ScaledReal ExactClosure::missed(const ir::LeafValues<ScaledReal>& state) const {
  return dynamics::closure_misses(closures_, leaves_at(state));
}

std::vector<ScaledReal> ExactClosure::displaced(std::vector<ScaledReal> y, const ExactVector& d) const {
  for (const model::Tangent::Scalar& s : tangent_.scalars) y[s.position] += d[at(s.velocity)];
  for (const model::Tangent::Scalar& s : tangent_.quaternions) {
    const ExactVector half = d.segment(at(s.velocity), 3) / ScaledReal(2);
    if (half == ExactVector::Zero(3)) continue;
    const ScaledReal w = y[s.position], v[3] = {y[s.position + 1], y[s.position + 2], y[s.position + 3]};
    ScaledReal p[4] = {w - v[0] * half[0] - v[1] * half[1] - v[2] * half[2]};
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index l = (k + 1) % 3, m = (k + 2) % 3;
      p[1 + k] = v[k] + w * half[k] + v[l] * half[m] - v[m] * half[l];
    }
    ScaledReal square;
    for (const ScaledReal& entry : p) square += entry * entry;
    for (std::size_t k = 0; k < 4; ++k) y[s.position + k] = p[k] / sqrt(square);
  }
  return y;
}

ir::LeafValues<ScaledReal> ExactClosure::closed(ir::LeafValues<ScaledReal> state) const {
  constexpr int kSteps = 12;
  const ScaledReal enough = 1e-70;
  for (int i = 0; i < kSteps && !closed_.empty(); ++i) {
    const dynamics::ClosureJacobian at_state = jacobian(state);
    const ExactVector open = to_exact(at_state.g)(closing_rows_);
    if (open.cwiseAbs().maxCoeff() < enough) break;
    const ExactMatrix D = to_exact(at_state.G, velocities_)(closing_rows_, closed_);
    const ExactVector change = solved(D, -open);
    ExactVector d = ExactVector::Zero(at(velocities_));
    d(closed_) = change;
    state[LeafKind::kPosition] = displaced(state[LeafKind::kPosition], d);
  }
  // Its rounding is that of a closed state, not of the way to it.
  for (ScaledReal& entry : state[LeafKind::kPosition]) entry = entry.forgetting();
  return state;
}

}  // namespace jourdain::validate
