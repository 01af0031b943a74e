#include "studies/stability.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;
using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kPoints = 60;
constexpr double kUndamped = 1e-3;      ///< |Re µ| over |µ| up to which a mode neither decays nor grows
constexpr double kDampingScene = 1e-2;  ///< shrinking of volumes over the trajectory's own rate
constexpr double kResolved = 0.5;       ///< |hµ| of steps that follow a mode well
constexpr double kGrowthMissed =
    0.05;                      ///< share of |µ| by which a growing mode may grow faster than it should
constexpr double kStiff = 10;  ///< a mode faster, and a limit shorter, than the trajectory's own by this
constexpr double kShownShare = 0.01;
constexpr double kFailing = 1.02;  ///< beyond the limit, where the length of runs is chosen

struct Scene {
  double rate = 0, duration = 0, roundoff = 0;
  bool damps = false;
};

/// The linear system at one time.
struct Local {
  const Point<double>* point = nullptr;
  MatrixXd A;
  Modes modes;
};

ModeKind kind_of(Complex mu, const Scene& scene) {
  if (!scene.damps && std::fabs(mu.imag()) >= std::fabs(mu.real())) return ModeKind::kUndamped;
  if (std::fabs(mu.real()) <= kUndamped * std::abs(mu)) return ModeKind::kUndamped;
  return mu.real() < 0 ? ModeKind::kDamped : ModeKind::kGrowing;
}

/// Methods that let every undamped mode grow get the h up to which one grows e-fold over the whole trajectory: that is what
/// competes with the limits of damped modes.
double limit_of_mode(const StabilityFunction& function, Complex mu, ModeKind kind, const Scene& scene) {
  const Complex oscillation(0, std::abs(mu));
  switch (kind) {
    case ModeKind::kDamped:
      return step_limit(function, mu, {});
    case ModeKind::kUndamped:
      return step_limit(function, oscillation, {keeps_oscillations(function) ? 0 : 1 / scene.duration});
    case ModeKind::kGrowing:
      return step_limit(function, mu, {mu.real() + kGrowthMissed * std::abs(mu)});
  }
  return INFINITY;
}

double fastest_of(const Modes& modes) { return modes.values.cwiseAbs().maxCoeff(); }

/// Modes that are zero but for rounding: of a double zero half the digits are lost.
bool negligible(Complex mu, const Modes& modes, const Scene& scene) {
  return std::abs(mu) <= std::max(0.1 / scene.duration, std::cbrt(scene.roundoff) * fastest_of(modes));
}

/// Smallest limit over the fast modes of one point, or over the slow ones.
MethodLimit limit_by_modes(const StabilityFunction& function, const Local& local, const Scene& scene,
                           bool fast) {
  // Slow modes compete with nothing: a method that lets an undamped one grow has no stable step.
  const Scene judged = {scene.rate, fast ? scene.duration : INFINITY, scene.roundoff, scene.damps};
  MethodLimit result;
  result.h = INFINITY;
  for (const Complex mu : local.modes.values) {
    const bool above = std::abs(mu) > scene.rate;
    if (mu.imag() < 0 || above != fast || negligible(mu, local.modes, scene)) continue;
    const ModeKind kind = kind_of(mu, scene);
    const double h = limit_of_mode(function, mu, kind, judged);
    if (h < result.h) result = {0, h, local.point->t, mu, kind, fast, {}};
  }
  return result;
}

/// Of a method that the whole linear system decides on.
MethodLimit limit_by_system(const StabilityFunction& function, const Local& local, const Scene& scene) {
  MethodLimit result;
  double growth = 0;
  for (const Complex mu : local.modes.values) {
    growth = std::max(growth, mu.real());
    if (std::abs(mu) > std::abs(result.mode) && mu.imag() >= 0) result.mode = mu;
  }
  result.h = INFINITY;
  if (negligible(result.mode, local.modes, scene)) return result;
  result.h = step_limit(function, local.A, std::abs(result.mode), {growth + 1 / scene.duration});
  result.time = local.point->t;
  result.kind = kind_of(result.mode, scene);
  if (result.kind == ModeKind::kUndamped && result.h * std::abs(result.mode) < kResolved) result.h = 0;
  result.fast = std::abs(result.mode) > scene.rate;
  return result;
}

MethodLimit local_limit(const StabilityFunction* function, const Local& local, const Scene& scene) {
  MethodLimit none;
  none.h = INFINITY;
  if (!function) return none;
  if (function->kind == StabilityFunction::Kind::kPartitioned)
    return limit_by_system(*function, local, scene);
  const MethodLimit fast = limit_by_modes(*function, local, scene, true);
  return fast.h < INFINITY ? fast : limit_by_modes(*function, local, scene, false);
}

/// Limits of one method along the trajectory; the smallest goes to `result`.
MethodLimit limits_along(std::size_t method, std::string_view name, const std::vector<Local>& locals,
                         const Scene& scene, std::vector<StabilityPoint>& points) {
  MethodLimit result;
  result.method = method;
  result.h = INFINITY;
  const StabilityFunction* function = stability_function(name);
  std::vector<MethodLimit> limits;
  for (const Local& local : locals) limits.push_back(local_limit(function, local, scene));
  const auto decides = [](const MethodLimit& limit) { return limit.fast && limit.h < INFINITY; };
  const bool any_fast = std::any_of(limits.begin(), limits.end(), decides);
  for (const MethodLimit& limit : limits)
    if (limit.h < result.h && (limit.fast || !any_fast)) result = limit;
  const auto stated = [function](const MethodLimit& limit) {
    const bool none = function && limit.kind == ModeKind::kUndamped && !keeps_oscillations(*function);
    return none && limit.h < INFINITY ? 0 : limit.h;
  };
  for (std::size_t k = 0; k < limits.size(); ++k) points[k].limits.push_back(stated(limits[k]));
  result.h = stated(result);
  result.method = method;
  return result;
}

/// ln det M from inverse dynamics, whose differences in ż are its columns; 0 where there is none.
double log_inertia(const Flow<double>& flow, const Point<double>& point) {
  if (!flow.table().inverse_dynamics) return 0;
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
  return std::log(std::fabs(M.determinant()));
}

/// Mean rate (1/s) at which volumes in phase space shrink. In (y, z) a volume changes with det M too, which damps nothing.
double shrinking(const Flow<double>& flow, const std::vector<Local>& locals) {
  if (locals.size() < 2) return -locals.front().A.trace();
  double traces = 0;
  for (std::size_t k = 1; k < locals.size(); ++k)
    traces +=
        (locals[k].point->t - locals[k - 1].point->t) * (locals[k].A.trace() + locals[k - 1].A.trace()) / 2;
  const Point<double>&first = *locals.front().point, &last = *locals.back().point;
  return -(traces + log_inertia(flow, last) - log_inertia(flow, first)) / (last.t - first.t);
}

std::vector<Local> linearise(const Flow<double>& flow, const ReferenceSolution& reference,
                             const std::vector<std::size_t>& quaternions, double seconds, Stability& result,
                             const Progress& progress) {
  const auto begin = Clock::now();
  std::vector<Local> locals;
  const std::size_t last = reference.points.size() - 1, count = std::min(kPoints, last);
  for (std::size_t k = 0; k <= count; ++k) {
    const double spent = std::chrono::duration<double>(Clock::now() - begin).count();
    progress("stability", 0.5 * double(k) / double(count));
    if (spent > seconds) {
      result.partial = true;
      break;
    }
    const Point<double>& point = reference.points[k * last / count];
    const MatrixXd A = linearisation(flow, point, quaternions);
    if (!A.allFinite()) continue;
    locals.push_back({&point, A, modes_of(A)});
  }
  return locals;
}

StabilityPoint point_of(const Local& local, const Scene& scene) {
  StabilityPoint point;
  point.time = local.point->t;
  point.eigenvalues.assign(local.modes.values.begin(), local.modes.values.end());
  point.fastest = fastest_of(local.modes);
  for (const Complex mu : local.modes.values)
    if (kind_of(mu, scene) == ModeKind::kDamped)
      point.stiffness = std::max(point.stiffness, -mu.real() / scene.rate);
  return point;
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

void name_owners(const Flow<double>& flow, const std::vector<Local>& locals, Stability& result) {
  for (const Local& local : locals)
    for (const Complex mu : local.modes.values)
      if (mu.imag() >= 0 && std::abs(mu) > std::abs(result.fastest)) {
        result.fastest = mu;
        result.fastest_time = local.point->t;
      }
  const Modes& modes = local_at(locals, result.fastest_time).modes;
  const VectorXd shares = modes.participations.col(index_of(result.fastest, modes));
  for (Index i = 0; i < shares.size(); ++i)
    if (shares[i] >= kShownShare) result.owners.push_back({flow.table().velocity_names[i], shares[i]});
  std::stable_sort(result.owners.begin(), result.owners.end(),
                   [](const CoordinateShare& a, const CoordinateShare& b) { return a.share > b.share; });
}

/// Largest ‖R(hA)^k‖ at nine tenths of the limit: what eigenvalues do not show. Damped modes only die out slowly where the
/// spectral radius is near one, hence the bounded number of steps.
void look_for_transients(const Flow<double>& flow, const std::vector<Local>& locals, Stability& result) {
  constexpr int kSteps = 300;
  for (const MethodLimit& limit : result.limits) {
    const StabilityFunction* function = stability_function(flow.table().methods[limit.method].name);
    if (!function || function->kind != StabilityFunction::Kind::kOneStep ||
        function->denominator.size() > 1 || !(limit.h > 0) || !std::isfinite(limit.h))
      continue;
    const Local& local = local_at(locals, limit.time);
    const VectorXd& d = local.modes.scales;
    const MatrixXd step =
        d.cwiseInverse().asDiagonal() * step_matrix(*function, local.A, 0.9 * limit.h) * d.asDiagonal();
    MatrixXd power = step;
    const double radius = std::max(1.0, spectral_radius(step));
    double peak = 1;
    for (int k = 1; k <= kSteps; ++k, power = step * power / radius)
      peak = std::max(peak, power.jacobiSvd().singularValues()[0]);
    result.transient_growth = peak;
    result.transient_method = function->method;
    if (function->method == "rk4") break;  // the default stepper where it is there, else the last one
  }
}

bool is_stiff(const MethodLimit& limit, double rate) {
  return limit.kind == ModeKind::kDamped && limit.h > 0 && std::abs(limit.mode) > kStiff * rate &&
         limit.h * rate * kStiff < 1;
}

double growth_beyond(const StabilityFunction& function, const MethodLimit& limit, const Local& local) {
  const double h = kFailing * limit.h;
  if (function.kind == StabilityFunction::Kind::kPartitioned)
    return spectral_radius(step_matrix(function, local.A, h));
  const Complex mu = limit.kind == ModeKind::kUndamped ? Complex(0, std::abs(limit.mode)) : limit.mode;
  return amplification(function, h * mu);
}

/// Real velocities of an eigenvector, whose phase is arbitrary.
VectorXd velocities_of(Complex mu, const Modes& modes) {
  const Eigen::VectorXcd z = modes.right.col(index_of(mu, modes)).tail(modes.right.rows() / 2);
  return z.real().norm() > z.imag().norm() ? VectorXd(z.real()) : VectorXd(z.imag());
}

VectorXd largest_velocities(const Flow<double>& flow, const ReferenceSolution& reference) {
  VectorXd largest = VectorXd::Zero(static_cast<Index>(flow.size() - flow.position_count()));
  for (const Point<double>& point : reference.points)
    for (std::size_t i = flow.position_count(); i < flow.size(); ++i) {
      double& entry = largest[static_cast<Index>(i - flow.position_count())];
      entry = std::max(entry, std::fabs(point.x[i]));
    }
  return largest;
}

void observe(const Flow<double>& flow, const ReferenceSolution& reference, const std::vector<Local>& locals,
             double seconds, Stability& result, const Progress& progress) {
  const VectorXd largest = largest_velocities(flow, reference);
  for (MethodLimit& limit : result.limits) {
    progress("step limits", 0.5 + 0.5 * double(limit.method) / double(result.limits.size()));
    const jourdain_method& method = flow.table().methods[limit.method];
    const StabilityFunction* function = stability_function(method.name);
    if (!function || !(limit.h > 0) || !std::isfinite(limit.h) || limit.kind == ModeKind::kGrowing) continue;
    const Local& local = local_at(locals, limit.time);
    const VectorXd direction = velocities_of(limit.mode, local.modes);
    if (!(direction.norm() > 0)) continue;
    const LimitRuns runs{*local.point,
                         direction,
                         largest,
                         limit.h,
                         growth_beyond(*function, limit, local),
                         limit.kind,
                         is_stiff(limit, result.rate)};
    limit.observed = observe_limit(flow, method, runs, seconds / static_cast<double>(result.limits.size()));
  }
}

}  // namespace

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

const MethodLimit* stiff_limit(const Stability& stability) {
  const MethodLimit* longest = nullptr;
  for (const MethodLimit& limit : stability.limits) {
    const bool stiff = is_stiff(limit, stability.rate);
    if (stiff && (!longest || limit.h > longest->h)) longest = &limit;
  }
  return longest;
}

Stability study_stability(const Flow<double>& flow, const ReferenceSolution& reference,
                          const std::vector<std::size_t>& quaternions, bool conserves_energy, double seconds,
                          const Progress& progress) {
  Stability result;
  const std::vector<Local> locals = linearise(flow, reference, quaternions, seconds / 2, result, progress);
  if (locals.empty()) return result;
  Scene scene{trajectory_rate(flow, reference), reference.points.back().t - reference.points.front().t,
              flow.table().unit_roundoff, false};
  scene.damps = !conserves_energy && shrinking(flow, locals) > kDampingScene * scene.rate;
  result.rate = scene.rate;
  result.damps = scene.damps;
  for (const Local& local : locals) {
    result.points.push_back(point_of(local, scene));
    result.stiffness = std::max(result.stiffness, result.points.back().stiffness);
  }
  for (int m = 0; m < flow.table().method_count; ++m)
    result.limits.push_back(
        limits_along(std::size_t(m), flow.table().methods[m].name, locals, scene, result.points));
  name_owners(flow, locals, result);
  look_for_transients(flow, locals, result);
  observe(flow, reference, locals, seconds / 2, result, progress);
  return result;
}

}  // namespace jourdain::studies
