#include "studies/local_dynamics.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kPoints = 60;
constexpr double kDampingScene = 1e-2;  ///< shrinking of volumes over the trajectory's own rate

/// The rows of the local coordinates, displacements and velocities.
MatrixXd kept(const MatrixXd& rates, const LocalCoordinates& coordinates) {
  const auto n = static_cast<Index>(coordinates.velocities.size()), nz = rates.rows() / 2;
  MatrixXd result(2 * n, rates.cols());
  for (Index i = 0; i < n; ++i) {
    const auto entry = static_cast<Index>(coordinates.velocities[std::size_t(i)]);
    result.row(i) = rates.row(entry);
    result.row(n + i) = rates.row(nz + entry);
  }
  return result;
}

/// ln det Bᵀ M B, M from inverse dynamics, whose differences in ż are its columns, B the velocities by local coordinates; 0
/// where there is none.
double log_inertia(const Flow<double>& flow, const Local& local) {
  if (!flow.table().inverse_dynamics) return 0;
  const Point<double>& point = *local.point;
  const auto split = point.x.begin() + static_cast<std::ptrdiff_t>(flow.position_count());
  const std::vector<double> y(point.x.begin(), split), z(split, point.x.end());
  const auto n = static_cast<Index>(z.size());
  MatrixXd M(n, n);
  const auto forces = [&](const std::vector<double>& zdot) {
    return inverse_dynamics<double>(flow.table(), point.t, y, z, zdot);
  };
  const std::vector<double> none = forces(std::vector<double>(z.size()));
  for (Index i = 0; i < n; ++i) {
    std::vector<double> unit(z.size());
    unit[std::size_t(i)] = 1;
    const std::vector<double> column = forces(unit);
    for (Index k = 0; k < n; ++k) M(k, i) = column[std::size_t(k)] - none[std::size_t(k)];
  }
  const MatrixXd B = local.coordinates.embedding.bottomRightCorner(
      n, static_cast<Index>(local.coordinates.velocities.size()));
  return std::log(std::fabs((B.transpose() * M * B).determinant()));
}

/// Mean rate (1/s) at which volumes in phase space shrink. In (y, z) a volume changes with det M too, which damps nothing.
double shrinking(const Flow<double>& flow, const std::vector<Local>& locals) {
  if (locals.size() < 2) return -locals.front().A.trace();
  double traces = 0;
  for (std::size_t k = 1; k < locals.size(); ++k)
    traces +=
        (locals[k].point->t - locals[k - 1].point->t) * (locals[k].A.trace() + locals[k - 1].A.trace()) / 2;
  const Point<double>&first = *locals.front().point, &last = *locals.back().point;
  return -(traces + log_inertia(flow, locals.back()) - log_inertia(flow, locals.front())) /
         (last.t - first.t);
}

}  // namespace

std::vector<Local> linearise(const Flow<double>& flow, const ReferenceSolution& reference,
                             const model::Tangent& tangent, const Progress& progress) {
  std::vector<Local> locals;
  const std::size_t last = reference.points.size() - 1, count = std::min(kPoints, last);
  for (std::size_t k = 0; k <= count; ++k) {
    progress("stability", 0.5 * double(k) / double(count));
    const Point<double>& point = reference.points[k * last / count];
    LocalCoordinates coordinates = local_coordinates(flow, point, tangent);
    const MatrixXd A = kept(linearisation(flow, point, tangent) * coordinates.embedding, coordinates);
    if (!A.allFinite() || A.size() == 0) continue;
    locals.push_back({&point, std::move(coordinates), A, modes_of(A)});
  }
  return locals;
}

Scene describe_scene(const Flow<double>& flow, const ReferenceSolution& reference,
                     const std::vector<Local>& locals, bool conserves_energy) {
  Scene scene{trajectory_rate(flow, reference), reference.points.back().t - reference.points.front().t,
              flow.table().unit_roundoff, false};
  scene.damps = !conserves_energy && shrinking(flow, locals) > kDampingScene * scene.rate;
  return scene;
}

double trajectory_rate(const Flow<double>& flow, const ReferenceSolution& reference) {
  constexpr std::size_t kMost = 2000;
  constexpr double kStill = 1e-9;  // deviation of an entry, over 1 + |x|, that is no motion
  const std::size_t stride = 1 + reference.points.size() / kMost;
  const auto n = static_cast<Index>(flow.size());
  VectorXd sum = VectorXd::Zero(n), squares = sum, rate_squares = sum;
  const auto as_vector = [n](const std::vector<double>& x) {
    return Eigen::Map<const VectorXd>(x.data(), n);
  };
  const VectorXd first = as_vector(reference.points.front().x);  // taken off, so that squares lose no digits
  double count = 0;
  for (std::size_t k = 0; k < reference.points.size(); k += stride, ++count) {
    const Point<double>& point = reference.points[k];
    const VectorXd x = as_vector(point.x) - first;
    sum += x;
    squares += x.cwiseAbs2();
    rate_squares += as_vector(flow.rates(point.t, point.x)).cwiseAbs2();
  }
  const double duration = reference.points.back().t - reference.points.front().t;
  double rate = 1 / duration;
  for (Index i = 0; i < n; ++i) {
    const double deviation = std::sqrt(std::max(0.0, squares[i] / count - std::pow(sum[i] / count, 2)));
    if (deviation > kStill * (1 + std::fabs(first[i])))
      rate = std::max(rate, std::sqrt(rate_squares[i] / count) / deviation);
  }
  return rate;
}

const Local& local_at(const std::vector<Local>& locals, double time) {
  const auto nearer = [time](const Local& a, const Local& b) {
    return std::fabs(a.point->t - time) < std::fabs(b.point->t - time);
  };
  return *std::min_element(locals.begin(), locals.end(), nearer);
}

Index index_of(Complex mu, const Modes& modes) {
  Index nearest = 0;
  (modes.values.array() - mu).abs().minCoeff(&nearest);
  return nearest;
}

double fastest_of(const Modes& modes) { return modes.values.cwiseAbs().maxCoeff(); }

bool negligible(Complex mu, const Modes& modes, const Scene& scene) {
  return std::abs(mu) <= std::max(0.1 / scene.duration, std::cbrt(scene.roundoff) * fastest_of(modes));
}

}  // namespace jourdain::studies
