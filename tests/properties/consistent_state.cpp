#include "consistent_state.hpp"

#include <algorithm>

#include "model/time_dependence.hpp"
#include "random.hpp"

namespace jourdain::tests {

namespace {

using Long = long double;
using Vector = reference::VectorX<Long>;
using Matrix = reference::MatrixX<Long>;
using reference::LoopConstraints;

constexpr int kNewtonSteps = 20;
constexpr std::uint64_t kStateStream = 0x4c4f4f50u;  // so that states and mechanisms of a seed are unrelated
constexpr double kWay = 0.3;                         // rad or m

/// The least change of z that meets G change = −`lack` (in the least squares where rows contradict each other).
Vector least_change(const LoopConstraints<Long>& constraints, const Vector& lack) {
  if (lack.size() == 0) return Vector::Zero(constraints.G.cols());
  Eigen::JacobiSVD<Matrix> svd(constraints.G, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(reference::descriptor::kDependent);
  return -svd.solve(lack);
}

Long largest(const Vector& entries) { return entries.size() ? entries.lpNorm<Eigen::Infinity>() : 0; }

class Closing {
 public:
  explicit Closing(const model::Mechanism& mechanism) : mechanism_(mechanism), form_(mechanism) {}

  std::optional<LoopState> closed(LoopState state) const {
    Long before = 0;
    for (int i = 0; i < kNewtonSteps; ++i) {
      const LoopConstraints<Long> at = form_.loop_constraints(state.t, state.y, state.z);
      const Long left = largest(at.g);
      if (left <= kClosed && (i > 0 && left >= before / 2)) return with_rates(std::move(state), at);
      before = left;
      state.y = displaced(mechanism_, state.y, least_change(at, at.g));
    }
    return {};
  }

  LoopConstraints<Long> constraints(const LoopState& state) const {
    return form_.loop_constraints(state.t, state.y, state.z);
  }
  bool rheonomic() const { return model::time_dependence(mechanism_).any(); }

 private:
  static std::optional<LoopState> with_rates(LoopState state, const LoopConstraints<Long>& at) {
    state.z += least_change(at, at.rate);
    Vector left = at.rate;
    if (left.size()) left += at.G * least_change(at, at.rate);
    if (largest(left) > kClosed * (1 + largest(at.rate))) return {};
    return state;
  }

  const model::Mechanism& mechanism_;
  reference::DescriptorReference<Long> form_;
};

}  // namespace

LoopFreedom loop_freedom(const LoopConstraints<Long>& constraints) {
  Matrix rows = constraints.G;
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    if (const Long length = rows.row(i).norm(); length > reference::descriptor::kDependent)
      rows.row(i) /= length;
  LoopFreedom freedom{rows.rows(), 0, 1, Matrix::Identity(rows.cols(), rows.cols())};
  if (rows.size() == 0) return freedom;
  Eigen::JacobiSVD<Matrix> svd(rows, Eigen::ComputeFullV);
  svd.setThreshold(reference::descriptor::kDependent);
  freedom.rank = svd.rank();
  if (freedom.rank > 0) freedom.weakest = svd.singularValues()[freedom.rank - 1] / svd.singularValues()[0];
  freedom.motions = svd.matrixV().rightCols(rows.cols() - freedom.rank);
  return freedom;
}

Vector displaced(const model::Mechanism& mechanism, const Vector& y, const Vector& change) {
  const model::Tangent tangent = model::lay_out_coordinates(mechanism).tangent;
  Vector moved = y;
  for (const auto& scalar : tangent.scalars)
    moved[Eigen::Index(scalar.position)] += change[Eigen::Index(scalar.velocity)];
  for (const auto& turn : tangent.quaternions) {
    const Eigen::Vector4<Long> wxyz = y.segment<4>(Eigen::Index(turn.position));
    const Eigen::Vector3<Long> half = change.segment<3>(Eigen::Index(turn.velocity)) / 2;
    const Eigen::Quaternion<Long> q = Eigen::Quaternion<Long>(wxyz[0], wxyz[1], wxyz[2], wxyz[3]) *
                                      Eigen::Quaternion<Long>(1, half.x(), half.y(), half.z());
    moved.segment<4>(Eigen::Index(turn.position)) =
        Eigen::Vector4<Long>(q.w(), q.x(), q.y(), q.z()).normalized();
  }
  return moved;
}

std::optional<LoopState> closed_state(const model::Mechanism& mechanism, LoopState near) {
  return Closing(mechanism).closed(std::move(near));
}

std::optional<std::vector<LoopState>> consistent_states(const model::Mechanism& mechanism, std::uint64_t seed,
                                                        std::size_t count) {
  const Closing closing(mechanism);
  Random random(seed ^ kStateStream);
  const auto numbers = [&](Eigen::Index size, double reach) {
    Vector values(size);
    for (Long& value : values) value = random.uniform(-reach, reach);
    return values;
  };
  std::vector<LoopState> states;
  while (states.size() < count) {
    LoopState state = reference::Reference<Long>(mechanism).initial_state();
    for (const std::size_t q : model::lay_out_coordinates(mechanism).quaternions)
      state.y.segment<4>(Eigen::Index(q)).normalize();
    if (!states.empty()) {
      const Matrix motions = loop_freedom(closing.constraints(state)).motions;
      Vector way = motions * numbers(motions.cols(), 1);
      if (way.size() && way.norm() > 0) way *= random.uniform(0, kWay) / way.norm();
      state.y = displaced(mechanism, state.y, way);
      if (closing.rheonomic()) state.t = random.uniform(0, kWay);
    }
    state.z = numbers(state.z.size(), 1.5);
    const std::optional<LoopState> closed = closing.closed(std::move(state));
    if (!closed) return {};
    states.push_back(*closed);
  }
  return states;
}

}  // namespace jourdain::tests
