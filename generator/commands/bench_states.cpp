#include "commands/bench_states.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "model/coordinates.hpp"
#include "programs/entries.hpp"
#include "support/uniform.hpp"

namespace jourdain::commands {

namespace {

constexpr double kNearLoops = 0.1, kNearStart = 0.5;

/// Where an entry of y is drawn; quaternions are made of unit length afterwards.
std::array<double, 2> range_of(const model::Mechanism& mechanism, const programs::Entry& entry,
                               bool has_loops) {
  if (has_loops) return {entry.initial - kNearLoops, entry.initial + kNearLoops};
  if (entry.unit == "1") return {-1, 1};
  const model::Coordinate* coordinate =
      entry.joint && entry.coordinate ? &mechanism.joints[entry.joint->value].coordinates[*entry.coordinate]
                                      : nullptr;
  if (coordinate && coordinate->range && std::isfinite((*coordinate->range)[0]) &&
      std::isfinite((*coordinate->range)[1]))
    return *coordinate->range;
  if (coordinate && coordinate->angular) return {-std::numbers::pi, std::numbers::pi};
  return {entry.initial - kNearStart, entry.initial + kNearStart};
}

void normalise(double* quaternion) {
  double square = 0;
  for (int i = 0; i < 4; ++i) square += quaternion[i] * quaternion[i];
  for (int i = 0; i < 4; ++i) quaternion[i] /= std::sqrt(square);
}

}  // namespace

std::vector<std::vector<double>> draw_bench_states(const model::Mechanism& mechanism,
                                                   const loops::LoopPlan* plan, int count,
                                                   std::uint64_t seed) {
  const programs::Entries entries = programs::entries_of(mechanism, plan);
  const std::vector<std::size_t> quaternions = model::lay_out_coordinates(mechanism).quaternions;
  support::Uniform uniform(seed);
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < count; ++i) {
    std::vector<double> row = {uniform(0, 2)};
    for (const programs::Entry& entry : entries.positions) {
      const auto [low, high] = range_of(mechanism, entry, plan != nullptr);
      row.push_back(uniform(low, high));
    }
    for (const std::size_t q : quaternions) normalise(&row[1 + q]);
    row.resize(row.size() + entries.velocities.size() * 2 + entries.inputs.size());
    auto value = row.begin() + 1 + static_cast<std::ptrdiff_t>(entries.positions.size());
    for (std::size_t k = 0; k < entries.velocities.size(); ++k) *value++ = uniform(-1, 1);
    while (value != row.end()) *value++ = uniform(-5, 5);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace jourdain::commands
