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
/// Of energy: changes by a hundredth of the velocities. Of what is there at the start or released, for so many times:
/// what relaxes in a few steps may do so otherwise.
constexpr double kLittle = 1e-4, kRelaxing = 100;
/// First steps after which runs are compared, and about as many comparisons later.
constexpr long kCompared = 1000;
constexpr const char* kQuaternion = "1";

/// What steps do to entries that two of half the length from the same states do not.
struct LocalErrors {
  double sum = 0;       ///< over all steps, of the Euclidean norm
  double largest = 0;   ///< norm, of a step
  Point<double> point;  ///< where that step begins
};

/// Makes the run again, up to where something is no number. One for each of the changes.
std::vector<LocalErrors> local_errors(const RunSteps& run, const std::vector<const EntryChange*>& changes) {
  Point<double> point = run.flow.start();
  std::vector<LocalErrors> errors(changes.size(), LocalErrors{0, 0, point});
  studies::Memory memory = run.flow.fresh_memory(run.method);
  bool is_finite = true;
  for (long done = 0; done < run.count && is_finite; ++done) {
    const Point<double> before = point;
    Point<double> halved = point;
    studies::Memory short_memory = run.flow.fresh_memory(run.method);
    run.flow.step(run.method, halved, run.h / 2, 2, short_memory);
    run.flow.step(run.method, point, run.h, 1, memory);
    point.t = static_cast<double>(done + 1) * run.h;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      double square = 0;
      for (const std::size_t k : changes[i]->entries) {
        const double difference = std::fabs(point.x[k] - halved.x[k]);
        square += std::isfinite(difference) ? difference * difference : kInfinite;
      }
      const double error = std::sqrt(square);
      if (error > errors[i].largest) {
        errors[i].largest = error;
        errors[i].point = before;
      }
      errors[i].sum += error;
      is_finite &= std::isfinite(error);
    }
  }
  return errors;
}

/// Largest of the positions, but for states and quaternions: m, rad; at least 1.
double size_of(const RunSteps& run, const std::vector<std::string>& units) {
  const Point<double> point = run.flow.start();
  double size = 1;
  for (std::size_t k = 0; k < run.flow.position_count(); ++k)
    if (!units[k].empty()) size = std::max(size, std::fabs(point.x[k]));
  return size;
}

}  // namespace

double EntryChange::share() const {
  if (!std::isfinite(largest) || !std::isfinite(square)) return kInfinite;
  return square == 0 ? 0 : std::sqrt(square / size);
}

HalvedRun::HalvedRun(const Flow<double>& flow, const jourdain_method& method, double h, long count,
                     const std::vector<std::string>& units)
    : flow_(flow),
      method_(method),
      h_(h),
      stride_(std::max(1L, (count - kCompared) / kCompared)),
      point_(flow.start()),
      memory_(flow.fresh_memory(method)),
      start_(flow.kinetic_energy(point_)) {
  lowest_ = highest_ = flow.energy(point_) - start_;
  for (std::size_t k = 0; k < units.size(); ++k) {
    const std::string& unit = units[k];
    const auto same = std::find_if(changes_.begin(), changes_.end(),
                                   [&unit](const UnitChange& change) { return change.unit == unit; });
    change_of_.push_back(unit.empty() ? kNone : static_cast<std::size_t>(same - changes_.begin()));
    if (unit.empty()) continue;
    if (same == changes_.end()) changes_.push_back({unit, 0});
    const bool goes_on = k > 0 && unit == kQuaternion && units[k - 1] == kQuaternion &&
                         entries_.back().entries.size() % 4 != 0;
    if (goes_on)
      entries_.back().entries.push_back(k);
    else if (k >= flow.position_count() || unit == kQuaternion)
      entries_.push_back({{k}, 0, 0, 0, 0});
  }
}

long HalvedRun::steps_to_next(long done) const {
  return done < kCompared ? 1 : stride_ - (done - kCompared) % stride_;
}

void HalvedRun::follow(const Point<double>& point, long steps) {
  flow_.step(method_, point_, h_ / 2, 2 * steps, memory_);
  done_ += steps;
  point_.t = static_cast<double>(done_) * h_;
  const double kinetic = flow_.kinetic_energy(point_), potential = flow_.energy(point_) - kinetic;
  energies_ += kinetic;
  lowest_ = std::min(lowest_, potential);
  highest_ = std::max(highest_, potential);
  const auto apart = [&](std::size_t k) {
    const double by = std::fabs(point.x[k] - point_.x[k]);
    return std::isfinite(by) ? by : kInfinite;
  };
  for (std::size_t k = 0; k < point.x.size(); ++k)
    if (change_of_[k] != kNone)
      changes_[change_of_[k]].largest = std::max(changes_[change_of_[k]].largest, apart(k));
  Point<double> difference = point_;
  const auto velocities = difference.x.begin() + static_cast<std::ptrdiff_t>(flow_.position_count());
  std::fill(velocities, difference.x.end(), 0.0);
  for (EntryChange& change : entries_) {
    for (const std::size_t k : change.entries) {
      const double by = apart(k);
      change.largest = std::max(change.largest, by);
      change.square += by * by;
      change.size += point_.x[k] * point_.x[k];
    }
    const std::size_t k = change.entries.front();
    if (k < flow_.position_count()) continue;
    difference.x[k] = point.x[k] - point_.x[k];
    change.energy += flow_.kinetic_energy(difference);
    difference.x[k] = 0;
  }
  ++times_;
}

double HalvedRun::energies() const {
  return std::max(energies_, kRelaxing * std::max(start_, highest_ - lowest_));
}

namespace {

/// Whether half the step leads elsewhere, as judge_halving has it.
bool is_much(const RunSteps& run, const HalvedRun& halved, const EntryChange& change,
             const std::vector<std::string>& units, double accuracy) {
  if (!std::isfinite(change.square)) return true;
  if (!(change.share() > accuracy)) return false;
  if (change.entries.front() < run.flow.position_count()) return true;
  const double nothing = std::max(kNothing, kRoundings * run.flow.table().unit_roundoff);
  const double duration = run.h * static_cast<double>(run.count);
  return change.energy > kLittle * halved.energies() &&
         change.largest * duration > nothing * size_of(run, units);
}

}  // namespace

HalvingVerdict judge_halving(const RunSteps& run, const HalvedRun& halved,
                             const std::vector<std::string>& units, double accuracy) {
  HalvingVerdict verdict;
  std::vector<const EntryChange*> much;
  for (const EntryChange& change : halved.entries())
    if (is_much(run, halved, change, units, accuracy)) much.push_back(&change);
  verdict.leads_elsewhere = !much.empty();
  if (much.empty()) return verdict;
  const std::vector<LocalErrors> all = local_errors(run, much);
  for (std::size_t i = 0; i < much.size(); ++i) {
    const EntryChange& change = *much[i];
    const LocalErrors& errors = all[i];
    const double usual = std::sqrt(change.size / static_cast<double>(halved.times()));
    if (std::isfinite(change.square) && !(errors.sum > accuracy * usual)) continue;
    const std::size_t k = change.entries.front(), positions = run.flow.position_count();
    const bool is_velocity = k >= positions;
    const char* const name =
        is_velocity ? run.flow.table().velocity_names[k - positions] : run.flow.table().position_names[k];
    verdict.wrong = fmt::format(
        "this is not the motion: half the step changes {} '{}' by {:.2g} of what it is (allowed: {:g}); the "
        "step "
        "from t = {:g} s on changes it by {:.2g}{} that two halves do not",
        is_velocity ? "velocity" : "the quaternion from", name, change.share(), accuracy, errors.point.t,
        errors.largest, is_velocity ? " " + units[k] : "");
    verdict.point = errors.point;
    return verdict;
  }
  return verdict;
}

std::string halving_text(const std::vector<UnitChange>& changes) {
  std::string text = "half the step moves it by at most";
  for (std::size_t i = 0; i < changes.size(); ++i)
    text += fmt::format("{} {:.1g} {}", i == 0 ? "" : ",", changes[i].largest,
                        changes[i].unit == kQuaternion ? "(quaternions)" : changes[i].unit);
  return text;
}

}  // namespace jourdain::commands
