#include "properties/gimbals.hpp"

namespace jourdain::tests {

std::vector<Sequence> all_sequences() {
  std::vector<Sequence> list;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        if (i != j && j != k) list.push_back({i, j, k});
  return list;
}

Sequence random_sequence(Random& random) {
  const std::vector<Sequence> list = all_sequences();
  return list[random.below(list.size())];
}

model::Mechanism on_hinges(const model::Mechanism& gimbal) {
  model::Mechanism mechanism = gimbal;
  const model::Joint& joint = gimbal.joints.front();
  mechanism.joints.clear();
  for (std::size_t k = 0; k < 3; ++k) {
    model::Joint hinge;
    hinge.name = joint.coordinates[k].name;
    hinge.set_type(model::JointType::kRevolute);
    hinge.axis = {0, 0, 0};
    hinge.axis[joint.sequence[k]] = 1;
    hinge.coordinates[0] = joint.coordinates[k];
    if (k == 0) hinge.placement = joint.placement;
    if (k > 0) hinge.parent = model::BodyIndex(mechanism.bodies.size() - 1);
    if (k < 2) {
      model::Body ring;
      ring.name = "ring_of_" + hinge.name;
      mechanism.bodies.push_back(ring);
    }
    hinge.child = k < 2 ? model::BodyIndex(mechanism.bodies.size() - 1) : joint.child;
    mechanism.joints.push_back(hinge);
  }
  return mechanism;
}

model::Mechanism on_ball(model::Mechanism gimbal) {
  gimbal.joints.front().set_type(model::JointType::kSpherical);
  return gimbal;
}

}  // namespace jourdain::tests
