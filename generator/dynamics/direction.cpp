#include "dynamics/direction.hpp"

namespace jourdain::dynamics {

using kinematics::LeafKind;

namespace {

/// The change of y by the direction's displacements: of a quaternion ½ q ⊗ (0, δθ).
std::vector<ScaledReal> change_of(const ExactDirection& direction, const model::Tangent& tangent,
                                  const LeafValue& leaf) {
  std::vector<ScaledReal> change;
  const auto set = [&change](std::size_t i, const ScaledReal& value) {
    if (change.size() <= i) change.resize(i + 1);
    change[i] = value;
  };
  for (const model::Tangent::Scalar& s : tangent.scalars) set(s.position, direction.displacement[s.velocity]);
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    ScaledReal q[4], half[3];
    for (std::size_t k = 0; k < 4; ++k) q[k] = leaf(LeafKind::kPosition, s.position + k);
    for (std::size_t k = 0; k < 3; ++k) half[k] = direction.displacement[s.velocity + k] / 2;
    set(s.position, -(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      set(s.position + 1 + k, q[0] * half[k] + q[1 + l] * half[m] - q[1 + m] * half[l]);
    }
  }
  return change;
}

std::vector<ScaledReal> exact(const std::vector<double>& values) { return {values.begin(), values.end()}; }

}  // namespace

SlopePrecision moved_along(const ExactDirection& direction, const kinematics::Statements& statements,
                           const model::Tangent& tangent, const LeafValue& leaf) {
  const std::vector<ScaledReal> change = change_of(direction, tangent, leaf);
  return SlopePrecision(statements, [&](LeafKind kind, std::size_t i) -> SlopeReal {
    const ScaledReal value = leaf(kind, i);
    switch (kind) {
      case LeafKind::kPosition:
        return {value, i < change.size() ? change[i] : ScaledReal()};
      case LeafKind::kVelocity:
        return {value, direction.velocity[i]};
      case LeafKind::kInput:
        return {value, direction.input[i]};
      case LeafKind::kTime:
        return {value, direction.time};
      case LeafKind::kConstant:
      case LeafKind::kParameter:
      case LeafKind::kAcceleration:
      case LeafKind::kMultiplier:
      case LeafKind::kStepLength:
      case LeafKind::kHeld:
        break;
    }
    return {value};
  });
}

ExactDirection exact(const Direction& direction) {
  return {exact(direction.displacement), exact(direction.velocity), exact(direction.input), direction.time};
}

}  // namespace jourdain::dynamics
