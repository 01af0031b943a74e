#include "programs/like_limbs.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>

#include "model/coordinates.hpp"

namespace jourdain::programs {

namespace {

using ir::LeafKind;
using model::JointIndex;
using model::Mechanism;

constexpr auto kWorld = static_cast<std::size_t>(-1);

class Limbs {
 public:
  explicit Limbs(const Mechanism& mechanism)
      : mechanism_(mechanism), layout_(model::lay_out_coordinates(mechanism)) {
    std::map<std::size_t, JointIndex> of_child;
    for (std::size_t i = 0; i < mechanism.joints.size(); ++i)
      of_child.emplace(mechanism.joints[i].child.value, JointIndex(i));
    for (const JointIndex joint : model::moving_joints(mechanism)) {
      std::optional<model::BodyIndex> body = mechanism.joints[joint.value].parent;
      std::optional<JointIndex> parent;
      while (body && !parent) {
        const JointIndex carrier = of_child.at(body->value);
        if (mechanism.joints[carrier.value].type == model::JointType::kFixed)
          body = mechanism.joints[carrier.value].parent;
        else
          parent = carrier;
      }
      children_[parent ? parent->value : kWorld].push_back(joint);
    }
  }

  std::vector<passes::LikeLimbs> run() const {
    std::vector<passes::LikeLimbs> list;
    for (const auto& [joint, children] : children_) {
      std::map<std::string, std::vector<JointIndex>> by_shape;
      for (const JointIndex child : children) by_shape[shape(child)].push_back(child);
      for (const auto& [shape, roots] : by_shape) {
        if (roots.size() < 2) continue;
        passes::LikeLimbs& limbs = list.emplace_back();
        for (const JointIndex root : roots) add_leaves(root, limbs.emplace_back());
      }
    }
    return list;
  }

 private:
  std::vector<JointIndex> children(JointIndex joint) const {
    const auto it = children_.find(joint.value);
    return it == children_.end() ? std::vector<JointIndex>() : it->second;
  }

  std::string shape(JointIndex joint) const {
    const model::JointEntries& entries = layout_.joints[joint.value];
    std::string text = fmt::format("{} {} {} {}(", static_cast<int>(mechanism_.joints[joint.value].type),
                                   entries.position_count, entries.velocity_count, inputs(joint).size());
    for (const JointIndex child : children(joint)) text += shape(child);
    return text + ")";
  }

  std::vector<std::size_t> inputs(JointIndex joint) const {
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < mechanism_.actuators.size(); ++i)
      if (mechanism_.actuators[i].joint == joint) list.push_back(i);
    return list;
  }

  void add_leaves(JointIndex joint, std::vector<passes::Leaf>& leaves) const {
    const model::JointEntries& entries = layout_.joints[joint.value];
    for (std::size_t i = 0; i < entries.position_count; ++i)
      leaves.push_back({LeafKind::kPosition, entries.first_position + i});
    for (std::size_t i = 0; i < entries.velocity_count; ++i) {
      leaves.push_back({LeafKind::kVelocity, entries.first_velocity + i});
      leaves.push_back({LeafKind::kAcceleration, entries.first_velocity + i});
    }
    for (const std::size_t input : inputs(joint)) leaves.push_back({LeafKind::kInput, input});
    for (const JointIndex child : children(joint)) add_leaves(child, leaves);
  }

  const Mechanism& mechanism_;
  model::CoordinateLayout layout_;
  std::map<std::size_t, std::vector<JointIndex>> children_;
};

}  // namespace

std::vector<passes::LikeLimbs> like_limbs(const Mechanism& mechanism) {
  return mechanism.loops.empty() ? Limbs(mechanism).run() : std::vector<passes::LikeLimbs>();
}

}  // namespace jourdain::programs
