#include "commands/run_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/amplification.hpp"
#include "studies/linearisation.hpp"
#include "studies/spectra.hpp"

namespace jourdain::commands {

using studies::Flow;
using studies::Point;

namespace {

constexpr double kMostSpeed = 1e12, kMostEnergy = 1e6, kNoticeable = 1e-2;
/// Slower modes do not part from the motion in a few steps, |hµ|.
constexpr double kFast = 0.5;
/// Damping below this share of a mode is rounding of the linearisation's differences.
constexpr double kUndamped = 1e-8;
/// Of differences in a step, beyond their own growth: what rounding of eigenvalues cannot do.
constexpr double kGrowth = 1.1;
/// Squares of larger numbers may not be finite in float.
constexpr double kHuge = 1e15;

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

std::string mode_text(std::complex<double> mu) {
  if (std::fabs(mu.imag()) < 1e-3 * std::abs(mu)) return fmt::format("{:.3g}/s", mu.real());
  return fmt::format("({:.3g} +- {:.3g}i)/s", mu.real(), std::fabs(mu.imag()));
}

}  // namespace

RunBounds::RunBounds(const Flow<double>& flow, const Point<double>& start, bool conserves_energy)
    : table_(flow.table()), conserves_energy_(conserves_energy) {
  const double* y = start.x.data();
  const double* z = y + table_.position_count;
  double fastest = 1;
  for (int k = 0; k < table_.velocity_count; ++k) fastest = std::max(fastest, std::fabs(z[k]));
  fastest_ = kMostSpeed * fastest;
  const std::vector<double> unit(static_cast<std::size_t>(table_.velocity_count), 1.0);
  const Energies now = energies(start.t, y, z);
  energy_ = now.kinetic + now.potential;
  most_energy_ =
      kMostEnergy * (now.kinetic + std::fabs(now.potential) + energies(start.t, y, unit.data()).kinetic);
}

RunBounds::Energies RunBounds::energies(double t, const double* y, const double* z) const {
  Energies found;
  table_.kinetic_energy(&t, y, z, &found.kinetic);
  table_.potential_energy(&t, y, z, &found.potential);
  return found;
}

std::string RunBounds::breach(const Point<double>& point) const {
  if (!all_finite(point.x)) return "the state is not finite";
  const double* z = point.x.data() + table_.position_count;
  for (int k = 0; k < table_.velocity_count; ++k)
    if (std::fabs(z[k]) > fastest_)
      return fmt::format("'{}' moves at {:.3g} rad/s or m/s", table_.velocity_names[k], z[k]);
  return energy_breach(point);
}

std::string RunBounds::energy_breach(const Point<double>& point) const {
  const Energies now = energies(point.t, point.x.data(), point.x.data() + table_.position_count);
  const double total = now.kinetic + now.potential, change = std::fabs(total - energy_);
  if (!std::isfinite(total)) return "the energy is not finite";
  if (!conserves_energy_) return "";
  if (!(change > most_energy_) || !(change > kNoticeable * (now.kinetic + std::fabs(now.potential))))
    return "";
  return fmt::format("the energy, which nothing changes, went from {:.3g} to {:.3g} J", energy_, total);
}

namespace {

/// What one step of a partitioned method does to the linear system x' = A x; empty where no difference grows
/// more than it should.
std::string growth_text(const studies::StabilityFunction& function, const Eigen::MatrixXd& A, double growth,
                        double t, double h) {
  const double factor = studies::spectral_radius(studies::step_matrix(function, A, h));
  if (!(factor > kGrowth * std::exp(growth * h))) return "";
  return fmt::format("{} multiplies differences by {:.3g} in a step at t = {:g} s", function.method, factor,
                     t);
}

/// A clause on what steps of length `h` cannot follow at `point`; empty where there is nothing.
std::string limit_text(const Flow<double>& flow, const Point<double>& point, const model::Tangent& tangent,
                       const std::string& method, double h) {
  const studies::StabilityFunction* function = studies::stability_function(method);
  if (!function || flow.table().velocity_count == 0) return "";
  const Eigen::MatrixXd A = studies::linearisation(flow, point, tangent);
  if (!A.allFinite()) return "";
  const Eigen::VectorXcd modes = studies::modes_of(A).values;
  if (!modes.allFinite()) return "";
  if (function->kind == studies::StabilityFunction::Kind::kPartitioned)
    return growth_text(*function, A, std::max(0.0, modes.real().maxCoeff()), point.t, h);
  double limit = h;
  std::complex<double> worst;
  for (std::complex<double> mu : modes) {
    if (std::abs(mu) * h < kFast) continue;
    const bool undamped = std::fabs(mu.real()) < kUndamped * std::abs(mu);
    if (undamped) mu = {0, mu.imag()};
    const double longest = undamped && !studies::keeps_oscillations(*function)
                               ? 0
                               : studies::step_limit(*function, mu, {std::max(0.0, mu.real())});
    const bool grows_anyway = longest == 0 && mu.real() > 0;
    if (longest >= limit || grows_anyway) continue;
    limit = longest;
    worst = mu;
  }
  if (limit >= h) return "";
  if (limit == 0)
    return fmt::format("{} makes the mode {} grow at any step, the less the shorter it is", method,
                       mode_text(worst));
  return fmt::format("{} is stable up to steps of {:.3g} s at t = {:g} s, where a mode is {}", method, limit,
                     point.t, mode_text(worst));
}

/// What grows at `point` about as fast as anything decays there, and by more than exp(1/2) in a step of length `h`:
/// another method follows it no better.
std::string growth_limit_text(const Flow<double>& flow, const Point<double>& point,
                              const model::Tangent& tangent, double h) {
  constexpr double kAsFast = 0.5;
  if (flow.table().velocity_count == 0) return "";
  const Eigen::MatrixXd A = studies::linearisation(flow, point, tangent);
  if (!A.allFinite()) return "";
  const Eigen::VectorXcd modes = studies::modes_of(A).values;
  const double growth = modes.real().maxCoeff();
  if (!(growth * h > kFast) || !(growth > kAsFast * modes.cwiseAbs().maxCoeff())) return "";
  return fmt::format(
      "is too long: at t = {:g} s a mode grows at {:.3g}/s; take a shorter one: if it ends there, too, so "
      "does the motion",
      point.t, growth);
}

/// Whether rates are not finite at `point`, or where they lead to in half a step or one and no number is huge.
bool is_singular(const Flow<double>& flow, const Point<double>& point, double h) {
  const std::vector<double> rates = flow.rates(point.t, point.x);
  if (!all_finite(rates)) return true;
  for (const double step : {h / 2, h}) {
    std::vector<double> x = point.x;
    double largest = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += step * rates[k];
      largest = std::max(largest, std::fabs(x[k]));
    }
    if (largest < kHuge && !all_finite(flow.rates(point.t + step, x))) return true;
  }
  return false;
}

std::string growth_text(const Flow<double>& flow, const model::Tangent& tangent, const Breach& breach,
                        const std::string& method, double h) {
  const std::string limit = limit_text(flow, flow.start(), tangent, method, h);
  return limit.empty() ? fmt::format("error: {}\n", breach.what)
                       : fmt::format(
                             "error: a step of {:g} s is too long: {}; take a shorter one or --method "
                             "rodas4\n",
                             h, limit);
}

std::string bounds_text(const Flow<double>& flow, const model::Tangent& tangent, const Breach& breach,
                        const std::string& method, double h) {
  if (is_singular(flow, breach.last, h))
    return fmt::format(
        "error: the equations of motion have no finite rates from t = {:g} s on: the mass matrix is singular "
        "there, or "
        "a force has no value\n",
        breach.last.t);
  const bool is_stable_at_start = limit_text(flow, flow.start(), tangent, method, h).empty();
  const std::string growth = is_stable_at_start ? growth_limit_text(flow, breach.last, tangent, h) : "";
  const std::string limit = step_limit_text(flow, tangent, breach.last, method, h);
  const std::string verdict =
      !growth.empty() ? growth
      : limit.empty()
          ? "may be too long"
          : fmt::format(
                "is too long: {}; take a shorter one or --method rodas4{}", limit,
                flow.table().constraint_count == 0 ? "" : "; or the loops cannot be closed from there on");
  return fmt::format("error: the run leaves all bounds at t = {:g} s: {}\n  a step of {:g} s {}\n",
                     breach.end.t, breach.what, h, verdict);
}

}  // namespace

std::string breach_text(const Flow<double>& flow, const model::Tangent& tangent, const Breach& breach,
                        const std::string& method, double h) {
  switch (breach.of) {
    case Breach::Of::kLoops:
      return fmt::format("error: {}\n", breach.what);
    case Breach::Of::kGrowth:
      return growth_text(flow, tangent, breach, method, h);
    case Breach::Of::kBounds:
      break;
  }
  return bounds_text(flow, tangent, breach, method, h);
}

std::string step_limit_text(const Flow<double>& flow, const model::Tangent& tangent,
                            const Point<double>& point, const std::string& method, double h) {
  const std::string limit = limit_text(flow, flow.start(), tangent, method, h);
  return limit.empty() ? limit_text(flow, point, tangent, method, h) : limit;
}

}  // namespace jourdain::commands
