// Limits of the step length as runs show them, to check the predicted ones against.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "studies/stability.hpp"

namespace jourdain::studies {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kDisplacement = 1e-6;  ///< of the largest velocity: small, so that the linear picture holds
constexpr double kDiverged = 10;        ///< times the largest of the same velocity in the reference
constexpr double kMoving =
    1e-2;                      ///< of the largest velocity: entries that move less count as if they moved so
constexpr double kGrown = 40;  ///< logarithm of the growth that a run 2 % beyond the limit has time for
constexpr long kFewestSteps = 2000, kMostSteps = 1000000;
constexpr long kFewestDampedSteps =
    500;  ///< some hundred time constants; nearby trajectories may part by themselves later
constexpr double kParted = 1e-3;  ///< of the largest velocity: difference of runs that part
constexpr double kMostRuns = 15;  ///< that a search takes
constexpr int kFiner = 8;
constexpr int kWidenings = 7;
constexpr double kWidening = 1.2;
constexpr double kResolution = 1.005;

/// One start, many step lengths.
class Runs {
 public:
  Runs(const Flow<double>& flow, const jourdain_method& method, const LimitRuns& setting, double seconds)
      : flow_(flow),
        method_(method),
        start_(setting.start),
        undisplaced_(setting.start),
        damped_(setting.kind == ModeKind::kDamped),
        ratio_(setting.stiff ? kFiner : 1) {
    deadline_ =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const double largest = setting.largest.maxCoeff(), scale = largest > 0 ? largest : 1;
    scales_ = setting.largest.cwiseMax(kMoving * scale);
    velocities(start_) +=
        kDisplacement * scale / setting.direction.lpNorm<Eigen::Infinity>() * setting.direction;
    const double wanted = kGrown / std::log(std::max(setting.growth, 1 + 1e-9));
    const double fewest = static_cast<double>(damped_ && ratio_ == 1 ? kFewestDampedSteps : kFewestSteps);
    const double most = std::min(1.0 * kMostSteps, seconds / kMostRuns / step_time(setting.predicted));
    steps_ = static_cast<long>(std::clamp(wanted, fewest, std::max(fewest, most)));
  }

  long steps() const { return steps_; }

  /// Nothing where the time is over.
  std::optional<bool> diverges(double h) const {
    constexpr long kBlock = 50;
    // A method that damps less than the scene does may resonate with what drives it: no sign of divergence.
    const double bound = damped_ ? INFINITY : kDiverged;
    Point<double> point = start_, companion = ratio_ > 1 ? start_ : undisplaced_;
    Memory memory = flow_.fresh_memory(method_), companions = memory;
    for (long done = 0; done < steps_; done += kBlock) {
      if (Clock::now() > deadline_) return {};
      flow_.step(method_, point, h, kBlock, memory);
      if (beyond(velocities(point), bound)) return true;
      if (!damped_) continue;
      flow_.step(method_, companion, h / ratio_, kBlock * ratio_, companions);
      if (parted(velocities(point) - velocities(companion))) return true;
    }
    return false;
  }

 private:
  /// Of the run and its companion, s.
  double step_time(double predicted) const {
    constexpr int kSteps = 500;
    Point<double> point = start_;
    Memory memory = flow_.fresh_memory(method_);
    const auto begin = Clock::now();
    flow_.step(method_, point, predicted / kFiner, kSteps, memory);
    const double time = std::chrono::duration<double>(Clock::now() - begin).count() / kSteps;
    return damped_ ? (1 + ratio_) * time : time;
  }

  Eigen::Map<Eigen::VectorXd> velocities(Point<double>& point) const {
    const std::size_t first = flow_.position_count();
    return {point.x.data() + first, static_cast<Eigen::Index>(point.x.size() - first)};
  }

  bool beyond(const Eigen::VectorXd& z, double multiple) const {
    return !z.allFinite() || (z.cwiseAbs().array() > multiple * scales_.array()).any();
  }

  bool parted(const Eigen::VectorXd& difference) const {
    if (ratio_ > 1) return beyond(difference, 1);
    return !(difference.lpNorm<Eigen::Infinity>() < kParted * scales_.maxCoeff());
  }

  const Flow<double>& flow_;
  const jourdain_method& method_;
  Point<double> start_, undisplaced_;
  Eigen::VectorXd scales_;  ///< of the velocities
  long steps_ = 0;
  bool damped_;
  int ratio_;  ///< of the run's step and its companion's
  Clock::time_point deadline_;
};

/// h that holds and h that diverges, a step of kWidening apart, around `predicted`.
std::optional<std::pair<double, double>> bracket(const Runs& runs, double predicted) {
  double low = predicted / std::sqrt(kWidening), high = low * kWidening;
  std::optional<bool> first = runs.diverges(low);
  if (!first) return {};
  const bool downward = *first;
  if (downward) high = low, low /= kWidening;
  for (int i = 0; i < kWidenings; ++i) {
    const std::optional<bool> result = runs.diverges(downward ? low : high);
    if (!result) return {};
    if (*result != downward) return std::pair(low, high);
    (downward ? high : low) = downward ? low : high;
    (downward ? low : high) *= downward ? 1 / kWidening : kWidening;
  }
  return {};
}

}  // namespace

std::optional<ObservedLimit> observe_limit(const Flow<double>& flow, const jourdain_method& method,
                                           const LimitRuns& setting, double seconds) {
  const Runs runs(flow, method, setting, seconds);
  auto range = bracket(runs, setting.predicted);
  while (range && range->second > range->first * kResolution) {
    const double middle = std::sqrt(range->first * range->second);
    const std::optional<bool> result = runs.diverges(middle);
    if (!result) return {};
    (*result ? range->second : range->first) = middle;
  }
  if (!range) return {};
  return ObservedLimit{range->second, setting.start.t, runs.steps()};
}

}  // namespace jourdain::studies
