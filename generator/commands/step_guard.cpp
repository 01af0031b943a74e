#include "commands/step_guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/sensitivity.hpp"
#include "studies/spectra.hpp"

namespace jourdain::commands {

using studies::Flow;
using studies::Point;

namespace {

constexpr double kMuch = 0.5;     // of the largest velocity that there was
constexpr double kPushed = 0.25;  // of a velocity, by a step at the acceleration before
constexpr double kGrowth = 0.5;   // in a step, as an exponent
constexpr double kFarOff = 10;    // times what there was
constexpr int kParts[] = {64, 250, 1000};
constexpr long kFirst = 4;       // steps or parts, which change all there is where a motion starts from rest
constexpr double kMissed = 0.1;  // of a change
/// Growth itself grows so many times in a step, and is so fast after it, where a motion ends within the step or soon
/// after: as 1/(the time that is left).
constexpr double kFaster = 3, kFast = 2.5;
/// Velocities below this share of the largest one are rounding, as are those that move things by this share in a step.
constexpr double kRounding = 1e-9;

}  // namespace

StepGuard::StepGuard(const Flow<double>& flow, const jourdain_method& method, double h)
    : flow_(flow), method_(method), h_(h) {
  fastest_.resize(flow.size() - flow.position_count());
  remember(flow.start().x.data() + flow.position_count());
}

void StepGuard::remember(const double* z) {
  for (std::size_t k = 0; k < fastest_.size(); ++k) fastest_[k] = std::max(fastest_[k], std::fabs(z[k]));
}

std::vector<std::size_t> StepGuard::changed_much(const double* before, const double* after) const {
  const double least = fastest_.empty() ? 0 : kRounding * *std::max_element(fastest_.begin(), fastest_.end());
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < fastest_.size(); ++k)
    if (std::fabs(after[k] - before[k]) > kMuch * std::max(fastest_[k], least)) changed.push_back(k);
  return changed;
}

/// Those of them that grow much in a step, and their rates too.
std::vector<StepGuard::Growth> StepGuard::growing(const Point<double>& point,
                                                  const std::vector<std::size_t>& velocities) const {
  constexpr double kShort = 1e-4;  // of a step
  const std::vector<double> rates = flow_.rates(point.t, point.x);
  std::vector<double> x = point.x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] += kShort * h_ * rates[k];
  const std::vector<double> later = flow_.rates(point.t + kShort * h_, x);
  std::vector<Growth> list;
  for (const std::size_t k : velocities) {
    const std::size_t entry = flow_.position_count() + k;
    const double rate = (later[entry] / rates[entry] - 1) / (kShort * h_);
    if (h_ * rates[entry] / point.x[entry] > kPushed && rate * h_ > kGrowth) list.push_back({k, rate});
  }
  return list;
}

/// Changes below this share may be rounding.
double StepGuard::rounding() const {
  constexpr double kRoundings = 64;
  return std::max(kRounding, kRoundings * flow_.table().unit_roundoff);
}

/// The real part of the fastest growing mode, 1/s: by differences over a thousandth of what a step changes, be it
/// micrometres. Entries of x count as if each were free.
double StepGuard::fastest_mode(const Point<double>& point) const {
  constexpr double kShare = 1e-3;
  const std::vector<double> rates = flow_.rates(point.t, point.x);
  std::vector<double> changes;
  for (std::size_t k = 0; k < point.x.size(); ++k)
    changes.push_back(
        std::max(kShare * h_ * std::fabs(rates[k]), rounding() * std::max(1.0, std::fabs(point.x[k]))));
  const Eigen::MatrixXd J = studies::jacobian(flow_, point, changes);
  return J.allFinite() ? studies::spectrum(J).values.real().maxCoeff() : 0;
}

/// A step in `parts`; where one of these changes one of the velocities by more than half of the largest
/// that there was by then, `jumped` is the first of them.
StepGuard::Path StepGuard::in_parts(const Point<double>& before, int parts,
                                    const std::vector<Growth>& growing) const {
  Path path = {before, nullptr};
  studies::Memory memory = flow_.fresh_memory(method_);
  std::vector<double> fastest = fastest_;
  for (long part = 0; part < parts && !path.jumped; ++part) {
    const std::vector<double> last = path.end.x;
    flow_.step(method_, path.end, h_ / parts, 1, memory);
    for (const Growth& growth : growing) {
      const std::size_t k = flow_.position_count() + growth.velocity;
      double& most = fastest[growth.velocity];
      if (part >= kFirst && !(std::fabs(path.end.x[k] - last[k]) <= kMuch * most)) path.jumped = &growth;
      most = std::max(most, std::fabs(path.end.x[k]));
    }
  }
  return path;
}

/// The first of them whose motion even small parts of the step do not follow, or that the step throws off; null: none.
const StepGuard::Growth* StepGuard::lost(const Point<double>& before, const Point<double>& after,
                                         const std::vector<Growth>& growing) const {
  Path path;
  for (const int parts : kParts) {
    path = in_parts(before, parts, growing);
    if (path.jumped) return path.jumped;
  }
  for (const Growth& growth : growing) {
    const std::size_t k = flow_.position_count() + growth.velocity;
    const double usual = std::max(fastest_[growth.velocity], std::fabs(path.end.x[k]));
    if (!(std::fabs(after.x[k]) <= kFarOff * usual)) return &growth;
    if (std::fabs(after.x[k] - path.end.x[k]) <= kMissed * std::fabs(after.x[k] - before.x[k])) continue;
    const std::vector<Growth> then = this->growing(path.end, {growth.velocity});
    if (!then.empty() && then.front().rate > std::max(kFaster * growth.rate, kFast / h_)) return &growth;
  }
  return nullptr;
}

/// What grows faster than the step follows; empty: nothing.
std::string StepGuard::outgrown(const Point<double>& before, const Point<double>& after) const {
  const std::size_t first = flow_.position_count();
  const std::vector<std::size_t> changed = changed_much(before.x.data() + first, after.x.data() + first);
  if (changed.empty()) return "";
  const std::vector<Growth> list = growing(before, changed);
  const Growth* growth = list.empty() ? nullptr : lost(before, after, list);
  if (!growth || fastest_mode(before) * h_ <= kGrowth) return "";
  return fmt::format(
      "at t = {:g} s a step of {:g} s does not follow the motion: what accelerates '{}' grows e-fold in "
      "{:.2g} s; take shorter ones: if they end there, too, so does the motion",
      before.t, h_, flow_.table().velocity_names[growth->velocity], 1 / growth->rate);
}

std::string StepGuard::problem(const Point<double>& before, const Point<double>& after) {
  std::string found = ++steps_ > kFirst ? outgrown(before, after) : "";
  remember(after.x.data() + flow_.position_count());
  return found;
}

}  // namespace jourdain::commands
