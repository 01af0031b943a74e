#include "dynamics/direction.hpp"

#include <cln/cln.h>

#include "dynamics/outputs.hpp"

namespace jourdain::dynamics {

using cln::cl_R;
using kinematics::LeafKind;

namespace {

/// The point moved along the direction by `step`.
HighPrecision moved(const Direction& direction, const cl_R& step, const Equations& equations,
                    const model::Tangent& tangent, const LeafValue& leaf) {
  std::vector<cl_R> change;  // of y
  const auto set = [&change](std::size_t i, const cl_R& value) {
    if (change.size() <= i) change.resize(i + 1, to_exact(0));
    change[i] = value;
  };
  for (const model::Tangent::Scalar& s : tangent.scalars)
    set(s.position, step * to_exact(direction.displacement[s.velocity]));
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    cl_R q[4], half[3];
    for (std::size_t k = 0; k < 4; ++k) q[k] = to_exact(leaf(LeafKind::kPosition, s.position + k));
    for (std::size_t k = 0; k < 3; ++k) half[k] = step * to_exact(direction.displacement[s.velocity + k] / 2);
    set(s.position, -(q[1] * half[0] + q[2] * half[1] + q[3] * half[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      set(s.position + 1 + k, q[0] * half[k] + q[1 + l] * half[m] - q[1 + m] * half[l]);
    }
  }
  return HighPrecision::at(equations.statements, [&](LeafKind kind, std::size_t i) -> cl_R {
    const cl_R value = to_exact(leaf(kind, i));
    if (kind == LeafKind::kPosition && i < change.size()) return value + change[i];
    if (kind == LeafKind::kVelocity) return value + step * to_exact(direction.velocity[i]);
    if (kind == LeafKind::kInput) return value + step * to_exact(direction.input[i]);
    if (kind == LeafKind::kTime) return value + step * to_exact(direction.time);
    return value;
  });
}

std::vector<cl_R> residual(const Equations& equations, const HighPrecision& at, const LeafValue& leaf) {
  std::vector<cl_R> r;
  for (std::size_t i = 0; i < equations.M.size(); ++i) {
    cl_R sum = at.value(equations.q_bar[i]) - at.value(equations.k_bar[i]);
    for (std::size_t j = 0; j < equations.M.size(); ++j)
      sum = sum + at.value(equations.M[i][j]) * to_exact(leaf(LeafKind::kAcceleration, j));
    r.push_back(sum);
  }
  return r;
}

std::vector<cl_R> values(const std::vector<kinematics::Ex>& expressions, const HighPrecision& at) {
  std::vector<cl_R> list;
  for (const kinematics::Ex& e : expressions) list.push_back(at.value(e));
  return list;
}

}  // namespace

DirectionalDerivatives derivatives_along(const Direction& direction, const Equations& equations,
                                         const model::Tangent& tangent, const LeafValue& leaf) {
  const cl_R step = cln::scale_float(cln::cl_float(to_exact(1)), -66);
  const HighPrecision above = moved(direction, step, equations, tangent, leaf),
                      below = moved(direction, -step, equations, tangent, leaf);
  const auto differences = [&](const std::vector<cl_R>& high, const std::vector<cl_R>& low) {
    std::vector<double> list;
    for (std::size_t i = 0; i < high.size(); ++i) list.push_back(to_double((high[i] - low[i]) / (2 * step)));
    return list;
  };
  const std::vector<kinematics::Ex> outputs = output_entries(equations);
  return {differences(residual(equations, above, leaf), residual(equations, below, leaf)),
          differences(values(equations.q_bar, above), values(equations.q_bar, below)),
          differences(values(equations.zdot, above), values(equations.zdot, below)),
          differences(values(outputs, above), values(outputs, below))};
}

}  // namespace jourdain::dynamics
