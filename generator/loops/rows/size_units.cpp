#include "loops/rows/size_units.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::loops {

namespace {

/// Joints that carry what loops join, by index; all where a loop is an expression.
std::vector<bool> carrying_joints(const model::Mechanism& mechanism) {
  std::vector<bool> carry(mechanism.joints.size(), false);
  const auto add = [&](model::FrameIndex frame) {
    std::optional<model::BodyIndex> body = mechanism.frames[frame.value].body;
    while (body) {
      const auto joint = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                      [&](const model::Joint& j) { return j.child == *body; });
      if (joint == mechanism.joints.end()) return;
      carry[static_cast<std::size_t>(joint - mechanism.joints.begin())] = true;
      body = joint->parent;
    }
  };
  for (const model::Loop& loop : mechanism.loops) {
    if (!model::loop_kind(loop).has_ends()) return std::vector<bool>(carry.size(), true);
    add(loop.from);
    add(loop.to);
  }
  return carry;
}

/// How far what loops join, and the joints that carry it, are from the origins of what they are on, how long bars are
/// and how far slides start from there, at most. Places on the world count where all that is next to nothing beside
/// them, by rounding: a mechanism may stand far from its origin.
long double size_of(const model::Mechanism& mechanism, const std::vector<double>& parameters) {
  constexpr long double kNoise = 1e-8L, kLeast = 1e-9L;  // m
  long double own = 0, on_world = 0;
  const auto length = [&](const model::Expression& entry) {
    return static_cast<long double>(entry.evaluate<double>(parameters));
  };
  const auto reach = [&](const model::Placement& placement, bool is_world) {
    long double square = 0;
    for (const model::Expression& entry : placement.position) square += length(entry) * length(entry);
    long double& largest = is_world ? on_world : own;
    largest = std::max(largest, std::sqrt(square));
  };
  const std::vector<bool> carry = carrying_joints(mechanism);
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const model::Joint& joint = mechanism.joints[j];
    if (!carry[j]) continue;
    reach(joint.placement, !joint.parent);
    const auto coordinates = model::joint_kind(joint).coordinates();
    for (std::size_t c = 0; c < coordinates.size(); ++c)
      if (coordinates[c].kind == model::MotionKind::kSlide)
        own = std::max(own, std::abs(length(joint.coordinates[c].initial_position)));
  }
  for (const model::Loop& loop : mechanism.loops) {
    if (!model::loop_kind(loop).has_ends()) continue;
    for (const model::FrameIndex end : {loop.from, loop.to})
      reach(mechanism.frames[end.value].placement, !mechanism.frames[end.value].body);
    if (model::loop_kind(loop).is_bar())
      own = std::max(
          own, std::abs(static_cast<long double>(loop.length.evaluate<double>(
                   parameters, [](double v) { return v; }, [](const model::Variable&) { return 0.0; }))));
  }
  const long double size = own > kNoise * on_world ? own : on_world;
  return size > kLeast ? size : 0;
}

long double length_unit(long double size) {
  constexpr long double kSmall = 0.05L, kLarge = 2;  // m
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
