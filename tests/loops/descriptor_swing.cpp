#include "loops/descriptor_swing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/minimal.hpp"

namespace jourdain::tests {

namespace {

using Eigen::VectorXd;
using Form = reference::DescriptorReference<double>;
using State = reference::AbsoluteState<double>;

constexpr double kCoarse = 1e-8, kFine = 1e-11;  // of a step, relative to 1 + |x|
constexpr int kColumns = 5;                      // of the extrapolation: order 10
// A mechanism that needs more, or shorter ones, is at a singular position, where no reference is to be had.
constexpr long kMostSteps = 800;
constexpr double kShortestStep = 1e-5;  // s
/// What the finer solution may still be off by, however well the two agree.
constexpr double kOwnError = 1e-9;
/// Body by body: centre of mass, quaternion w x y z, v, ω.
constexpr Eigen::Index kEntries = 13;

VectorXd packed(const State& state) {
  VectorXd x(kEntries * Eigen::Index(state.bodies.size()));
  Eigen::Index first = 0;
  for (const auto& body : state.bodies) {
    const Eigen::Quaterniond& q = body.orientation;
    x.segment<kEntries>(first) << body.p_WC, q.w(), q.x(), q.y(), q.z(), body.v_C, body.omega;
    first += kEntries;
  }
  return x;
}

State unpacked(const VectorXd& x, State state) {
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const auto entry = x.segment<kEntries>(kEntries * Eigen::Index(b));
    const Eigen::Quaterniond q(entry[3], entry[4], entry[5], entry[6]);
    state.bodies[b] = {entry.head<3>(), q.normalized(), entry.segment<3>(7), entry.tail<3>()};
  }
  return state;
}

/// One trajectory; steps as long as the tolerance lets them be.
class Swing {
 public:
  Swing(const Form& form, State start, double tolerance)
      : form_(form), state_(std::move(start)), tolerance_(tolerance) {}

  const PlacedBodies& bodies() const { return state_.bodies; }

  /// False when steps get too short or too many.
  bool advance_to(double end) {
    while (state_.t < end) {
      if (++steps_ > kMostSteps || !(step_ > kShortestStep)) return false;
      const bool last = end - state_.t <= step_;
      const double h = last ? end - state_.t : step_;
      const auto [x, error] = extrapolated(h);
      const double factor =
          std::clamp(0.8 * std::pow(tolerance_ / error, 1.0 / (2 * kColumns - 1)), 0.1, 3.0);
      const bool accepted = error <= tolerance_;
      if (!accepted || !last || factor < 1) step_ = h * (std::isfinite(factor) ? factor : 0.1);
      if (!accepted) continue;
      State next = unpacked(x, state_);
      next.t = last ? end : state_.t + h;
      state_ = form_.projected(std::move(next));
    }
    return packed(state_).allFinite();
  }

 private:
  VectorXd rates(const VectorXd& x) {
    const State state = unpacked(x, state_);
    const auto result = form_.rates(state, VectorXd());
    VectorXd f(x.size());
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      const auto& body = state.bodies[b];
      const Eigen::Vector3d half = body.omega / 2;
      const Eigen::Quaterniond turn = body.orientation * Eigen::Quaterniond(0, half.x(), half.y(), half.z());
      f.segment<kEntries>(kEntries * Eigen::Index(b)) << body.v_C, turn.w(), turn.x(), turn.y(), turn.z(),
          result.xdot.segment<6>(6 * Eigen::Index(b));
    }
    return f;
  }

  /// Modified midpoint rule with `count` substeps.
  VectorXd midpoint(const VectorXd& x, const VectorXd& f, double h, int count) {
    const double part = h / count;
    VectorXd before = x, now = x + part * f;
    for (int i = 1; i < count; ++i) {
      const VectorXd next = before + 2 * part * rates(now);
      before = std::exchange(now, next);
    }
    return 0.5 * (before + now + part * rates(now));
  }

  /// Gragg, Bulirsch and Stoer: 2, 4, 6, … substeps extrapolated in the squares of their lengths. The result and the
  /// difference of the last two columns. Loads do not depend on time.
  std::pair<VectorXd, double> extrapolated(double h) {
    const VectorXd x = packed(state_), f = rates(x);
    std::vector<VectorXd> row;
    for (int j = 0; j < kColumns; ++j) {
      VectorXd entry = midpoint(x, f, h, 2 * (j + 1));
      for (int k = 0; k < j; ++k) {
        const double ratio = double(j + 1) / double(j - k);
        const VectorXd next = entry + (entry - row[std::size_t(k)]) / (ratio * ratio - 1);
        row[std::size_t(k)] = std::exchange(entry, next);
      }
      row.push_back(entry);
    }
    const VectorXd gap = row[kColumns - 1] - row[kColumns - 2];
    const double error = (gap.array().abs() / (1 + x.array().abs())).maxCoeff();
    return {row.back(), std::isfinite(gap.sum()) ? std::max(error, 1e-300) : HUGE_VAL};
  }

  const Form& form_;
  State state_;
  double tolerance_;
  double step_ = 0.01;  // s
  long steps_ = 0;
};

State start_of(const model::Mechanism& mechanism, const Form& form) {
  const auto start = reference::Reference<double>(mechanism).initial_state();
  return form.projected(form.absolute(0, start.y, start.z));
}

}  // namespace

double difference(const PlacedBodies& a, const PlacedBodies& b, double size) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = (a[i].p_WC - b[i].p_WC).norm() / size,
                 turned = a[i].orientation.angularDistance(b[i].orientation);
    if (!std::isfinite(apart + turned)) return NAN;
    worst = std::max({worst, apart, turned});
  }
  return worst;
}

std::size_t KnownMotion::known() const {
  const auto beyond = std::find_if(doubt.begin(), doubt.end(), [](double d) { return !(d <= kAgreement); });
  return static_cast<std::size_t>(beyond - doubt.begin());
}

KnownMotion known_motion(const model::Mechanism& mechanism, double size, const Looks& looks) {
  const Form form(mechanism, {.dependent = kRedundant});
  const State start = start_of(mechanism, form);
  Swing coarse(form, start, kCoarse), fine(form, start, kFine);
  KnownMotion motion{{start.bodies}, {kOwnError}};
  for (std::size_t k = 1; k <= looks.count; ++k) {
    const double t = looks.interval * double(k);
    if (!coarse.advance_to(t) || !fine.advance_to(t)) break;
    motion.bodies.push_back(fine.bodies());
    motion.doubt.push_back(std::max(motion.doubt.back(), difference(coarse.bodies(), fine.bodies(), size)));
    if (!(motion.doubt.back() <= kAgreement)) break;
  }
  return motion;
}

}  // namespace jourdain::tests
