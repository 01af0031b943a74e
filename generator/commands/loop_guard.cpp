#include "commands/loop_guard.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace jourdain::commands {

namespace {

constexpr double kOpen = 1e-10;  ///< m; what rounding leaves is far below

}  // namespace

LoopGuard::LoopGuard(const studies::Flow<double>& flow, const LoadedMechanism& loaded, double h)
    : flow_(flow), loaded_(loaded), h_(h) {}

std::string LoopGuard::problem(const studies::Point<double>& point) const {
  const studies::Closing closing = flow_.last_closing();
  if (!flow_.is_regular()) return singular(point.t, closing.regularity);
  if (const std::string outside = out_of_range(point); !outside.empty()) return outside;
  const double open = flow_.residuals(point).position;
  if (closing.opening <= flow_.table().greatest_opening || open <= kOpen) return "";
  return fmt::format(
      "at t = {:g} s a step of {:g} s is too long: closing the loops leaves them open by {:.2g} m; take "
      "shorter steps",
      point.t, h_, open);
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
  if (!loaded_.plan()->is_reduced()) return "";
  const model::CoordinateLayout layout = model::lay_out_coordinates(loaded_.mechanism);
  for (std::size_t j = 0; j < loaded_.mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < loaded_.mechanism.joints[j].coordinates.size(); ++c) {
      const auto& range = loaded_.mechanism.joints[j].coordinates[c].range;
      const auto entry = layout.joints[j].position[c];
      if (!range || !entry) continue;
      const double y = point.x[*entry];
      if (y < (*range)[0] || y > (*range)[1])
        return fmt::format(
            "at t = {:g} s {} = {:.6g} leaves its range [{:g}, {:g}]: how the loops are closed holds only "
            "there; widen the range, or use treatment = \"multipliers\" in [loops]",
            point.t, layout.position_names[*entry], y, (*range)[0], (*range)[1]);
    }
  return "";
}

}  // namespace jourdain::commands
