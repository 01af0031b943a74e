#include "studies/linearisation.hpp"

#include <algorithm>
#include <cmath>

#include "studies/sensitivity.hpp"
#include "studies/spectra.hpp"
#include "studies/tangent_space.hpp"

namespace jourdain::studies {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Jacobian by Richardson's extrapolation of central differences. Column by column the separation is taken at which two
/// neighbouring extrapolations agree best: smoothed friction bends on lengths far below a metre.
MatrixXd extrapolated_jacobian(const Flow<double>& flow, const Point<double>& point) {
  constexpr int kLevels = 4;
  constexpr double kShrink = 4;
  double separation = std::pow(2 * flow.table().unit_roundoff, 0.2);
  const auto extrapolated = [&] {
    return MatrixXd((4 * jacobian(flow, point, separation / 2) - jacobian(flow, point, separation)) / 3);
  };
  MatrixXd previous = extrapolated(), best = previous;
  VectorXd change = VectorXd::Constant(best.cols(), INFINITY);
  for (int level = 1; level < kLevels; ++level) {
    separation /= kShrink;
    const MatrixXd next = extrapolated();
    for (Index i = 0; i < best.cols(); ++i) {
      const double difference = (next.col(i) - previous.col(i)).norm();
      if (!(difference < change[i])) continue;
      change[i] = difference;
      best.col(i) = next.col(i);
    }
    previous = next;
  }
  return best;
}

/// What small rotations and the other positions do to y, ny × nz.
MatrixXd position_tangents(const VectorXd& y, Index nz, const model::Tangent& tangent) {
  MatrixXd T = MatrixXd::Zero(y.size(), nz);
  for (const model::Tangent::Scalar& s : tangent.scalars) T(Index(s.position), Index(s.velocity)) = 1;
  for (const model::Tangent::Scalar& s : tangent.quaternions)
    T.block<4, 3>(Index(s.position), Index(s.velocity)) = turning(y.segment<4>(Index(s.position)));
  return T;
}

MatrixXd emitted_linearisation(const Flow<double>& flow, const Point<double>& point) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto nz = static_cast<Index>(flow.table().velocity_count);
  RowMajor by_y(nz, nz), by_z(nz, nz);
  const std::vector<double> u = flow.inputs().at(point.t);
  flow.table().derivatives(&point.t, point.x.data(), point.x.data() + flow.position_count(), u.data(),
                           by_y.data(), by_z.data());
  MatrixXd A(2 * nz, 2 * nz);
  A << MatrixXd::Zero(nz, nz), MatrixXd::Identity(nz, nz), by_y, by_z;
  return A;
}

/// Entries of x that change by themselves beside displacements: coordinates that are carried along, then z.
std::vector<std::size_t> free_entries(const Flow<double>& flow, const model::Tangent& tangent) {
  const auto nz = static_cast<std::size_t>(flow.table().velocity_count);
  std::vector<std::size_t> entries;
  for (const model::Tangent::Scalar& s : tangent.scalars)
    if (s.velocity >= nz) entries.push_back(s.position);
  for (std::size_t i = flow.position_count(); i < flow.size(); ++i) entries.push_back(i);
  return entries;
}

/// Of their rates by all displacements, the loops closed after each, by Richardson's extrapolation of central
/// differences.
MatrixXd by_closed_displacements(const Flow<double>& flow, const Point<double>& point,
                                 const model::Tangent& tangent, const std::vector<std::size_t>& entries) {
  const auto slope = [&](std::size_t direction, double delta) {
    const auto rates = [&](double change) {
      const Point<double> at = flow.closed(moved_along(point, tangent, direction, change));
      const std::vector<double> all = flow.rates(at.t, at.x);
      return VectorXd(Eigen::Map<const VectorXd>(all.data(), static_cast<Index>(all.size()))(entries));
    };
    return VectorXd((rates(delta) - rates(-delta)) / (2 * delta));
  };
  const double delta = std::pow(2 * flow.table().unit_roundoff, 0.2);
  MatrixXd result(static_cast<Index>(entries.size()), displacement_count(flow, tangent));
  for (Index k = 0; k < result.cols(); ++k) {
    const auto direction = static_cast<std::size_t>(k);
    result.col(k) = (4 * slope(direction, delta / 2) - slope(direction, delta)) / 3;
  }
  return result;
}

}  // namespace

MatrixXd linearisation(const Flow<double>& flow, const Point<double>& point, const model::Tangent& tangent) {
  if (flow.table().derivatives) return emitted_linearisation(flow, point);
  if (flow.has_loops() && !keeps_all_coordinates(flow, tangent)) {
    const std::vector<std::size_t> entries = free_entries(flow, tangent);
    const Index nz = flow.table().velocity_count, rest = static_cast<Index>(entries.size());
    MatrixXd A = MatrixXd::Zero(nz + rest, rest + nz);
    A.block(0, rest, nz, nz).setIdentity();
    A.bottomLeftCorner(rest, rest) = by_closed_displacements(flow, point, tangent, entries);
    A.bottomRightCorner(rest, nz) = extrapolated_jacobian(flow, point)(entries, Eigen::lastN(nz));
    return A;
  }
  MatrixXd J = extrapolated_jacobian(flow, point);
  const auto ny = static_cast<Index>(flow.position_count()), nz = J.cols() - ny;
  if (tangent.quaternions.empty() && ny == nz) return J;
  const MatrixXd T = position_tangents(Eigen::Map<const VectorXd>(point.x.data(), ny), nz, tangent);
  MatrixXd A(2 * nz, 2 * nz);
  // In axes that do not turn, a small rotation changes by the difference of the angular velocities and by nothing else.
  A << MatrixXd::Zero(nz, nz), MatrixXd::Identity(nz, nz), J.bottomLeftCorner(nz, ny) * T,
      J.bottomRightCorner(nz, nz);
  return A;
}

VectorXd balancing_scales(const MatrixXd& A) {
  constexpr int kMostSweeps = 30;
  MatrixXd balanced = A;
  balanced.diagonal().setZero();
  VectorXd scales = VectorXd::Ones(A.rows());
  bool changed = true;
  for (int sweep = 0; changed && sweep < kMostSweeps; ++sweep) {
    changed = false;
    for (Index i = 0; i < A.rows(); ++i) {
      const double row = balanced.row(i).norm(), column = balanced.col(i).norm();
      if (!(row > 0) || !(column > 0)) continue;
      const double factor = std::exp2(std::round(std::log2(row / column) / 2));
      if (factor == 1) continue;
      balanced.row(i) /= factor;
      balanced.col(i) *= factor;
      scales[i] *= factor;
      changed = true;
    }
  }
  return scales;
}

Modes modes_of(const MatrixXd& A) {
  constexpr double kDependent = 1e12;  // condition of the eigenvectors
  Modes modes;
  modes.scales = balancing_scales(A);
  const MatrixXd balanced = modes.scales.cwiseInverse().asDiagonal() * A * modes.scales.asDiagonal();
  const auto [values, right] = spectrum(balanced);
  modes.values = values;
  const VectorXd singular = singular_values(right);
  modes.defective = singular[singular.size() - 1] * kDependent < singular[0];
  modes.right = modes.scales.asDiagonal() * right;
  const Eigen::MatrixXcd left = inverse(right);
  modes.participations = right.cwiseAbs().cwiseProduct(left.transpose().cwiseAbs());
  for (Index k = 0; k < A.cols(); ++k) modes.participations.col(k) /= modes.participations.col(k).sum();
  return modes;
}

}  // namespace jourdain::studies
