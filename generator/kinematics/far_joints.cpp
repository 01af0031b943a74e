#include "kinematics/far_joints.hpp"

#include <algorithm>
#include <cmath>

#include "model/joint_kinds.hpp"

namespace jourdain::kinematics {

namespace {

class Distances {
 public:
  explicit Distances(const model::Mechanism& mechanism)
      : mechanism_(mechanism),
        parameters_(model::default_values(mechanism)),
        reach_(mechanism.bodies.size()),
        base_(mechanism.bodies.size()) {}

  std::vector<bool> far() {
    const std::vector<model::JointIndex> order = model::depth_first(mechanism_);
    for (std::size_t i = order.size(); i-- > 0;) reach_outward(mechanism_.joints[order[i].value]);
    std::vector<bool> result(mechanism_.joints.size(), false);
    for (const model::JointIndex index : order) result[index.value] = is_far(mechanism_.joints[index.value]);
    return result;
  }

 private:
  double number(const model::Expression& e) const {
    return e.evaluate<double>(std::span<const double>(parameters_));
  }

  double length(const model::Vector3& v) const {
    return std::hypot(number(v[0]), number(v[1]), number(v[2]));
  }

  /// Size of a body by itself: where its centre of mass is and how far its mass extends.
  double size(const model::Body& body) const {
    const double mass = number(body.mass);
    const double moment =
        std::max({number(body.inertia.xx), number(body.inertia.yy), number(body.inertia.zz)});
    return std::max(length(body.center_of_mass), mass > 0 ? std::sqrt(std::max(moment, 0.0) / mass) : 0.0);
  }

  /// How far from the child's origin anything is that the joint moves. Children come before their parents.
  void reach_outward(const model::Joint& joint) {
    double& child = reach_[joint.child.value];
    child = std::max(child, size(mechanism_.bodies[joint.child.value]));
    if (!joint.parent) return;
    double& parent = reach_[joint.parent->value];
    parent = std::max(parent, length(joint.placement.position) + child);
  }

  /// Parents come before their children: `base_` is how far a body's origin may be from its link's origin.
  bool is_far(const model::Joint& joint) {
    const double distance =
        length(joint.placement.position) + (joint.parent ? base_[joint.parent->value] : 0);
    const double reach = reach_[joint.child.value];
    const std::span<const model::JointMotion> motions = model::joint_kind(joint).motions;
    const bool only_slides = std::ranges::all_of(
        motions, [](const model::JointMotion& m) { return m.kind == model::MotionKind::kSlide; });
    const double ratio = only_slides ? kFarSlide : kFarAway;
    const bool far = !motions.empty() && reach > 0 && distance > ratio * reach;
    const bool at_joint = far || model::joint_kind(joint).has(model::Along::kNone);
    base_[joint.child.value] = at_joint ? 0 : distance;
    return far;
  }

  const model::Mechanism& mechanism_;
  std::vector<double> parameters_;
  std::vector<double> reach_, base_;  // by BodyIndex, m
};

}  // namespace

std::vector<bool> far_joints(const model::Mechanism& mechanism) { return Distances(mechanism).far(); }

}  // namespace jourdain::kinematics
