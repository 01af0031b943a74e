#include "studies/mode_limits.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kUndamped = 1e-9;  ///< |Re µ| over |µ| that differences do not see
constexpr double kResolved = 0.5;   ///< |hµ| of steps that follow a mode well
constexpr double kGrowthMissed =
    0.05;                      ///< share of |µ| by which a growing mode may grow faster than it should
constexpr double kStiff = 10;  ///< a mode faster, and a limit shorter, than the trajectory's own by this

bool is_fast(Complex mu, const Scene& scene) {
  constexpr double kAbove = 3;  // an oscillation has the rate that it would have as the motion
  return std::abs(mu) > kAbove * scene.rate;
}

/// Methods that let every undamped mode grow get the h up to which one grows e-fold over the whole trajectory:
/// that is what competes with the limits of damped modes.
double limit_of_mode(const StabilityFunction& function, Complex mu, ModeKind kind, const Scene& scene) {
  const Complex oscillation(0, std::abs(mu));
  switch (kind) {
    case ModeKind::kDamped:
      return step_limit(function, mu, {});
    case ModeKind::kUndamped:
      return step_limit(function, oscillation, {keeps_oscillations(function) ? 0 : 1 / scene.duration});
    case ModeKind::kGrowing:
      return step_limit(function, mu, {std::fabs(mu.real()) + kGrowthMissed * std::abs(mu)});
  }
  return INFINITY;
}

/// Smallest limit over the fast modes of one point, or over the slow ones.
MethodLimit limit_by_modes(const StabilityFunction& function, const Local& local, const Scene& scene,
                           bool fast) {
  // Slow modes compete with nothing: a method that lets an undamped one grow has no stable step.
  const Scene judged = {scene.rate, fast ? scene.duration : INFINITY, scene.roundoff, scene.damps};
  MethodLimit result;
  result.h = INFINITY;
  for (const Complex mu : local.judged) {
    const bool above = is_fast(mu, scene);
    if (mu.imag() < 0 || above != fast || negligible(mu, local.modes, scene)) continue;
    const ModeKind kind = kind_of(mu, scene);
    const double h = limit_of_mode(function, mu, kind, judged);
    if (h < result.h) result = {0, h, local.point->t, mu, kind, fast, false, false, {}, {}};
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
  result.fast = is_fast(result.mode, scene);
  return result;
}

MethodLimit local_limit(const StabilityFunction* function, const Local& local, const Scene& scene) {
  MethodLimit none;
  none.h = INFINITY;
  if (!function) return none;
  const bool partitioned = function->kind == StabilityFunction::Kind::kPartitioned;
  // Where velocities alone are bound positions follow dependent velocities, too, which the linear system leaves out.
  if (partitioned && 2 * local.positions() != local.A.rows()) return none;
  if (partitioned) return limit_by_system(*function, local, scene);
  const MethodLimit fast = limit_by_modes(*function, local, scene, true);
  return fast.h < INFINITY ? fast : limit_by_modes(*function, local, scene, false);
}

/// Eigenvalues of large matrices cost too much to be taken at every point.
std::size_t stride_of(const StabilityFunction* function, const std::vector<Local>& locals) {
  constexpr Index kSmall = 12;
  if (!function || function->kind != StabilityFunction::Kind::kPartitioned) return 1;
  return static_cast<std::size_t>(1 + locals.front().A.rows() / kSmall);
}

/// What is said: a method that lets every undamped mode grow has no stable step where such a mode decides.
double stated(const MethodLimit& limit, const StabilityFunction* function) {
  const bool none = function && limit.kind == ModeKind::kUndamped && !keeps_oscillations(*function);
  return none && limit.h < INFINITY ? 0 : limit.h;
}

/// Do frozen coefficients hold: is `decisive`, the smallest of `limits`, of a mode that outpaces every change
/// of them, or are they all the same?
bool predicts(const MethodLimit& decisive, const std::vector<MethodLimit>& limits, const Scene& scene) {
  constexpr double kOutpaces = 30, kSame = 1.02, kFewestSteps = 4;
  if (decisive.kind == ModeKind::kGrowing || !(decisive.h < scene.duration / kFewestSteps)) return false;
  if (std::abs(decisive.mode) > kOutpaces * scene.rate) return true;
  return std::all_of(limits.begin(), limits.end(),
                     [&](const MethodLimit& limit) { return limit.h <= kSame * decisive.h; });
}

}  // namespace

double largest_stable_step(const MethodLimit& limit) {
  if (limit.predicts) return limit.h;
  return limit.observed ? limit.observed->h : INFINITY;
}

bool is_beyond(const MethodLimit& limit, double h) { return limit.predicts && limit.h > 0 && h > limit.h; }

ModeKind kind_of(Complex mu, const Scene& scene) {
  // Where nothing damps, what decays is the other half of what grows.
  if (!scene.damps)
    return std::fabs(mu.imag()) >= std::fabs(mu.real()) ? ModeKind::kUndamped : ModeKind::kGrowing;
  if (std::fabs(mu.real()) <= kUndamped * std::abs(mu)) return ModeKind::kUndamped;
  return mu.real() < 0 ? ModeKind::kDamped : ModeKind::kGrowing;
}

LimitsAlong limits_along(std::string_view method, const std::vector<Local>& locals, const Scene& scene) {
  const StabilityFunction* function = stability_function(method);
  const std::size_t stride = stride_of(function, locals);
  std::vector<MethodLimit> limits;
  for (std::size_t k = 0; k < locals.size(); ++k)
    limits.push_back(k % stride == 0 ? local_limit(function, locals[k], scene) : limits.back());
  const auto decides = [](const MethodLimit& limit) { return limit.fast && limit.h < INFINITY; };
  const bool any_fast = std::any_of(limits.begin(), limits.end(), decides);
  LimitsAlong result;
  result.smallest.h = INFINITY;
  for (const MethodLimit& limit : limits) {
    if (limit.h < result.smallest.h && (limit.fast || !any_fast)) result.smallest = limit;
    result.limits.push_back(stated(limit, function));
  }
  result.smallest.predicts = predicts(result.smallest, limits, scene);
  if (!result.smallest.predicts) result.limits.assign(locals.size(), INFINITY);
  result.smallest.h = stated(result.smallest, function);
  return result;
}

bool is_stiff(const MethodLimit& limit, double rate) {
  return limit.kind == ModeKind::kDamped && limit.h > 0 && std::abs(limit.mode) > kStiff * rate &&
         largest_stable_step(limit) * rate * kStiff < 1;
}

}  // namespace jourdain::studies
