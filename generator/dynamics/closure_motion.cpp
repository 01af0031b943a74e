#include "dynamics/closure_motion.hpp"

#include <cln/cln.h>

namespace jourdain::dynamics {

using cln::cl_R;
using kinematics::LeafKind;

namespace {

/// g where the state has moved on by `step` along constant velocities `z` and a rate of t, exact to second order.
std::vector<cl_R> moved(const Equations& closures, const model::Tangent& tangent,
                        const std::vector<double>& z, double time, const cl_R& step, const LeafValue& leaf) {
  std::vector<cl_R> y;
  const auto set = [&y](std::size_t i, const cl_R& value) {
    if (y.size() <= i) y.resize(i + 1, to_exact(0));
    y[i] = value;
  };
  const auto given = [&](std::size_t i) { return to_exact(leaf(LeafKind::kPosition, i)); };
  for (const model::Tangent::Scalar& s : tangent.scalars)
    set(s.position, given(s.position) + step * to_exact(z[s.velocity]));
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    cl_R q[4], half[3], along = to_exact(1);
    for (std::size_t k = 0; k < 4; ++k) q[k] = given(s.position + k);
    for (std::size_t k = 0; k < 3; ++k) {
      half[k] = step * to_exact(z[s.velocity + k]) / 2;
      along = along - half[k] * half[k] / 2;
    }
    set(s.position, q[0] * along - (q[1] * half[0] + q[2] * half[1] + q[3] * half[2]));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      set(s.position + 1 + k, q[1 + k] * along + q[0] * half[k] + q[1 + l] * half[m] - q[1 + m] * half[l]);
    }
  }
  const HighPrecision at = HighPrecision::at(closures.statements, [&](LeafKind kind, std::size_t i) -> cl_R {
    if (kind == LeafKind::kPosition) return y[i];
    const cl_R value = to_exact(leaf(kind, i));
    return kind == LeafKind::kTime ? value + step * to_exact(time) : value;
  });
  std::vector<cl_R> g;
  for (const LoopClosure& loop : closures.closures)
    for (const Ex& row : loop.rows) g.push_back(at.value(row));
  return g;
}

}  // namespace

ClosureMotion closure_motion(const Equations& closures, const model::Tangent& tangent,
                             std::size_t velocity_count, const LeafValue& leaf) {
  const cl_R step = cln::scale_float(cln::cl_float(to_exact(1)), -50);
  const auto slope = [&](const std::vector<double>& z, double time) {
    const std::vector<cl_R> above = moved(closures, tangent, z, time, step, leaf),
                            below = moved(closures, tangent, z, time, -step, leaf);
    std::vector<double> list;
    for (std::size_t r = 0; r < above.size(); ++r)
      list.push_back(to_double((above[r] - below[r]) / (2 * step)));
    return list;
  };
  ClosureMotion motion;
  std::vector<double> z(velocity_count, 0);
  motion.g_t = slope(z, 1);
  motion.G.assign(motion.g_t.size(), z);
  for (std::size_t k = 0; k < velocity_count; ++k) {
    std::vector<double> unit(velocity_count, 0);
    unit[k] = 1;
    const std::vector<double> column = slope(unit, 0);
    for (std::size_t r = 0; r < column.size(); ++r) motion.G[r][k] = column[r];
  }
  for (std::size_t k = 0; k < velocity_count; ++k) z[k] = leaf(LeafKind::kVelocity, k);
  motion.rate = slope(z, 1);
  const std::vector<cl_R> here = moved(closures, tangent, z, 1, to_exact(0), leaf),
                          above = moved(closures, tangent, z, 1, step, leaf),
                          below = moved(closures, tangent, z, 1, -step, leaf);
  for (std::size_t r = 0; r < here.size(); ++r) {
    motion.g.push_back(to_double(here[r]));
    motion.gamma.push_back(to_double((above[r] - 2 * here[r] + below[r]) / (step * step)));
  }
  return motion;
}

}  // namespace jourdain::dynamics
