#include "studies/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "studies/spectra.hpp"

namespace jourdain::studies {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShort =
    4e-3;  ///< of the trajectory's own time: a step so short that 2000 of them see it hardly move
constexpr double kShownShare = 0.01;
constexpr double kFailing = 1.02;  ///< beyond the limit, where the length of runs is chosen

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

/// Of displacements by direction: of the velocities, then of coordinates that are carried along.
std::vector<std::string> names_of(const Flow<double>& flow, const model::Tangent& tangent) {
  const jourdain_model_table& table = flow.table();
  std::vector<std::string> names(table.velocity_names, table.velocity_names + table.velocity_count);
  for (const model::Tangent::Scalar& s : tangent.scalars)
    if (s.velocity >= static_cast<std::size_t>(table.velocity_count))
      names.emplace_back(table.position_names[s.position]);
  return names;
}

void name_owners(const std::vector<std::string>& names, const std::vector<Local>& locals, Stability& result) {
  for (const Local& local : locals)
    for (const Complex mu : local.modes.values)
      if (mu.imag() >= 0 && std::abs(mu) > std::abs(result.fastest)) {
        result.fastest = mu;
        result.fastest_time = local.point->t;
      }
  const Local& local = local_at(locals, result.fastest_time);
  const Modes& modes = local.modes;
  const VectorXd shares = modes.participations.col(index_of(result.fastest, modes));
  VectorXd by_entry = VectorXd::Zero(static_cast<Index>(names.size()));
  const std::vector<std::size_t> entries = local.coordinates.rows();
  for (std::size_t i = 0; i < entries.size(); ++i)
    by_entry[static_cast<Index>(entries[i])] += shares[Index(i)];
  for (Index i = 0; i < by_entry.size(); ++i)
    if (by_entry[i] >= kShownShare) result.owners.push_back({names[std::size_t(i)], by_entry[i]});
  std::stable_sort(result.owners.begin(), result.owners.end(),
                   [](const CoordinateShare& a, const CoordinateShare& b) { return a.share > b.share; });
}

/// Largest ‖R(hA)^k‖ over that of no step at all: what eigenvalues do not show. Coordinates that just drift are left
/// out, and so is what grows anyway.
double transient_growth(const StabilityFunction& function, const Local& local, double h, const Scene& scene) {
  constexpr int kSteps = 300;  // modes near the limit die out slowly
  const VectorXd& d = local.modes.scales;
  const MatrixXd step = d.cwiseInverse().asDiagonal() * step_matrix(function, local.A, h) * d.asDiagonal();
  const Eigen::MatrixXcd right = d.cwiseInverse().asDiagonal() * local.modes.right;
  Eigen::VectorXcd kept = Eigen::VectorXcd::Ones(right.cols());
  for (Index i = 0; i < kept.size(); ++i)
    if (negligible(local.modes.values[i], local.modes, scene)) kept[i] = 0;
  MatrixXd power = (right * kept.asDiagonal() * inverse(right)).real();
  const double none = std::max(1.0, power.norm()), radius = std::max(1.0, spectral_radius(step));
  double peak = 1;
  for (int k = 1; k <= kSteps; ++k) {
    power = step * power / radius;
    peak = std::max(peak, power.norm() / none);
  }
  return peak;
}

/// For the default stepper where it is there and has a limit, else for the last one that does.
void look_for_transients(const Flow<double>& flow, const std::vector<Local>& locals, const Scene& scene,
                         Stability& result) {
  constexpr double kWithin = 0.9;  // of the limit
  for (const MethodLimit& limit : result.limits) {
    const StabilityFunction* function = stability_function(flow.table().methods[limit.method].name);
    const bool polynomial =
        function && function->kind == StabilityFunction::Kind::kOneStep && function->denominator.size() == 1;
    if (!polynomial || !limit.predicts || !(limit.h > 0) || result.transient_method == "rk4") continue;
    const Local& local = local_at(locals, limit.time);
    if (local.modes.defective) continue;
    result.transient_growth = transient_growth(*function, local, kWithin * limit.h, scene);
    result.transient_method = function->method;
  }
}

double growth_beyond(const StabilityFunction& function, const MethodLimit& limit, const Local& local) {
  const double h = kFailing * limit.h;
  if (function.kind == StabilityFunction::Kind::kPartitioned)
    return spectral_radius(step_matrix(function, local.A, h));
  const Complex mu = limit.kind == ModeKind::kUndamped ? Complex(0, std::abs(limit.mode)) : limit.mode;
  return amplification(function, h * mu);
}

/// Real velocities of an eigenvector, whose phase is arbitrary.
VectorXd velocities_of(Complex mu, const Local& local) {
  const Eigen::MatrixXd& embedding = local.coordinates.embedding;
  const Eigen::VectorXcd x = embedding * local.modes.right.col(index_of(mu, local.modes));
  const Eigen::VectorXcd z = x.tail(x.size() - local.coordinates.all_displacements);
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
  Budget budget(seconds);
  for (MethodLimit& limit : result.limits) {
    progress("step limits", 0.5 + 0.5 * double(limit.method) / double(result.limits.size()));
    const jourdain_method& method = flow.table().methods[limit.method];
    const StabilityFunction* function = stability_function(method.name);
    if (limit.predicts && !(limit.h > 0)) continue;
    if (!limit.predicts) {
      const double share = budget.left() / static_cast<double>(result.limits.size() - limit.method);
      Budget part(share);
      const double duration = reference.points.back().t - reference.points.front().t;
      const NonlinearLimit seen = observe_nonlinear_limit(flow, method, largest, duration, part);
      limit.observed = seen.fails;
      limit.stable_until = seen.holds;
      budget.spend(share - part.left());
      continue;
    }
    const Local& local = local_at(locals, limit.time);
    const VectorXd direction = velocities_of(limit.mode, local);
    if (!(direction.norm() > 0)) continue;
    const LimitRuns runs{*local.point,
                         direction,
                         largest,
                         limit.h,
                         growth_beyond(*function, limit, local),
                         limit.kind,
                         limit.h * result.rate < kShort};
    const double share = budget.left() / static_cast<double>(result.limits.size() - limit.method);
    Budget part(share);
    limit.observed = observe_limit(flow, method, runs, part);
    budget.spend(share - part.left());
  }
}

}  // namespace

namespace {

/// Of an L-stable method; nothing is predicted of one that leaves derivatives out.
LimitsAlong no_limits(std::size_t count, bool is_whole) {
  LimitsAlong along;
  along.limits.assign(count, std::numeric_limits<double>::infinity());
  along.smallest.h = std::numeric_limits<double>::infinity();
  along.smallest.implicit = is_whole;
  return along;
}

bool carries_along(const Flow<double>& flow, const model::Tangent& tangent) {
  return std::any_of(tangent.scalars.begin(), tangent.scalars.end(), [&](const model::Tangent::Scalar& s) {
    return s.velocity >= static_cast<std::size_t>(flow.table().velocity_count);
  });
}

}  // namespace

const MethodLimit* stiff_limit(const Stability& stability) {
  const MethodLimit* longest = nullptr;
  for (const MethodLimit& limit : stability.limits)
    if (const double h = largest_stable_step(limit);
        h > 0 && std::isfinite(h) && !limit.implicit && (!longest || h > largest_stable_step(*longest)))
      longest = &limit;
  return longest && is_stiff(*longest, stability.rate) ? longest : nullptr;
}

Stability study_stability(const Flow<double>& flow, const ReferenceSolution& reference,
                          const model::Tangent& tangent, bool conserves_energy, double seconds,
                          const Progress& progress) {
  Stability result;
  const std::vector<Local> locals = linearise(flow, reference, tangent, progress);
  if (locals.empty()) return result;
  const Scene scene = describe_scene(flow, reference, locals, tangent, conserves_energy);
  result.rate = scene.rate;
  result.damps = scene.damps;
  for (const Local& local : locals) {
    result.points.push_back(point_of(local, scene));
    result.stiffness = std::max(result.stiffness, result.points.back().stiffness);
  }
  for (int m = 0; m < flow.table().method_count; ++m) {
    const jourdain_method& method = flow.table().methods[m];
    const LimitsAlong along = method.implicit ? no_limits(locals.size(), !carries_along(flow, tangent))
                                              : limits_along(method.name, locals, scene);
    for (std::size_t k = 0; k < locals.size(); ++k) result.points[k].limits.push_back(along.limits[k]);
    result.limits.push_back(along.smallest);
    result.limits.back().method = static_cast<std::size_t>(m);
  }
  name_owners(names_of(flow, tangent), locals, result);
  look_for_transients(flow, locals, scene, result);
  observe(flow, reference, locals, 3 * seconds / 4, result, progress);
  return result;
}

}  // namespace jourdain::studies
