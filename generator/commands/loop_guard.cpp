#include "commands/loop_guard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/loop_kinds.hpp"

namespace jourdain::commands {

namespace {

/// m; the next closing makes good what is less. Rounding of lengths and angles of 1 leaves less, in float, too.
constexpr double kOpen = 1e-9, kRoundings = 32;
/// Number types that round by more are not double.
constexpr double kDouble = std::numeric_limits<double>::epsilon();

}  // namespace

LoopGuard::LoopGuard(const studies::Flow<double>& flow, const LoadedMechanism& loaded, double h)
    : flow_(flow), loaded_(loaded), parameters_(model::default_values(loaded.mechanism)), h_(h) {}

std::string LoopGuard::problem(const studies::Point<double>& point) const {
  if (const model::Loop* bar = model::bar_without_length(loaded_.mechanism, parameters_, point.t))
    return fmt::format("at t = {:g} s the length of {} is no longer positive", point.t,
                       model::in_words(*bar));
  const jourdain_closing closing = flow_.last_closing();
  if (!(closing.regularity >= flow_.table().least_regularity)) return singular(point.t, closing.regularity);
  if (closing.beyond > 0) return out_of_range(point);
  if (!loaded_.plan()->redundant.empty()) {
    const double open = flow_.residuals(point).position;
    if (open > loaded_.plan()->most_left_open())
      return fmt::format(
          "at t = {:g} s constraints contradict each other: those that follow from the others are open by "
          "{:.2g} m",
          point.t, open);
  }
  if (closing.opening <= flow_.table().greatest_opening) return "";
  double size = 1;
  for (std::size_t i = 0; i < flow_.position_count(); ++i) size = std::max(size, std::fabs(point.x[i]));
  if (!(closing.left_open <= std::max(kOpen, kRoundings * size * flow_.table().unit_roundoff)))
    return fmt::format(
        "at t = {:g} s closing the loops leaves them open by {:.2g} m: a step of {:g} s is too long (take a "
        "shorter one), {}there is no way on: no positions close them",
        point.t, closing.left_open, h_,
        flow_.table().unit_roundoff > kDouble ? "float is too coarse there (run it in double), or " : "or ");
  if (!loaded_.plan()->proof) return "";
  return fmt::format(
      "at t = {:g} s a step of {:g} s is too long: closing the loops moved positions by {:.2g} (rad, m), "
      "beyond {:.2g} it is not proven that they end where they should; take shorter steps",
      point.t, h_, std::sqrt(closing.opening), std::sqrt(flow_.table().greatest_opening));
}

std::string LoopGuard::singular(double t, double regularity) const {
  const loops::LoopPlan& plan = *loaded_.plan();
  if (std::isnan(regularity))
    return fmt::format(
        "at t = {:g} s the loops cannot be closed: the state is not finite; a step of {:g} s "
        "may be too long, or the mechanism cannot go on",
        t, h_);
  if (!plan.is_reduced())
    return fmt::format(
        "at t = {:g} s the mechanism itself is singular (regularity {:.2g}): its constraints do not tell how "
        "it "
        "goes on; treatment = \"multipliers\" in [loops] goes straight on",
        t, regularity);
  const model::CoordinateLayout layout = model::lay_out_coordinates(loaded_.mechanism);
  std::vector<std::string> names;
  for (const std::size_t k : plan.independent) names.push_back(layout.velocity_names[k]);
  return fmt::format(
      "at t = {:g} s the other coordinates no longer follow from {} (regularity {:.2g}): name other "
      "independent ones, or use treatment = \"multipliers\" in [loops]",
      t, fmt::join(names, ", "), regularity);
}

std::string LoopGuard::out_of_range(const studies::Point<double>& point) const {
  const std::vector<loops::ProvenRange>& ranges = loaded_.plan()->proven()->positions;
  const auto excess = [&point](const loops::ProvenRange& range) {
    return (point.x[range.index] - range.low) * (point.x[range.index] - range.high);
  };
  const auto range = *std::max_element(ranges.begin(), ranges.end(),
                                       [&](const auto& a, const auto& b) { return excess(a) < excess(b); });
  return fmt::format(
      "at t = {:g} s {} = {:.6g} leaves its range [{:g}, {:g}]: how the loops are closed holds only "
      "there; widen the range, or use treatment = \"multipliers\" in [loops]",
      point.t, flow_.table().position_names[range.index], point.x[range.index], range.low, range.high);
}

}  // namespace jourdain::commands
