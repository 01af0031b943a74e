#include "loops/plan/given_values.hpp"

#include <algorithm>
#include <array>

#include "model/joint_kinds.hpp"

namespace jourdain::loops {

namespace {

/// Whether they follow parameters.
template <class Expressions>
bool follow(const Expressions& entries) {
  return std::any_of(entries.begin(), entries.end(), [](const model::Expression& entry) {
    return std::any_of(entry.nodes().begin(), entry.nodes().end(), [](const model::Expression::Node& node) {
      return node.op == model::Expression::Op::kParameter;
    });
  });
}

}  // namespace

GivenValues given_values(const model::Mechanism& mechanism, const model::CoordinateLayout& layout) {
  GivenValues given;
  given.position.resize(layout.velocity_count());
  given.velocity.resize(layout.velocity_count());
  const auto three = [](std::vector<GivenValue>& values, std::size_t first, const GivenValue& value) {
    std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(first), 3, value);
  };
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const model::Joint& joint = mechanism.joints[j];
    const model::JointEntries& entries = layout.joints[j];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c) {
      if (!entries.velocity[c]) continue;
      const model::Coordinate& coordinate = joint.coordinates[c];
      const std::array position{coordinate.initial_position}, velocity{coordinate.initial_velocity};
      given.position[*entries.velocity[c]] = {coordinate.position_where, follow(position)};
      given.velocity[*entries.velocity[c]] = {coordinate.velocity_where, follow(velocity)};
    }
    const model::JointKind& kind = model::joint_kind(joint);
    if (kind.has_origin()) {
      three(given.position, entries.first_velocity, {joint.origin_where, follow(joint.initial_origin)});
      three(given.velocity, entries.first_velocity,
            {joint.origin_velocity_where, follow(joint.initial_origin_velocity)});
    }
    if (kind.has_quaternion()) {
      const std::size_t first = entries.first_velocity + (kind.has_origin() ? 3 : 0);
      three(given.position, first, {joint.orientation_where, follow(joint.initial_orientation)});
      three(given.velocity, first, {joint.spin_where, follow(joint.initial_spin)});
    }
  }
  return given;
}

}  // namespace jourdain::loops
