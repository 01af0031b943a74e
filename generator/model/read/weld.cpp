#include "model/read/weld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/joint_kinds.hpp"
#include "model/output_kinds.hpp"
#include "model/read/lock.hpp"

namespace jourdain::model {

namespace {

bool has_mass(const Body& body) {
  const Inertia& I = body.inertia;
  const std::array<const Expression*, 7> numbers{&body.mass, &I.xx, &I.yy, &I.zz, &I.xy, &I.xz, &I.yz};
  return body.shape ||
         std::any_of(numbers.begin(), numbers.end(), [](const Expression* e) { return !e->is_zero(); });
}

bool starts_at_zero(const Joint& joint) {
  const auto at_rest = [](const Coordinate& c) {
    return c.initial_position.is_zero() && c.initial_velocity.is_zero();
  };
  const auto& q = joint.initial_orientation;
  const bool upright =
      q[0].is_constant() && q[0].constant() == 1 && q[1].is_zero() && q[2].is_zero() && q[3].is_zero();
  const auto& w = joint.initial_spin;
  return std::all_of(joint.coordinates.begin(), joint.coordinates.end(), at_rest) && upright &&
         w[0].is_zero() && w[1].is_zero() && w[2].is_zero();
}

/// Of its own, apart from what other lists hang on it.
bool acts_by_itself(const Joint& joint) {
  const JointKind& kind = joint_kind(joint);
  return kind.has_origin() || kind.has(MotionKind::kCurve) || !starts_at_zero(joint) ||
         std::any_of(joint.coordinates.begin(), joint.coordinates.end(),
                     [](const Coordinate& c) { return !c.stiffness.is_zero() || c.motion.has_value(); });
}

/// Whether the description does not ask for the element and nothing is lost without it.
bool is_idle(const Actuator& actuator) { return actuator.implied && actuator.rotor_inertia.is_zero(); }
template <class Element>
bool is_idle(const Element&) {
  return false;
}

class Ends {
 public:
  explicit Ends(const Mechanism& mechanism)
      : mechanism_(mechanism), held_(mechanism.joints.size()), full_(mechanism.bodies.size()) {
    mark_bodies();
    mark_joints();
    mark_variables();
  }

  /// Joints to lock, in order of declaration.
  std::vector<JointIndex> find() {
    std::vector<bool> empty = empty_joints();
    while (hold_coupled(empty)) empty = empty_joints();
    std::vector<JointIndex> found;
    for (std::size_t j = 0; j < empty.size(); ++j)
      if (empty[j] && mechanism_.joints[j].type != JointType::kFixed) found.push_back(JointIndex(j));
    return found;
  }

 private:
  /// Those beyond which nothing asks for them to move.
  std::vector<bool> empty_joints() {
    const std::vector<JointIndex> order = depth_first(mechanism_);
    std::vector<bool> empty(mechanism_.joints.size());
    for (auto index = order.rbegin(); index != order.rend(); ++index) {
      const Joint& joint = mechanism_.joints[index->value];
      const bool fixed = joint.type == JointType::kFixed;
      empty[index->value] = !full_[joint.child.value] && (fixed || !held_[index->value]);
      if (!empty[index->value] && joint.parent) full_[joint.parent->value] = true;
    }
    return empty;
  }

  /// A joint that follows one that moves, or is followed by it, moves; false where all of these are held already.
  bool hold_coupled(const std::vector<bool>& empty) {
    bool more = false;
    for (const Loop& loop : mechanism_.loops) {
      const auto moves = [&](const Variable& v) { return !empty[v.index]; };
      if (!loop.follower || !any_variable(loop.residual, moves)) continue;
      more = more || any_variable(loop.residual, [&](const Variable& v) { return !held_[v.index]; });
      hold(loop.residual);
    }
    return more;
  }

  void mark_bodies() {
    for (std::size_t b = 0; b < full_.size(); ++b) full_[b] = has_mass(mechanism_.bodies[b]);
    for (const Frame& frame : mechanism_.frames)
      if (frame.body) full_[frame.body->value] = true;
  }

  void mark_joints() {
    for (std::size_t j = 0; j < held_.size(); ++j) held_[j] = acts_by_itself(mechanism_.joints[j]);
    for_each_force_element(mechanism_, [this](const auto& element) {
      if (element.pushed() && !is_idle(element)) hold(element.pushed()->joint);
    });
    for (const auto& coordinate : mechanism_.loop_options.independent) hold(coordinate.joint);
    for (const Output& output : mechanism_.outputs)
      if (output_kind(output.kind).is_of_joint()) hold(output.joint);
  }

  void mark_variables() {
    for_each_force_element(mechanism_, [this](auto element) {
      for (const Expression* expression : element.expressions()) hold(*expression);
    });
    for (const Output& output : mechanism_.outputs) hold(output.value);
    for (const Loop& loop : mechanism_.loops)
      if (!loop.follower) hold(loop.residual);
  }

  void hold(JointIndex joint) { held_[joint.value] = true; }
  void hold(const Expression& expression) {
    using Kind = Variable::Kind;
    for (const Expression::Node& node : expression.nodes()) {
      const bool names_joint = node.variable.kind == Kind::kPosition || node.variable.kind == Kind::kVelocity;
      if (node.op == Expression::Op::kVariable && names_joint) held_[node.variable.index] = true;
    }
  }

  const Mechanism& mechanism_;
  std::vector<bool> held_;  ///< joints
  std::vector<bool> full_;  ///< bodies that have mass, a frame, or something of that beyond them
};

}  // namespace

void weld_massless_ends(Mechanism& mechanism, support::Diagnostics& diagnostics) {
  const std::vector<JointIndex> ends = Ends(mechanism).find();
  if (ends.empty() || ends.size() == moving_joints(mechanism).size()) return;
  for (const JointIndex joint : ends) {
    mechanism.welded.push_back(mechanism.joints[joint.value].name);
    lock(mechanism, joint);
  }
  constexpr std::size_t kNamed = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(kNamed, ends.size()); ++i)
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", support::shown(mechanism.welded[i]));
  if (ends.size() > kNamed) names += fmt::format(" and {} more", ends.size() - kNamed);
  diagnostics.warning(
      mechanism.joints[ends.front().value].where,
      fmt::format("no mass is beyond {} {}: held at zero", ends.size() == 1 ? "joint" : "joints", names),
      ends.size() == 1 ? "a mass or inertia makes it move" : "a mass or inertia makes them move");
}

}  // namespace jourdain::model
