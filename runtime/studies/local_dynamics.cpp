#include "studies/local_dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "reference/decompositions.hpp"

namespace jourdain::studies {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kPoints = 60;

/// The rows of the local coordinates, displacements and velocities.
MatrixXd kept(const MatrixXd& rates, const LocalCoordinates& coordinates) {
  const std::vector<std::size_t> rows = coordinates.rows();
  MatrixXd result(static_cast<Index>(rows.size()), rates.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool of_velocity = i >= coordinates.displacements.size();
    result.row(Index(i)) =
        rates.row(static_cast<Index>(rows[i]) + (of_velocity ? coordinates.all_displacements : 0));
  }
  return result;
}

/// M a, M from inverse dynamics, whose differences in ż are its columns; a where the table has none.
VectorXd mass_times(const Flow<double>& flow, const Point<double>& point, const VectorXd& a) {
  if (!flow.table().inverse_dynamics) return a;
  const auto split = point.x.begin() + static_cast<std::ptrdiff_t>(flow.position_count());
  const std::vector<double> y(point.x.begin(), split), z(split, point.x.end());
  const auto forces = [&](const std::vector<double>& zdot) {
    const std::vector<double> list = inverse_dynamics<double>(flow.table(), point.t, y, z, zdot);
    return VectorXd(Eigen::Map<const VectorXd>(list.data(), static_cast<Index>(list.size())));
  };
  return forces({a.begin(), a.end()}) - forces(std::vector<double>(z.size()));
}

/// ln det Bᵀ M B, B the velocities by local coordinates.
double log_inertia(const Flow<double>& flow, const Point<double>& point,
                   const LocalCoordinates& coordinates) {
  const auto n = static_cast<Index>(coordinates.velocities.size());
  const MatrixXd& all = coordinates.embedding;
  const MatrixXd B = all.bottomRightCorner(all.rows() - coordinates.all_displacements, n);
  MatrixXd MB(B.rows(), n);
  for (Index i = 0; i < n; ++i) MB.col(i) = mass_times(flow, point, B.col(i));
  return std::log(std::fabs(reference::determinant<double>(B.transpose() * MB)));
}

/// Rate (1/s) at which volumes in phase space shrink, of coordinates and momenta: in (y, z) a volume changes
/// with det Bᵀ M B too, which damps nothing.
double shrinking(const Flow<double>& flow, const Local& local, const model::Tangent& tangent) {
  const std::size_t positions = flow.position_count();
  double speed = 0;
  for (std::size_t i = positions; i < flow.size(); ++i) speed = std::max(speed, std::fabs(local.point->x[i]));
  if (speed == 0) return -local.A.trace();
  const double time = std::cbrt(flow.table().unit_roundoff) / speed;
  const std::vector<double> rates = flow.rates(local.point->t, local.point->x);
  const auto after = [&](double dt) {
    Point<double> moved = *local.point;
    for (std::size_t i = positions; i < flow.size(); ++i)
      moved = moved_along(moved, tangent, i - positions, dt * local.point->x[i]);
    for (const model::Tangent::Scalar& s : tangent.scalars)
      if (s.velocity >= flow.size() - positions) moved.x[s.position] += dt * rates[s.position];
    moved = flow.closed(std::move(moved));
    const LocalCoordinates there = local_coordinates(flow, moved, tangent);
    return log_inertia(flow, moved, there.rows() == local.coordinates.rows() ? there : local.coordinates);
  };
  return -local.A.trace() - (after(time) - after(-time)) / (2 * time);
}

/// Do volumes in phase space shrink in the mean, beyond what differences see?
bool damps(const Flow<double>& flow, const std::vector<Local>& locals, const model::Tangent& tangent) {
  const double seen = 100 * std::pow(flow.table().unit_roundoff, 2.0 / 3);
  double sum = 0, fastest = 0;
  for (const Local& local : locals) {
    sum += shrinking(flow, local, tangent);
    fastest = std::max(fastest, fastest_of(local.modes));
  }
  return sum / static_cast<double>(locals.size()) > seen * fastest;
}

/// Oscillating modes (Im µ > 0), by |µ|.
std::vector<Index> oscillations_of(const Modes& modes) {
  std::vector<Index> list;
  for (Index i = 0; i < modes.values.size(); ++i)
    if (modes.values[i].imag() > 0) list.push_back(i);
  std::stable_sort(list.begin(), list.end(),
                   [&](Index a, Index b) { return std::abs(modes.values[a]) < std::abs(modes.values[b]); });
  return list;
}

/// Frozen eigenvalues wander off to both sides as the scene moves. Each oscillation gets the mean damping
/// ratio −Re µ/|µ| of those of its rank by |µ| along the way, where there are as many everywhere; none where
/// that is little beside what they wander.
void average_damping(std::vector<Local>& locals) {
  std::vector<std::vector<Index>> ranked;
  for (const Local& local : locals) ranked.push_back(oscillations_of(local.modes));
  for (const std::vector<Index>& list : ranked)
    if (list.size() != ranked.front().size()) return;
  for (std::size_t rank = 0; rank < ranked.front().size(); ++rank) {
    constexpr double kOfWandering = 0.1;
    double mean = 0, least = INFINITY, most = -INFINITY;
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const Complex mu = locals[k].modes.values[ranked[k][rank]];
      const double ratio = mu.real() / std::abs(mu);
      mean += ratio / static_cast<double>(locals.size());
      least = std::min(least, ratio);
      most = std::max(most, ratio);
    }
    if (std::fabs(mean) < kOfWandering * (most - least)) mean = 0;
    for (std::size_t k = 0; k < locals.size(); ++k) {
      const Index i = ranked[k][rank];
      const Complex mu = locals[k].modes.values[i];
      const Complex judged(mean * std::abs(mu), std::sqrt(1 - mean * mean) * std::abs(mu));
      locals[k].judged[i] = judged;
      locals[k].judged[index_of(std::conj(mu), locals[k].modes)] = std::conj(judged);
    }
  }
}

/// Volumes may shrink then though energy is kept: what rolls rights itself.
bool binds_velocities(const std::vector<Local>& locals) {
  return !locals.empty() &&
         locals.front().coordinates.displacements.size() > locals.front().coordinates.velocities.size();
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
    const Modes modes = modes_of(A);
    locals.push_back({&point, std::move(coordinates), A, modes, modes.values});
  }
  if (!locals.empty()) average_damping(locals);
  return locals;
}

Scene describe_scene(const Flow<double>& flow, const ReferenceSolution& reference,
                     const std::vector<Local>& locals, const model::Tangent& tangent, bool conserves_energy) {
  return {trajectory_rate(flow, reference, tangent), reference.points.back().t - reference.points.front().t,
          flow.table().unit_roundoff,
          (!conserves_energy || still_velocities(flow, tangent) > 0 || binds_velocities(locals)) &&
              damps(flow, locals, tangent)};
}

double trajectory_rate(const Flow<double>& flow, const ReferenceSolution& reference,
                       const model::Tangent& tangent) {
  constexpr std::size_t kMost = 2000;
  const std::size_t stride = 1 + reference.points.size() / kMost;
  const auto n = static_cast<Index>(flow.size() - flow.position_count()),
             states = static_cast<Index>(still_velocities(flow, tangent));
  double motion = 0, change = 0, turning = 0, count = 0;
  VectorXd sizes = VectorXd::Zero(states), changes = sizes;  // of states
  for (std::size_t k = 0; k < reference.points.size(); k += stride, ++count) {
    const Point<double>& point = reference.points[k];
    const std::vector<double> rates = flow.rates(point.t, point.x);
    VectorXd z = Eigen::Map<const VectorXd>(point.x.data() + flow.position_count(), n),
             zdot = Eigen::Map<const VectorXd>(rates.data() + flow.position_count(), n);
    sizes += z.tail(states).cwiseAbs();
    changes += zdot.tail(states).cwiseAbs();
    z.tail(states).setZero();
    zdot.tail(states).setZero();
    motion += z.dot(mass_times(flow, point, z));
    change += zdot.dot(mass_times(flow, point, zdot));
    for (const model::Tangent::Scalar& s : tangent.quaternions)
      turning = std::max(turning, z.segment(static_cast<Index>(s.velocity), 3).norm() / 2);
  }
  const double slowest = 1 / (reference.points.back().t - reference.points.front().t);
  const double rate = motion > 0 ? std::sqrt(std::max(0.0, change) / motion) : 0;
  double of_states = 0;
  for (Index i = 0; i < states; ++i)
    if (sizes[i] > 0) of_states = std::max(of_states, changes[i] / sizes[i]);
  return std::max({slowest, turning, rate, of_states});
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
