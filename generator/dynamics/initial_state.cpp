#include "dynamics/initial_state.hpp"

#include "model/joint_kinds.hpp"

namespace jourdain::dynamics {

void derive_initial_state(const Scene& scene, Equations& equations) {
  const auto push_y = [&](const model::Expression& value) {
    equations.initial_position.push_back(scene.value("y_initial", value));
  };
  const auto push_z = [&](const model::Expression& value) {
    equations.initial_velocity.push_back(scene.value("z_initial", value));
  };
  for (const model::JointIndex index : model::moving_joints(scene.mechanism)) {
    const model::Joint& joint = scene.mechanism.joints[index.value];
    for (const model::Coordinate& coordinate : joint.coordinates) {
      if (coordinate.motion) continue;
      push_y(coordinate.initial_position);
      push_z(coordinate.initial_velocity);
    }
    if (model::joint_kind(joint).has_origin())
      for (std::size_t k = 0; k < 3; ++k) {
        push_y(joint.initial_origin[k]);
        push_z(joint.initial_origin_velocity[k]);
      }
    if (!model::joint_kind(joint).has_quaternion()) continue;
    for (const model::Expression& component : joint.initial_orientation) push_y(component);
    for (const model::Expression& component : joint.initial_spin) push_z(component);
  }
  for (const model::StateVariable& state : scene.mechanism.states) push_z(state.initial);
}

}  // namespace jourdain::dynamics
