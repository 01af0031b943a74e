#include "model/mechanism.hpp"

#include <algorithm>

namespace jourdain::model {

namespace {

/// From the body inward to the one that stands on the world.
std::vector<BodyIndex> inward(const Mechanism& mechanism, std::optional<BodyIndex> body) {
  std::vector<BodyIndex> path;
  while (body) {
    path.push_back(*body);
    const auto joint = std::find_if(mechanism.joints.begin(), mechanism.joints.end(),
                                    [&](const Joint& j) { return j.child == *body; });
    JD_CHECK(joint != mechanism.joints.end() && path.size() <= mechanism.bodies.size(), "no tree of joints");
    body = joint->parent;
  }
  return path;
}

}  // namespace

std::optional<BodyIndex> carrier(const Mechanism& mechanism, std::optional<BodyIndex> a,
                                 std::optional<BodyIndex> b) {
  const std::vector<BodyIndex> carries_b = inward(mechanism, b);
  for (const BodyIndex body : inward(mechanism, a))
    if (std::find(carries_b.begin(), carries_b.end(), body) != carries_b.end()) return body;
  return {};
}

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

std::vector<double> default_values(const Mechanism& mechanism) {
  std::vector<double> values;
  for (const Parameter& parameter : mechanism.parameters) values.push_back(parameter.value);
  return values;
}

}  // namespace jourdain::model
