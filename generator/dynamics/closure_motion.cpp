#include "dynamics/closure_motion.hpp"

namespace jourdain::dynamics {

using kinematics::LeafKind;

namespace {

struct Quaternion {
  ScaledReal q[4];

  /// ½ q ⊗ (0, ω)
  Quaternion turned(const ScaledReal (&omega)[3]) const {
    ScaledReal half[3];
    for (std::size_t k = 0; k < 3; ++k) half[k] = omega[k] / 2;
    Quaternion rate;
    rate.q[0] = -(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      rate.q[1 + k] = q[0] * half[k] + q[1 + l] * half[m] - q[1 + m] * half[l];
    }
    return rate;
  }
};

/// y moving on with constant velocities `z`.
std::vector<MovingReal> moving_positions(const model::Tangent& tangent, const std::vector<ScaledReal>& z,
                                         const LeafValue& leaf) {
  std::vector<MovingReal> y;
  const auto set = [&y](std::size_t i, const MovingReal& value) {
    if (y.size() <= i) y.resize(i + 1);
    y[i] = value;
  };
  for (const model::Tangent::Scalar& s : tangent.scalars)
    set(s.position, {leaf(LeafKind::kPosition, s.position), z[s.velocity]});
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    Quaternion q;
    for (std::size_t k = 0; k < 4; ++k) q.q[k] = leaf(LeafKind::kPosition, s.position + k);
    const ScaledReal omega[3] = {z[s.velocity], z[s.velocity + 1], z[s.velocity + 2]};
    const Quaternion rate = q.turned(omega), acceleration = rate.turned(omega);
    for (std::size_t k = 0; k < 4; ++k) set(s.position + k, {q.q[k], rate.q[k], acceleration.q[k]});
  }
  return y;
}

/// The rows of all loops where the state moves on with constant velocities and a rate of t.
std::vector<MovingReal> moving_rows(const Equations& closures, const model::Tangent& tangent,
                                    const std::vector<ScaledReal>& z, int time, const LeafValue& leaf) {
  const std::vector<MovingReal> y = moving_positions(tangent, z, leaf);
  const MovingPrecision at(closures.statements, [&](LeafKind kind, std::size_t i) -> MovingReal {
    if (kind == LeafKind::kPosition) return y[i];
    if (kind == LeafKind::kTime) return {leaf(kind, i), ScaledReal(time)};
    return {leaf(kind, i)};
  });
  std::vector<MovingReal> rows;
  for (const LoopClosure& loop : closures.closures)
    for (const Ex& row : loop.rows) rows.push_back(at.value(row));
  return rows;
}

}  // namespace

ClosureMotion closure_motion(const Equations& closures, const model::Tangent& tangent,
                             const std::vector<ScaledReal>& z, const LeafValue& leaf) {
  ClosureMotion motion;
  for (const MovingReal& row : moving_rows(closures, tangent, z, 1, leaf)) {
    motion.g.push_back(row.value);
    motion.rate.push_back(row.first);
    motion.gamma.push_back(row.second);
  }
  std::vector<ScaledReal> unit(z.size());
  for (const MovingReal& row : moving_rows(closures, tangent, unit, 1, leaf)) motion.g_t.push_back(row.first);
  motion.G.assign(motion.g.size(), unit);
  for (std::size_t k = 0; k < z.size(); ++k) {
    unit[k] = 1;
    const std::vector<MovingReal> rows = moving_rows(closures, tangent, unit, 0, leaf);
    for (std::size_t r = 0; r < rows.size(); ++r) motion.G[r][k] = rows[r].first;
    unit[k] = 0;
  }
  return motion;
}

std::vector<ScaledReal> closure_values(const Equations& closures, const LeafValue& leaf) {
  const HighPrecision at(closures.statements, leaf);
  std::vector<ScaledReal> g;
  for (const LoopClosure& loop : closures.closures)
    for (const Ex& row : loop.rows) g.push_back(at.value(row));
  return g;
}

}  // namespace jourdain::dynamics
