#include "studies/tangent_space.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reference/decompositions.hpp"

namespace jourdain::studies {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index velocity_count(const Flow<double>& flow) { return static_cast<Index>(flow.table().velocity_count); }

Eigen::Vector4d quaternion_at(const Point<double>& point, std::size_t entry) {
  return Eigen::Map<const Eigen::Vector4d>(point.x.data() + entry);
}

/// How a state with all coordinates differs from `from`, displacements and velocities.
VectorXd difference(const Flow<double>& flow, const model::Tangent& tangent, const Point<double>& to,
                    const Point<double>& from) {
  const Index nz = velocity_count(flow);
  VectorXd result = VectorXd::Zero(2 * nz);
  for (const model::Tangent::Scalar& s : tangent.scalars)
    result[Index(s.velocity)] = to.x[s.position] - from.x[s.position];
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    const Eigen::Vector4d q = quaternion_at(from, s.position);
    result.segment<3>(Index(s.velocity)) = 4 * turning(q).transpose() * (quaternion_at(to, s.position) - q);
  }
  for (Index k = 0; k < nz; ++k) {
    const std::size_t entry = flow.position_count() + static_cast<std::size_t>(k);
    result[nz + k] = to.x[entry] - from.x[entry];
  }
  return result;
}

/// Derivative of closing the loops by displacements and velocities of all coordinates.
MatrixXd closing_jacobian(const Flow<double>& flow, const Point<double>& point,
                          const model::Tangent& tangent) {
  const Index nz = velocity_count(flow);
  const double delta = std::cbrt(2 * flow.table().unit_roundoff);
  MatrixXd P(2 * nz, 2 * nz);
  for (Index k = 0; k < 2 * nz; ++k) {
    const auto side = [&](double change) {
      if (k < nz) return flow.closed(moved_along(point, tangent, static_cast<std::size_t>(k), change));
      Point<double> other = point;
      other.x[flow.position_count() + static_cast<std::size_t>(k - nz)] += change;
      return flow.closed(other);
    };
    P.col(k) = difference(flow, tangent, side(delta), side(-delta)) / (2 * delta);
  }
  for (Index k = nz - static_cast<Index>(still_velocities(flow, tangent)); k < nz; ++k) P(k, k) = 1;
  return P;
}

/// The entries whose rows of a projection are most independent; its trace counts the directions that it keeps.
std::vector<std::size_t> most_independent(const MatrixXd& projection) {
  const auto count = static_cast<std::size_t>(std::max(0L, std::lround(projection.trace())));
  std::vector<std::size_t> entries;
  if (count == 0) return entries;
  const std::vector<Index> order = reference::pivoted_columns<double>(projection.transpose());
  for (std::size_t i = 0; i < count; ++i) entries.push_back(static_cast<std::size_t>(order[i]));
  return entries;
}

}  // namespace

std::vector<std::size_t> LocalCoordinates::rows() const {
  std::vector<std::size_t> list = displacements;
  list.insert(list.end(), velocities.begin(), velocities.end());
  return list;
}

Eigen::Matrix<double, 4, 3> turning(const Eigen::Vector4d& q) {
  Eigen::Matrix<double, 4, 3> m;
  m << -q[1], -q[2], -q[3],  //
      q[0], -q[3], q[2],     //
      q[3], q[0], -q[1],     //
      -q[2], q[1], q[0];
  return m / 2;
}

Index displacement_count(const Flow<double>& flow, const model::Tangent& tangent) {
  Index count = velocity_count(flow);
  for (const model::Tangent::Scalar& s : tangent.scalars) count = std::max(count, Index(s.velocity) + 1);
  return count;
}

std::size_t still_velocities(const Flow<double>& flow, const model::Tangent& tangent) {
  return static_cast<std::size_t>(displacement_count(flow, tangent)) - tangent.scalars.size() -
         3 * tangent.quaternions.size();
}

bool keeps_all_coordinates(const Flow<double>& flow, const model::Tangent& tangent) {
  return flow.has_loops() && displacement_count(flow, tangent) == velocity_count(flow) &&
         tangent.scalars.size() + 4 * tangent.quaternions.size() == flow.position_count();
}

Point<double> moved_along(const Point<double>& point, const model::Tangent& tangent, std::size_t velocity,
                          double delta) {
  Point<double> result = point;
  for (const model::Tangent::Scalar& s : tangent.scalars)
    if (s.velocity == velocity) result.x[s.position] += delta;
  for (const model::Tangent::Scalar& s : tangent.quaternions) {
    if (velocity < s.velocity || velocity >= s.velocity + 3) continue;
    const Eigen::Vector4d q = quaternion_at(point, s.position);
    Eigen::Map<Eigen::Vector4d>(result.x.data() + s.position) =
        (q + delta * turning(q).col(Index(velocity - s.velocity))).normalized();
  }
  return result;
}

LocalCoordinates local_coordinates(const Flow<double>& flow, const Point<double>& point,
                                   const model::Tangent& tangent) {
  const Index nz = velocity_count(flow);
  LocalCoordinates result;
  result.all_displacements = displacement_count(flow, tangent);
  if (!keeps_all_coordinates(flow, tangent)) {
    result.velocities.resize(static_cast<std::size_t>(nz));
    result.displacements.resize(static_cast<std::size_t>(result.all_displacements));
    std::iota(result.velocities.begin(), result.velocities.end(), std::size_t(0));
    std::iota(result.displacements.begin(), result.displacements.end(), std::size_t(0));
    result.embedding = MatrixXd::Identity(result.all_displacements + nz, result.all_displacements + nz);
    return result;
  }
  const MatrixXd P = closing_jacobian(flow, point, tangent);
  result.embedding = MatrixXd::Zero(2 * nz, 0);
  if (!P.allFinite()) return result;
  result.displacements = most_independent(P.topLeftCorner(nz, nz));
  result.velocities = most_independent(P.bottomRightCorner(nz, nz));
  if (result.velocities.size() == result.displacements.size()) result.velocities = result.displacements;
  if (result.velocities.empty()) return result;
  const std::vector<std::size_t> rows = result.rows();
  MatrixXd kept = MatrixXd::Zero(2 * nz, static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    kept(static_cast<Index>(rows[i]) + (i < result.displacements.size() ? 0 : nz), static_cast<Index>(i)) = 1;
  result.embedding = P * kept * reference::inverse<double>(kept.transpose() * P * kept);
  return result;
}

MatrixXd correction_jacobian(const Flow<double>& flow, const Point<double>& point) {
  const auto n = static_cast<Index>(flow.size());
  MatrixXd result = MatrixXd::Identity(n, n);
  if (!flow.has_loops()) return result;
  const double separation = std::cbrt(2 * flow.table().unit_roundoff);
  for (Index i = 0; i < n; ++i) {
    Point<double> above = point, below = point;
    const double delta = separation * (1 + std::fabs(point.x[std::size_t(i)]));
    above.x[std::size_t(i)] += delta;
    below.x[std::size_t(i)] -= delta;
    const std::vector<double> high = flow.corrected(above).x, low = flow.corrected(below).x;
    result.col(i) = (Eigen::Map<const VectorXd>(high.data(), n) - Eigen::Map<const VectorXd>(low.data(), n)) /
                    (2 * delta);
  }
  return result;
}

}  // namespace jourdain::studies
