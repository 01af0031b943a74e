#include "commands/halved_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace jourdain::commands {

using studies::Flow;
using studies::Point;

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Of lengths and angles, at least of 1 m and 1 rad; in units of rounding where that is more.
constexpr double kNothing = 1e-9, kRoundings = 64;
/// Of energy: changes by a hundredth of the velocities.
constexpr double kLittle = 1e-4;

/// What steps do to the velocities of a unit that two of half the length from the same states do not.
struct LocalErrors {
  double sum = 0;      ///< over all steps, of the Euclidean norm
  double largest = 0;  ///< of a velocity, in a step
  std::size_t velocity = 0;
  Point<double> point;  ///< where that step begins
};

/// Makes the run again, up to where something is no number.
LocalErrors local_errors(const RunSteps& run, const std::vector<std::string>& units,
                         const std::string& unit) {
  const std::size_t first = run.flow.position_count();
  LocalErrors found;
  Point<double> point = run.flow.start();
  found.point = point;
  studies::Memory memory = run.flow.fresh_memory(run.method);
  for (long done = 0; done < run.count && std::isfinite(found.sum); ++done) {
    const Point<double> before = point;
    Point<double> halved = point;
    studies::Memory short_memory = run.flow.fresh_memory(run.method);
    run.flow.step(run.method, halved, run.h / 2, 2, short_memory);
    run.flow.step(run.method, point, run.h, 1, memory);
    point.t = static_cast<double>(done + 1) * run.h;
    double square = 0;
    for (std::size_t k = 0; k < units.size(); ++k) {
      if (units[k] != unit) continue;
      const double difference = std::fabs(point.x[first + k] - halved.x[first + k]);
      const double error = std::isfinite(difference) ? difference : kInfinite;
      square += error * error;
      if (error <= found.largest) continue;
      found.largest = error;
      found.velocity = k;
      found.point = before;
    }
    found.sum += std::sqrt(square);
  }
  return found;
}

double size_of(const Point<double>& point) {
  double size = 1;
  for (const double entry : point.x) size = std::max(size, std::fabs(entry));
  return size;
}

}  // namespace

double UnitChange::share() const {
  if (!std::isfinite(largest) || !std::isfinite(square)) return kInfinite;
  return square == 0 ? 0 : std::sqrt(square / size);
}

HalvedRun::HalvedRun(const Flow<double>& flow, const jourdain_method& method, double h,
                     const std::vector<std::string>& units)
    : flow_(flow), method_(method), h_(h), point_(flow.start()), memory_(flow.fresh_memory(method)) {
  potential_ = flow.energy(point_) - flow.kinetic_energy(point_);
  for (const std::string& unit : units) {
    const auto same = std::find_if(changes_.begin(), changes_.end(),
                                   [&unit](const UnitChange& change) { return change.unit == unit; });
    change_of_.push_back(unit.empty() ? kNone : static_cast<std::size_t>(same - changes_.begin()));
    if (!unit.empty() && same == changes_.end()) changes_.push_back({unit});
  }
}

void HalvedRun::follow(const Point<double>& point, long steps) {
  flow_.step(method_, point_, h_ / 2, 2 * steps, memory_);
  done_ += steps;
  point_.t = static_cast<double>(done_) * h_;
  const std::size_t first = flow_.position_count();
  const double energy = flow_.kinetic_energy(point_), potential = flow_.energy(point_) - energy;
  const double released = std::fabs(potential - std::exchange(potential_, potential));
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    UnitChange& change = changes_[i];
    Point<double> difference = point_;
    std::fill(difference.x.begin() + static_cast<std::ptrdiff_t>(first), difference.x.end(), 0.0);
    for (std::size_t k = 0; k < point.x.size(); ++k) {
      if (change_of_[k] != i) continue;
      const double by = std::fabs(point.x[k] - point_.x[k]);
      change.largest = std::isfinite(by) ? std::max(change.largest, by) : kInfinite;
      change.square += by * by;
      change.size += point_.x[k] * point_.x[k];
      if (k >= first) difference.x[k] = point.x[k] - point_.x[k];
    }
    change.energy += flow_.kinetic_energy(difference);
    change.energies += energy;
    change.released = std::max(change.released, released);
    ++change.times;
  }
}

namespace {

/// Whether half the step leads elsewhere, as judge_halving has it.
bool is_much(const RunSteps& run, const UnitChange& change, double accuracy) {
  if (!std::isfinite(change.square)) return true;
  const double nothing = std::max(kNothing, kRoundings * run.flow.table().unit_roundoff);
  const double duration = run.h * static_cast<double>(run.count);
  const double energies = std::max(change.energies, static_cast<double>(change.times) * change.released);
  return change.share() > accuracy && change.energy > kLittle * energies &&
         change.largest * duration > nothing * size_of(run.flow.start());
}

}  // namespace

HalvingVerdict judge_halving(const RunSteps& run, const std::vector<UnitChange>& changes,
                             const std::vector<std::string>& velocities, double accuracy) {
  HalvingVerdict verdict;
  for (const UnitChange& change : changes) {
    if (std::find(velocities.begin(), velocities.end(), change.unit) == velocities.end()) continue;
    if (!is_much(run, change, accuracy)) continue;
    verdict.leads_elsewhere = true;
    const double usual = std::sqrt(change.size / static_cast<double>(change.times));
    const LocalErrors errors = local_errors(run, velocities, change.unit);
    if (std::isfinite(change.square) && !(errors.sum > accuracy * usual)) continue;
    verdict.wrong = fmt::format(
        "this is not the motion: half the step changes velocities in {} by {:.2g} of what they are (allowed: "
        "{:g}); the step from t = {:g} s on changes '{}' by {:.2g} {} that two halves do not",
        change.unit, change.share(), accuracy, errors.point.t,
        run.flow.table().velocity_names[errors.velocity], errors.largest, change.unit);
    verdict.point = errors.point;
    return verdict;
  }
  return verdict;
}

std::string halving_text(const std::vector<UnitChange>& changes) {
  std::string text = "half the step moves it by at most";
  for (std::size_t i = 0; i < changes.size(); ++i)
    text += fmt::format("{} {:.1g} {}", i == 0 ? "" : ",", changes[i].largest, changes[i].unit);
  return text;
}

}  // namespace jourdain::commands
