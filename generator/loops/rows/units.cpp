#include "loops/rows/units.hpp"

#include <algorithm>
#include <cmath>

#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::loops {

namespace {

/// How far frames and joints are from the origins of what carries them, at most; on the world only where all others
/// are 0: a mechanism may stand far from its origin.
long double size_of(const model::Mechanism& mechanism, const std::vector<double>& parameters) {
  long double on_bodies = 0, on_world = 0;
  const auto reach = [&](const model::Placement& placement, bool is_world) {
    long double square = 0;
    for (const model::Expression& entry : placement.position) {
      const long double length = entry.evaluate<double>(parameters);
      square += length * length;
    }
    long double& largest = is_world ? on_world : on_bodies;
    largest = std::max(largest, std::sqrt(square));
  };
  for (const model::Joint& joint : mechanism.joints) reach(joint.placement, !joint.parent);
  for (const model::Frame& frame : mechanism.frames) reach(frame.placement, !frame.body);
  return on_bodies > 0 ? on_bodies : on_world;
}

long double length_unit(long double size) {
  constexpr long double kSmall = 0.05L, kLarge = 20;  // m
  if (!(size > 0) || !std::isfinite(size)) return 1;
  return size < kSmall ? size / kSmall : std::max(1.0L, size / kLarge);
}

}  // namespace

std::vector<bool> length_rows(const model::Mechanism& mechanism) {
  std::vector<bool> are_lengths;
  for (const model::Loop& loop : mechanism.loops)
    for (const model::LoopRow& row : model::loop_kind(loop).rows) are_lengths.push_back(row.is_length);
  return are_lengths;
}

Units units_of(const model::Mechanism& mechanism, const std::vector<double>& parameters) {
  Units units;
  units.length = length_unit(size_of(mechanism, parameters));
  for (const bool is_length : length_rows(mechanism)) units.rows.push_back(is_length ? units.length : 1.0L);
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  units.velocities.assign(layout.velocity_count(), 1.0L);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const model::JointKind& kind = model::joint_kind(mechanism.joints[j]);
    const model::JointEntries& entries = layout.joints[j];
    for (std::size_t c = 0; c < kind.coordinates().size(); ++c)
      if (entries.velocity[c] && kind.coordinates()[c].kind == model::MotionKind::kSlide)
        units.velocities[*entries.velocity[c]] = units.length;
    if (kind.has_origin())
      std::fill_n(units.velocities.begin() + static_cast<std::ptrdiff_t>(entries.first_velocity), 3,
                  units.length);
  }
  return units;
}

}  // namespace jourdain::loops
