#include "model/coordinates.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/joint_kinds.hpp"

namespace jourdain::model {

namespace {

/// Appends "<joint>_<suffix>" for each suffix.
void add_names(std::vector<std::string>& names, const Joint& joint,
               std::initializer_list<const char*> suffixes) {
  for (const char* suffix : suffixes) names.push_back(fmt::format("{}_{}", joint.name, suffix));
}

}  // namespace

std::array<std::array<double, 3>, 2> plane_axes(const std::array<double, 3>& n) {
  if (n[2] == 1) return {{{1, 0, 0}, {0, 1, 0}}};
  if (n[0] == 1) return {{{0, 1, 0}, {0, 0, 1}}};
  if (n[1] == 1) return {{{0, 0, 1}, {1, 0, 0}}};
  if (n[2] == -1) return {{{1, 0, 0}, {0, -1, 0}}};
  const double rho = std::hypot(n[0], n[1]);
  const std::array<double, 3> e{-n[1] / rho, n[0] / rho, 0};
  return {{e, {-n[2] * e[1], n[2] * e[0], n[0] * e[1] - n[1] * e[0]}}};
}

std::array<std::array<double, 3>, 2> slide_directions(const std::array<double, 3>& normal) {
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  return plane_axes({normal[0] / length, normal[1] / length, normal[2] / length});
}

namespace {

Tangent tangent_of(const Mechanism& mechanism, const std::vector<JointEntries>& joints) {
  Tangent tangent;
  for (const JointIndex index : depth_first(mechanism)) {
    const JointEntries& entries = joints[index.value];
    const bool turns = joint_kind(mechanism.joints[index.value]).has_quaternion();
    const std::size_t scalars = entries.velocity_count - (turns ? 3 : 0);
    for (std::size_t k = 0; k < scalars; ++k)
      tangent.scalars.push_back({entries.first_position + k, entries.first_velocity + k});
    if (turns)
      tangent.quaternions.push_back({entries.first_position + scalars, entries.first_velocity + scalars});
  }
  return tangent;
}

}  // namespace

CoordinateLayout lay_out_coordinates(const Mechanism& mechanism) {
  CoordinateLayout layout;
  layout.joints.resize(mechanism.joints.size());
  for (const JointIndex index : depth_first(mechanism)) {
    const Joint& joint = mechanism.joints[index.value];
    JointEntries& entries = layout.joints[index.value];
    entries.first_position = layout.position_names.size();
    entries.first_velocity = layout.velocity_names.size();
    for (const Coordinate& coordinate : joint.coordinates) {
      entries.position.emplace_back();
      entries.velocity.emplace_back();
      if (coordinate.motion) continue;
      entries.position.back() = layout.position_names.size();
      entries.velocity.back() = layout.velocity_names.size();
      layout.position_names.push_back(coordinate.name);
      layout.velocity_names.push_back(coordinate.name);
    }
    if (joint_kind(joint).has_origin()) {
      add_names(layout.position_names, joint, {"x", "y", "z"});
      add_names(layout.velocity_names, joint, {"vx", "vy", "vz"});
    }
    if (joint_kind(joint).has_quaternion()) {
      layout.quaternions.push_back(layout.position_names.size());
      add_names(layout.position_names, joint, {"qw", "qx", "qy", "qz"});
      add_names(layout.velocity_names, joint, {"wx", "wy", "wz"});
    }
    entries.position_count = layout.position_names.size() - entries.first_position;
    entries.velocity_count = layout.velocity_names.size() - entries.first_velocity;
  }
  for (const StateVariable& state : mechanism.states) layout.velocity_names.push_back(state.name);
  layout.state_count = mechanism.states.size();
  for (const Actuator& actuator : mechanism.actuators) layout.input_names.push_back(actuator.name);
  for (const Input& input : mechanism.inputs) layout.input_names.push_back(input.name);
  layout.tangent = tangent_of(mechanism, layout.joints);
  return layout;
}

}  // namespace jourdain::model
