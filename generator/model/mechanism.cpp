#include "model/mechanism.hpp"

namespace jourdain::model {

std::vector<JointIndex> depth_first(const Mechanism& mechanism) {
  std::vector<std::vector<std::size_t>> joints_of_body(mechanism.bodies.size());
  std::vector<std::size_t> waiting;  // next joint last
  for (std::size_t j = mechanism.joints.size(); j-- > 0;) {
    const auto& parent = mechanism.joints[j].parent;
    (parent ? joints_of_body[parent->value] : waiting).push_back(j);
  }
  std::vector<JointIndex> order;
  while (!waiting.empty()) {
    const std::size_t joint = waiting.back();
    waiting.pop_back();
    JD_CHECK(order.size() < mechanism.joints.size(), "joint {} is part of a loop", joint);
    order.emplace_back(joint);
    const auto& children = joints_of_body[mechanism.joints[joint].child.value];
    waiting.insert(waiting.end(), children.begin(), children.end());
  }
  return order;
}

std::vector<JointIndex> moving_joints(const Mechanism& mechanism) {
  std::vector<JointIndex> order;
  for (const JointIndex joint : depth_first(mechanism))
    if (mechanism.joints[joint.value].type != JointType::kFixed) order.push_back(joint);
  return order;
}

}  // namespace jourdain::model
