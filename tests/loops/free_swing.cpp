#include "loops/free_swing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loops/compiled_swing.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {

namespace {

using Form = reference::DescriptorReference<double>;

/// s. Steps are halved before a motion counts as wrong: an error that is not of order 4 yet is not the compiler's.
constexpr double kFirstStep = 1e-3, kLastStep = kFirstStep / 16;
constexpr double kMargin = 10;  // times the error that two steps extrapolate to
constexpr double kGain = 15;    // what half the step takes off the error of a method of order 4, less one
// Of the size and in rad: rounding of some thousand steps, near dead positions too.
constexpr double kFloor = 1e-7;
constexpr double kEnergyFloor = 1e-9;  // of the largest kinetic energy: rounding, as above
constexpr double kFalls = 8;           // times that drift falls at half the step, of 16 or 32
constexpr double kOpen = 1e-10;        // of the size
constexpr double kLeastEnergy = 1e-3;  // of weight times size: a mechanism that hardly moves
/// Of the size, in rad, of the largest kinetic energy: what the finest step must reach, or it shows nothing.
constexpr double kConverged = 1e-3;
constexpr double kWatched = 5e-3;  // s; how often energy and rows are looked at
/// How much more a motion departs than the numbers of the mechanism do: within seconds, past dead positions.
constexpr double kSensitivity = 1e3;
constexpr std::size_t kFewestLooks = 4;  // the reference must know more than the start

/// NaN stays.
double larger(double a, double b) { return b <= a || std::isnan(a) ? a : b; }

/// Motion at one step length.
struct Run {
  std::vector<PlacedBodies> bodies;    // at the looks
  std::vector<double> drift, opening;  // by look, largest so far: J; m or without unit
  double kinetic = 0;                  // largest, J
  std::string flag;                    // what the guard saw when it stopped the run
};

/// What the guard sees after a step where it stops the run, as `jourdain simulate` does.
std::optional<std::string> guard(const loops::LoopPlan& plan, const ClosingReport& report) {
  if (!report.regularity || *report.regularity >= plan.least_regularity()) return {};
  return fmt::format("regularity {:.1e}", *report.regularity);
}

Run run(const CompiledSwing& swing, const loops::LoopPlan& plan, const Form& form, const Looks& looks,
        double h) {
  Run run;
  SwingState state = swing.start();
  const double start = swing.energy(state);
  double drift = 0, opening = 0;
  const auto look = [&] {
    const auto y = Eigen::Map<const Eigen::VectorXd>(state.y.data(), Eigen::Index(state.y.size()));
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(Eigen::Index(form.layout().velocity_count()));
    run.bodies.push_back(form.absolute_state(state.t, y, rest));
    run.drift.push_back(drift);
    run.opening.push_back(opening);
  };
  look();
  const long steps = std::lround(looks.interval / h), watched = std::lround(kWatched / h);
  for (std::size_t k = 0; k < looks.count; ++k) {
    for (long i = 0; i < steps; ++i) {
      const ClosingReport report = swing.step(state, h);
      if (const auto seen = guard(plan, report)) {
        run.flag = fmt::format("{} at {:.3f} s", *seen, state.t);
        return run;
      }
      if ((i + 1) % watched != 0) continue;
      drift = larger(drift, std::fabs(swing.energy(state) - start));
      opening = larger(opening, swing.opening(state));
      run.kinetic = larger(run.kinetic, swing.kinetic_energy(state));
    }
    look();
  }
  return run;
}

class Judge {
 public:
  Judge(const RandomLinkage& linkage, const KnownMotion& known) : linkage_(linkage), known_(known) {
    for (const model::Body& body : linkage.mechanism.bodies) weight_ += 9.81 * body.mass.constant();
  }

  /// Looks that can be judged.
  std::size_t looks(const Run& coarse, const Run& fine) const {
    return std::min({known_.known(), coarse.bodies.size(), fine.bodies.size()});
  }

  /// What is wrong with the motion that two steps show, or nothing.
  std::string fault(const Run& coarse, const Run& fine) const {
    double apart = 0;
    for (std::size_t k = 0; k < looks(coarse, fine); ++k) {
      apart = larger(apart, difference(coarse.bodies[k], fine.bodies[k], linkage_.size));
      if (!(apart <= kConverged)) return fmt::format("steps differ by {:.1e} at look {}", apart, k);
      const double off = difference(fine.bodies[k], known_.bodies[k], linkage_.size),
                   allowed = kMargin * (apart / kGain + known_.doubt[k]) + kFloor + departure();
      if (!(off <= allowed)) return fmt::format("off by {:.1e}, allowed {:.1e}, at look {}", off, allowed, k);
    }
    const std::size_t last = looks(coarse, fine) - 1;
    const double before = coarse.drift[last] / energy(fine), now = drift(fine, last);
    if (!(now <= kEnergyFloor + departure() + std::min(before / kFalls, kConverged)))
      return fmt::format("energy drifts by {:.1e}, at twice the step by {:.1e}", now, before);
    const double opening = fine.opening[last] / linkage_.size;
    if (!(opening <= kOpen + kMargin * linkage_.perturbation)) return fmt::format("open by {:.1e}", opening);
    return "";
  }

  /// Share of the largest kinetic energy, or of what the weight could do at all.
  double drift(const Run& run, std::size_t look) const { return run.drift[look] / energy(run); }

 private:
  double energy(const Run& run) const {
    return std::max(run.kinetic, kLeastEnergy * weight_ * linkage_.size);
  }
  double departure() const { return kSensitivity * linkage_.perturbation; }

  const RandomLinkage& linkage_;
  const KnownMotion& known_;
  double weight_ = 0;  // N
};

}  // namespace

Judgement judge(const RandomLinkage& linkage, const KnownMotion& known, const Looks& looks,
                std::optional<model::LoopTreatment> treatment) {
  Judgement judgement;
  if (known.known() < std::min(kFewestLooks, looks.count)) return judgement;
  model::Mechanism mechanism = linkage.mechanism;
  mechanism.loop_options.treatment = treatment;
  const auto compiled = compiled_or_refused(mechanism);
  if (const std::string* words = std::get_if<std::string>(&compiled)) {
    judgement.outcome = Outcome::kRefused;
    judgement.why = *words;
    return judgement;
  }
  const CompiledLinkage& made = std::get<CompiledLinkage>(compiled);
  judgement.freedom = made.plan.freedom;
  if (judgement.freedom == 0) {
    judgement.outcome = Outcome::kRefused;
    judgement.why = "no degree of freedom left";
    return judgement;
  }
  const CompiledSwing swing(mechanism, made.model);
  const Form form(mechanism);
  const Judge bench(linkage, known);
  judgement.treatment = made.plan.treatment;
  judgement.operations = swing.step_operations();
  Looks judged = looks;
  judged.count = known.known() - 1;
  Run coarse = run(swing, made.plan, form, judged, kFirstStep);
  for (double h = kFirstStep / 2; h >= kLastStep; h /= 2) {
    Run fine = run(swing, made.plan, form, judged, h);
    const std::size_t last = bench.looks(coarse, fine) - 1;
    judgement.step = h;
    judgement.until = looks.interval * double(last);
    judgement.drift = bench.drift(fine, last);
    judgement.why = bench.fault(coarse, fine);
    judgement.outcome = judgement.why.empty() ? Outcome::kRight : Outcome::kWrong;
    if (judgement.outcome == Outcome::kRight && !(coarse.flag + fine.flag).empty()) {
      judgement.outcome = Outcome::kFlagged;
      judgement.why = fine.flag.empty() ? coarse.flag : fine.flag;
    }
    if (judgement.outcome != Outcome::kWrong) break;
    coarse = std::move(fine);
  }
  return judgement;
}

}  // namespace jourdain::tests
