// Limits of the step length as runs show them, to check the predicted ones against.
#include <algorithm>
#include <cmath>

#include "studies/stability.hpp"

namespace jourdain::studies {

namespace {

constexpr double kDisplacement = 1e-6;  ///< of the largest velocity: small, so that the linear picture holds
constexpr double kDiverged = 10;        ///< times the largest of the same velocity in the reference
constexpr double kOff = 1;              ///< the same of a difference that short steps cannot bring about
constexpr double kMoving =
    1e-2;                      ///< of the largest velocity: entries that move less count as if they moved so
constexpr double kGrown = 40;  ///< logarithm of the growth that a run 2 % beyond the limit has time for
constexpr long kFewestSteps = 2000, kMostSteps = 1000000;
constexpr long kFewestDampedSteps =
    500;  ///< some hundred time constants; nearby trajectories may part by themselves later
constexpr double kParted = 100;   ///< times the distance that the motion itself brings about: runs that part
constexpr double kMostRuns = 15;  ///< that a search takes
constexpr int kFiner = 8;
constexpr int kWidenings = 7;
constexpr double kWidening = 1.2;
constexpr double kResolution = 1.005;

/// One start, many step lengths.
class Runs {
 public:
  Runs(const Flow<double>& flow, const jourdain_method& method, const LimitRuns& setting, Budget& budget)
      : flow_(flow),
        method_(method),
        start_(setting.start),
        undisplaced_(setting.start),
        damped_(setting.kind == ModeKind::kDamped),
        stiff_(setting.stiff),
        budget_(budget) {
    const double largest = setting.largest.maxCoeff(), scale = largest > 0 ? largest : 1;
    scales_ = setting.largest.cwiseMax(kMoving * scale);
    // Where two runs are compared the undisplaced one is disturbed as well, by its errors: it saturates first.
    const double displacement =
        damped_ && !stiff_ ? std::max(1e-9, 100 * flow.table().unit_roundoff) : kDisplacement;
    velocities(start_) +=
        displacement * scale / setting.direction.lpNorm<Eigen::Infinity>() * setting.direction;
    const double wanted = kGrown / std::log(std::max(setting.growth, 1 + 1e-9));
    const auto fewest = static_cast<double>(damped_ && !stiff_ ? kFewestDampedSteps : kFewestSteps);
    const int runs = !damped_ ? 1 : stiff_ ? 1 + kFiner : 2 + 2 * kFiner;
    const double most = std::min(1.0 * kMostSteps, budget.left() / kMostRuns / (runs * step_time(method)));
    steps_ = static_cast<long>(std::clamp(wanted, fewest, std::max(fewest, most)));
    // At 5 % beyond the limit growth is 2.5 times as fast as at 2 %.
    const double needed = damped_ && !stiff_ ? kParted : kDiverged / kDisplacement;
    long_enough_ = static_cast<double>(steps_) > std::log(needed) / (2.5 * kGrown) * wanted;
  }

  long steps() const { return steps_; }
  /// Or would runs hold that grow too slowly?
  bool are_long_enough() const { return long_enough_; }

  /// Nothing where the budget is spent.
  std::optional<bool> diverges(double h) const {
    if (!damped_) return grows(h);
    return stiff_ ? leaves_finer(h) : parts(h);
  }

 private:
  static constexpr long kBlock = 50;

  /// One trajectory.
  struct Run {
    Point<double> point;
    Memory memory;
  };
  Run run_from(const Point<double>& start) const { return {start, flow_.fresh_memory(method_)}; }
  void advance(Run& run, double h, int ratio = 1) const {
    budget_.spend(static_cast<double>(kBlock * ratio) * step_time(method_));
    flow_.step(method_, run.point, h / ratio, kBlock * ratio, run.memory);
  }

  std::optional<bool> grows(double h) const {
    Run run = run_from(start_);
    for (long done = 0; done < steps_; done += kBlock) {
      if (budget_.is_over()) return {};
      advance(run, h);
      if (beyond(velocities(run.point), kDiverged)) return true;
    }
    return false;
  }

  std::optional<bool> leaves_finer(double h) const {
    Run run = run_from(start_), finer = run;
    for (long done = 0; done < steps_; done += kBlock) {
      if (budget_.is_over()) return {};
      advance(run, h);
      advance(finer, h, kFiner);
      if (beyond(velocities(run.point) - velocities(finer.point), kOff)) return true;
    }
    return false;
  }

  std::optional<bool> parts(double h) const {
    Run run = run_from(start_), other = run_from(undisplaced_), finer = run, finer_other = other;
    double widest = distance(run, other);  // that the motion itself brings about
    for (long done = 0; done < steps_; done += kBlock) {
      if (budget_.is_over()) return {};
      for (Run* each : {&run, &other}) advance(*each, h);
      for (Run* each : {&finer, &finer_other}) advance(*each, h, kFiner);
      widest = std::max(widest, distance(finer, finer_other));
      if (!(distance(run, other) < kParted * widest) ||
          beyond(velocities(run.point) - velocities(finer.point), kDiverged))
        return true;
    }
    return false;
  }

  double distance(Run& a, Run& b) const {
    return (velocities(a.point) - velocities(b.point)).lpNorm<Eigen::Infinity>();
  }

  Eigen::Map<Eigen::VectorXd> velocities(Point<double>& point) const {
    const std::size_t first = flow_.position_count();
    return {point.x.data() + first, static_cast<Eigen::Index>(point.x.size() - first)};
  }

  bool beyond(const Eigen::VectorXd& z, double multiple) const {
    return !z.allFinite() || (z.cwiseAbs().array() > multiple * scales_.array()).any();
  }

  const Flow<double>& flow_;
  const jourdain_method& method_;
  Point<double> start_, undisplaced_;
  Eigen::VectorXd scales_;  ///< of the velocities
  long steps_ = 0;
  bool long_enough_ = true;
  bool damped_;
  bool stiff_;
  Budget& budget_;
};

/// h that holds and h that diverges: 5 % on both sides of `predicted`, or a step of kWidening apart around it.
/// Beyond a limit a nonlinear scene may hold again.
std::optional<std::pair<double, double>> bracket(const Runs& runs, double predicted) {
  constexpr double kNear = 1.05;
  if (runs.diverges(predicted * kNear) == true && runs.diverges(predicted / kNear) == false)
    return std::pair(predicted / kNear, predicted * kNear);
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

/// Does a run over the whole time fail?
bool fails(const Flow<double>& flow, const jourdain_method& method, double h, double duration,
           const Eigen::VectorXd& scales) {
  Point<double> point = flow.start();
  Memory memory = flow.fresh_memory(method);
  const auto first = static_cast<std::ptrdiff_t>(flow.position_count());
  const auto steps = static_cast<long>(std::ceil(duration / h));
  for (long i = 0; i < steps; ++i) {
    flow.step(method, point, h, 1, memory);
    const Eigen::Map<const Eigen::VectorXd> z(point.x.data() + first, scales.size());
    if (!z.allFinite() || (z.cwiseAbs().array() > kDiverged * scales.array()).any()) return true;
  }
  return false;
}

}  // namespace

NonlinearLimit observe_nonlinear_limit(const Flow<double>& flow, const jourdain_method& method,
                                       const Eigen::VectorXd& largest, double duration, Budget& budget) {
  constexpr double kSteps = 8, kHolds = 3;  // so many shorter steps in a row hold
  const double scale = largest.maxCoeff() > 0 ? largest.maxCoeff() : 1;
  const Eigen::VectorXd scales = largest.cwiseMax(kMoving * scale);
  const auto failing = [&](double h) {
    budget.spend(duration / h * step_time(method));
    return fails(flow, method, h, duration, scales);
  };
  const double longest = duration / kSteps;
  std::optional<double> shortest_failing;
  double h = longest, holding = longest;
  for (int held = 0; held < kHolds; h /= kWidening) {
    if (budget.is_over()) return {};
    if (failing(h)) {
      shortest_failing = h;
      held = 0;
    } else if (held++ == 0) {
      holding = h;
    }
  }
  if (!shortest_failing) return {{}, longest};
  while (*shortest_failing > holding * kResolution) {
    if (budget.is_over()) return {};
    const double middle = std::sqrt(*shortest_failing * holding);
    (failing(middle) ? *shortest_failing : holding) = middle;
  }
  return {ObservedLimit{*shortest_failing, flow.start().t, std::lround(duration / *shortest_failing)}, {}};
}

std::optional<ObservedLimit> observe_limit(const Flow<double>& flow, const jourdain_method& method,
                                           const LimitRuns& setting, Budget& budget) {
  const Runs runs(flow, method, setting, budget);
  if (!runs.are_long_enough()) return {};
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
