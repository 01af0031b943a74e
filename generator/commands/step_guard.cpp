#include "commands/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/spectra.hpp"

namespace jourdain::commands {

using studies::Flow;
using studies::Point;

namespace {

constexpr double kMuch = 0.5;     // of the largest velocity that there was
constexpr double kPushed = 0.25;  // of it, by a step at the acceleration before
constexpr double kGrowth = 0.5;   // in a step, as an exponent
constexpr double kMissed = 0.1;   // of a change
constexpr long kFirst = 4;        // steps, which change all there is where a motion starts from rest
constexpr int kParts[] = {4, 16, 64};
/// Velocities below this share of the largest one are rounding.
constexpr double kRounding = 1e-9;

}  // namespace

StepGuard::StepGuard(const Flow<double>& flow, const jourdain_method& method, double h)
    : flow_(flow), method_(method), h_(h) {
  const std::vector<double>& x = flow.start().x;
  for (std::size_t k = flow.position_count(); k < x.size(); ++k) fastest_.push_back(std::fabs(x[k]));
}

std::vector<std::size_t> StepGuard::changed_much(const double* before, const double* after) {
  const double least = fastest_.empty() ? 0 : kRounding * *std::max_element(fastest_.begin(), fastest_.end());
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < fastest_.size(); ++k) {
    if (std::fabs(after[k] - before[k]) > kMuch * std::max(fastest_[k], least)) changed.push_back(k);
    fastest_[k] = std::max(fastest_[k], std::fabs(after[k]));
  }
  return changed;
}

/// The fastest exponential growth of the rates of such of them as grow much in a step, 1/s.
double StepGuard::growth(const Point<double>& point, const std::vector<std::size_t>& velocities) const {
  constexpr double kShort = 1e-4;  // of a step
  const std::vector<double> rates = flow_.rates(point.t, point.x);
  std::vector<double> x = point.x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += kShort * h_ * rates[k];
  const std::vector<double> later = flow_.rates(point.t + kShort * h_, x);
  double fastest = 0;
  for (const std::size_t k : velocities) {
    const std::size_t entry = flow_.position_count() + k;
    if (h_ * rates[entry] / point.x[entry] > kPushed)
      fastest = std::max(fastest, (later[entry] / rates[entry] - 1) / (kShort * h_));
  }
  return fastest;
}

/// The real part of the fastest growing mode, 1/s: by differences over a thousandth of what a step changes, be it
/// micrometres. Entries of x count as if each were free.
double StepGuard::fastest_mode(const Point<double>& point) const {
  constexpr double kShare = 1e-3, kLeast = 1e-9;
  const std::vector<double> rates = flow_.rates(point.t, point.x);
  const auto n = static_cast<Eigen::Index>(point.x.size());
  Eigen::MatrixXd J(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double change =
        std::max(kShare * h_ * std::fabs(rates[k]), kLeast * std::max(1.0, std::fabs(point.x[k])));
    std::vector<double> above = point.x, below = point.x;
    above[k] += change;
    below[k] -= change;
    const std::vector<double> high = flow_.rates(point.t, above), low = flow_.rates(point.t, below);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto r = static_cast<std::size_t>(i);
      J(i, j) = (high[r] - low[r]) / (above[k] - below[k]);
    }
  }
  return J.allFinite() ? studies::spectrum(J).values.real().maxCoeff() : 0;
}

bool StepGuard::leads_elsewhere(const Point<double>& before, const Point<double>& after,
                                const std::vector<std::size_t>& velocities) const {
  for (const int parts : kParts) {
    Point<double> point = before;
    studies::Memory memory = flow_.fresh_memory(method_);
    flow_.step(method_, point, h_ / parts, parts, memory);
    for (const std::size_t velocity : velocities) {
      const std::size_t k = flow_.position_count() + velocity;
      if (!(std::fabs(point.x[k] - after.x[k]) <= kMissed * std::fabs(after.x[k] - before.x[k]))) return true;
    }
  }
  return false;
}

std::string StepGuard::problem(const Point<double>& before, const Point<double>& after) {
  const std::size_t first = flow_.position_count();
  const std::vector<std::size_t> changed = changed_much(before.x.data() + first, after.x.data() + first);
  if (++steps_ <= kFirst || changed.empty()) return "";
  const double grows = growth(before, changed);
  if (!(grows * h_ > kGrowth) || !leads_elsewhere(before, after, changed) ||
      !(fastest_mode(before) * h_ > kGrowth))
    return "";
  return fmt::format(
      "at t = {:g} s a step of {:g} s does not follow the motion: what accelerates '{}' grows e-fold in "
      "{:.2g} s, and parts of the step lead elsewhere; take shorter ones: if they end there, too, so does "
      "the motion",
      before.t, h_, flow_.table().velocity_names[changed.front()], 1 / grows);
}

}  // namespace jourdain::commands
