#include "commands/spread_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "loops/plan/parameter_check.hpp"

namespace jourdain::commands {

namespace {

std::array<double, 2> drawn_range(const Spread& spread, std::size_t number, std::uint64_t seed,
                                  std::uint64_t states) {
  double least = spread.value(seed, 0, number), greatest = least;
  for (std::uint64_t k = 1; k < states; ++k) {
    const double value = spread.value(seed, k, number);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  return {least, greatest};
}

/// At one value of what is spread.
bool is_sound_with(const RunModel& model, const std::string& path, const Spread& spread, double value) {
  const auto& range = model.loaded.mechanism.parameters[spread.entry].range;
  if (range && !((*range)[0] <= value && value <= (*range)[1])) {
    fmt::print(stderr, "error: --spread draws {} = {:g}, which is outside its range from {} to {}\n",
               spread.name, value, (*range)[0], (*range)[1]);
    return false;
  }
  RunModel drawn = model;
  drawn.parameters[spread.entry] = value;
  if (const loops::LoopPlan* plan = model.loaded.plan())
    if (const auto failure = loops::unproven_at(model.loaded.mechanism, *plan, drawn.parameters)) {
      fmt::print(stderr, "error: --spread of {}: {}\n", spread.name, *failure);
      return false;
    }
  return is_sound_at(drawn, path, fmt::format("--spread draws {} = {:g}", spread.name, value));
}

}  // namespace

bool is_sound_where_drawn(const RunModel& model, const std::string& path, const std::vector<Spread>& spreads,
                          std::uint64_t seed, std::uint64_t states) {
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    if (spreads[i].of != Spread::Of::kParameter) continue;
    for (const double value : drawn_range(spreads[i], i, seed, states))
      if (!is_sound_with(model, path, spreads[i], value)) return false;
  }
  return true;
}

}  // namespace jourdain::commands
