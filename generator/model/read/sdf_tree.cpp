#include "model/read/sdf_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "model/coupler.hpp"
#include "model/joint_kinds.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Axes of gears may be this far from those of their joints.
constexpr double kParallel = 1e-4;

class Assembly {
 public:
  Assembly(SdfFile& file, const SdfGraph& graph, const ReadOptions& options, Mechanism& mechanism)
      : file_(file),
        links_(graph.links),
        joints_(graph.joints),
        frames_(graph.frames),
        options_(options),
        mechanism_(mechanism),
        carrier_(links_.size()),
        index_(joints_.size()) {}

  void run() {
    for (std::size_t b = 0; b < links_.size(); ++b)
      if (links_[b].is_static) carrier_[b] = kWorld;
    choose_carriers();
    for (std::size_t b = 0; b < links_.size(); ++b) add_body(b);
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (is_carrier(j)) add_joint(j);
    attach_roots();
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (!is_carrier(j) && !joints_[j].gearbox && !joins_static(joints_[j].joint)) add_loop(j);
    if (!mechanism_.loops.empty()) take_ranges();
    for (std::size_t j = 0; j < joints_.size(); ++j) couple(j);
    start_followers(mechanism_);
    for (const SdfNamedFrame& frame : frames_)
      mechanism_.frames.push_back(
          {frame.name, frame.body,
           placement_of(relative(body_pose(frame.body), frame.pose), file_.snap(), frame.pose_where),
           frame.where});
    report_friction();
  }

 private:
  static constexpr std::size_t kWorld = static_cast<std::size_t>(-1);

  bool is_carrier(std::size_t j) const {
    const std::optional<std::size_t>& by = carrier_[joints_[j].joint.child.value];
    return by && *by == j;
  }
  bool joins_static(const Joint& joint) const {
    return links_[joint.child.value].is_static && (!joint.parent || links_[joint.parent->value].is_static);
  }

  /// How early a joint takes its place in the tree.
  static int rank(const SdfJoint& j) {
    if (j.joint.type == JointType::kFixed || !joint_kind(j.joint).as_loop) return 0;
    const auto acts = [](const Coordinate& c) {
      return !c.stiffness.is_zero() || !c.damping.is_zero() || !c.friction.is_zero();
    };
    const bool any = std::any_of(j.joint.coordinates.begin(), j.joint.coordinates.end(), acts);
    return any || !j.mimics.empty() ? 1 : 2;
  }

  void choose_carriers() {
    for (int turn = 0; turn <= 2; ++turn)
      for (std::size_t j = 0; j < joints_.size(); ++j) {
        const Joint& joint = joints_[j].joint;
        if (joints_[j].gearbox || rank(joints_[j]) != turn || carrier_[joint.child.value]) continue;
        if (!is_beyond(joint.parent, joint.child)) carrier_[joint.child.value] = j;
      }
  }

  /// Is the body carried by `base`?
  bool is_beyond(std::optional<BodyIndex> body, BodyIndex base) const {
    while (body) {
      if (*body == base) return true;
      const std::optional<std::size_t>& by = carrier_[body->value];
      body = by && *by != kWorld ? joints_[*by].joint.parent : std::nullopt;
    }
    return false;
  }

  /// Of the body's frame in the world: that of the joint that moves it, otherwise the link's.
  SdfPose body_pose(std::size_t b) const {
    const std::optional<std::size_t>& by = carrier_[b];
    const bool moves = by && *by != kWorld && joints_[*by].joint.type != JointType::kFixed;
    return moves ? joints_[*by].pose : links_[b].pose;
  }
  SdfPose body_pose(std::optional<BodyIndex> body) const { return body ? body_pose(body->value) : SdfPose(); }

  void add_body(std::size_t b) {
    const SdfLink& link = links_[b];
    const SdfPose at_body = relative(body_pose(b), link.pose);
    Body body = link.body;
    const Placement mass = placement_of(at_body * link.inertial, file_.snap(), link.inertial_where);
    body.center_of_mass = mass.position;
    body.inertia_axes = mass.rotation;
    if (!at_body.is_identity())
      mechanism_.frames.push_back({body.name + "_link", BodyIndex(b),
                                   placement_of(at_body, file_.snap(), link.pose_where), body.where});
    mechanism_.bodies.push_back(std::move(body));
  }

  void add_joint(std::size_t j) {
    const SdfJoint& read = joints_[j];
    Joint joint = read.joint;
    joint.placement = placement_of(relative(body_pose(joint.parent), body_pose(joint.child.value)),
                                   file_.snap(), read.pose_where);
    if (!options_.friction)
      for (Coordinate& c : joint.coordinates) {
        if (!c.friction.is_zero()) rubbing_.push_back(&read);
        c.friction = 0.0;
      }
    index_[j] = JointIndex(mechanism_.joints.size());
    names_.insert(joint.name);
    if (joint.coordinates.size() == 1)
      mechanism_.actuators.push_back({.name = joint.name,
                                      .joint = *index_[j],
                                      .rotor_inertia = 0.0,
                                      .where = joint.where,
                                      .implied = true});
    mechanism_.joints.push_back(std::move(joint));
  }

  void attach_roots() {
    const auto is_root = [](const auto& by) { return !by || *by == kWorld; };
    const bool alone = std::count_if(carrier_.begin(), carrier_.end(), is_root) == 1;
    for (std::size_t b = 0; b < links_.size(); ++b) {
      if (!is_root(carrier_[b])) continue;
      const SdfLink& link = links_[b];
      const bool free = !carrier_[b] && options_.root != RootJoint::kFixed;
      Joint joint;
      joint.name = !free ? link.body.name + "_to_world" : alone ? "root" : link.body.name + "_root";
      while (names_.contains(joint.name)) joint.name += '_';
      joint.set_type(free ? JointType::kFree : JointType::kFixed);
      joint.child = BodyIndex(b);
      joint.where = link.body.where;
      if (free) {
        const Numbers3& p = link.pose.position;
        joint.initial_origin = {p[0], p[1], p[2]};
        const std::array<double, 4> q = quaternion_of(link.pose.rotation);
        for (std::size_t k = 0; k < 4; ++k) joint.initial_orientation[k] = q[k];
      } else {
        joint.placement = placement_of(link.pose, file_.snap(), link.pose_where);
      }
      mechanism_.joints.push_back(std::move(joint));
    }
  }

  FrameIndex add_frame(const std::string& name, std::optional<BodyIndex> body, const SdfJoint& read) {
    mechanism_.frames.push_back(
        {name, body, placement_of(relative(body_pose(body), read.pose), file_.snap(), read.pose_where),
         read.joint.where});
    return FrameIndex(mechanism_.frames.size() - 1);
  }

  void add_loop(std::size_t j) {
    const SdfJoint& read = joints_[j];
    const Joint& joint = read.joint;
    const bool is_fixed = joint.type == JointType::kFixed;
    const std::optional<LoopType> type = is_fixed ? LoopType::kPrismatic : joint_kind(joint).as_loop;
    if (!type)
      return file_.error(
          joint.where,
          fmt::format("joint '{}' of type {} closes a loop", shown(joint.name), joint_kind(joint).name),
          "no loop keeps what such a joint does");
    for (const Coordinate& c : joint.coordinates)
      if (!c.stiffness.is_zero() || !c.damping.is_zero() || (options_.friction && !c.friction.is_zero())) {
        file_.diagnostics().warning(
            joint.where,
            fmt::format("joint '{}' closes a loop: its spring and damper are left out", shown(joint.name)));
        break;
      }
    if (!is_fixed && !joint.coordinates.empty())
      file_.diagnostics().note(
          joint.where,
          fmt::format("joint '{}' closes a loop: it has no coordinate and no input", shown(joint.name)),
          "its links hang on other joints: fixed ones, then those with springs, dampers or followers, come "
          "first");
    Loop loop;
    loop.name = joint.name;
    loop.type = *type;
    loop.from = add_frame(joint.name + "_parent", joint.parent, read);
    loop.to = add_frame(joint.name + "_child", joint.child, read);
    loop.axis = loop.to_axis = is_fixed ? std::array<double, 3>{0, 0, 1} : joint.axis;
    if (joint.type == JointType::kUniversal) loop.to_axis = joint.second_axis;
    loop.where = joint.where;
    mechanism_.loops.push_back(loop);
    if (!is_fixed) return;
    loop.name += "_along";
    loop.type = LoopType::kPointInPlane;
    loop.continues = true;
    mechanism_.loops.push_back(loop);
  }

  /// What is proven of loops is proven within the limits of the joints that start there.
  void take_ranges() {
    for (std::size_t j = 0; j < joints_.size(); ++j)
      for (std::size_t c = 0; index_[j] && c < joints_[j].limits.size(); ++c) {
        const auto& limits = joints_[j].limits[c];
        Coordinate& coordinate = mechanism_.joints[index_[j]->value].coordinates[c];
        const double start = coordinate.initial_position.constant();
        if (limits && (*limits)[0] <= start && start <= (*limits)[1]) coordinate.range = limits;
      }
  }

  void couple(std::size_t j) {
    for (const SdfMimic& mimic : joints_[j].mimics) follow(j, mimic);
    if (joints_[j].gearbox) mesh(joints_[j]);
  }

  void follow(std::size_t j, const SdfMimic& mimic) {
    const std::string& name = joints_[j].joint.name;
    const auto found = std::find_if(joints_.begin(), joints_.end(),
                                    [&](const SdfJoint& other) { return other.joint.name == mimic.leader; });
    if (found == joints_.end()) {
      std::vector<std::string> names;
      for (const SdfJoint& other : joints_) names.push_back(other.joint.name);
      const std::string close = support::nearest(mimic.leader, names);
      return file_.error(
          mimic.where, fmt::format("joint '{}' mimics unknown joint '{}'", shown(name), shown(mimic.leader)),
          close.empty() ? "" : fmt::format("did you mean '{}'?", shown(close)));
    }
    const std::optional<JointIndex>& leader = index_[static_cast<std::size_t>(found - joints_.begin())];
    if (!index_[j] || !leader || found->joint.coordinates.size() <= mimic.leader_coordinate ||
        (&*found == &joints_[j] && mimic.coordinate == mimic.leader_coordinate))
      return file_.error(mimic.where,
                         fmt::format("joint '{}' cannot mimic '{}'", shown(name), shown(mimic.leader)),
                         !index_[j] || !leader ? "one of them closes a loop and has no coordinate"
                                               : "it needs another scalar coordinate");
    add_coupler({.coordinate = {*index_[j], mimic.coordinate},
                 .leader = {*leader, mimic.leader_coordinate},
                 .ratio = mimic.multiplier,
                 .offset = mimic.offset},
                name, mimic.where);
  }

  void add_coupler(const Follower& follower, const std::string& name, SourceRange where) {
    std::erase_if(mechanism_.actuators, [&](const Actuator& actuator) {
      return actuator.joint == follower.coordinate.joint &&
             actuator.coordinate == follower.coordinate.coordinate;
    });
    mechanism_.loops.push_back(coupler(name, follower, where));
  }

  /// The revolute joint between two links, and the sign of its angle as one from `reference` about `axis`, in the
  /// world.
  std::optional<std::pair<JointIndex, double>> turning(std::optional<BodyIndex> reference, BodyIndex link,
                                                       const Numbers3& axis) const {
    for (std::size_t j = 0; j < joints_.size(); ++j) {
      const Joint& joint = joints_[j].joint;
      const bool outward = joint.parent == reference && joint.child == link;
      const bool inward = reference && joint.parent == link && joint.child == *reference;
      if (!index_[j] || joint.type != JointType::kRevolute || (!outward && !inward)) continue;
      const Numbers3 own = product(joints_[j].pose.rotation, joint.axis);
      const double along = own[0] * axis[0] + own[1] * axis[1] + own[2] * axis[2];
      const double lengths = std::hypot(own[0], own[1], own[2]) * std::hypot(axis[0], axis[1], axis[2]);
      if (!(std::abs(along) >= (1 - kParallel * kParallel / 2) * lengths)) continue;
      return std::pair(*index_[j], (along > 0) == outward ? 1.0 : -1.0);
    }
    return {};
  }

  void mesh(const SdfJoint& read) {
    const Joint& joint = read.joint;
    const Numbers3 first = product(read.pose.rotation, joint.axis),
                   second = product(read.pose.rotation, joint.second_axis);
    const auto parent = joint.parent ? turning(read.gearbox->reference, *joint.parent, first) : std::nullopt;
    const auto child = turning(read.gearbox->reference, joint.child, second);
    if (!parent || !child)
      return file_.error(
          joint.where,
          fmt::format("no revolute joint about <{}> joins the {} of gearbox '{}' with its reference body",
                      parent ? "axis2" : "axis", parent ? "child" : "parent", shown(joint.name)));
    add_coupler({.coordinate = {child->first, 0},
                 .leader = {parent->first, 0},
                 .ratio = -read.gearbox->ratio * parent->second * child->second},
                joint.name, joint.where);
  }

  /// One warning for all joints, at the first.
  void report_friction() {
    if (rubbing_.empty()) return;
    const Joint& first = rubbing_.front()->joint;
    file_.diagnostics().warning(
        first.where,
        fmt::format("friction of joint '{}'{} is ignored", shown(first.name),
                    rubbing_.size() == 1 ? "" : fmt::format(" and of {} more", rubbing_.size() - 1)),
        "--friction takes it as Coulomb friction, smoothed over 1e-3 rad/s or m/s");
  }

  SdfFile& file_;
  const std::vector<SdfLink>& links_;
  const std::vector<SdfJoint>& joints_;
  const std::vector<SdfNamedFrame>& frames_;
  const ReadOptions& options_;
  Mechanism& mechanism_;
  std::vector<std::optional<std::size_t>> carrier_;  ///< by link: the joint that carries it, or kWorld
  std::vector<std::optional<JointIndex>> index_;     ///< by joint: in the mechanism, of those in the tree
  std::set<std::string> names_;
  std::vector<const SdfJoint*> rubbing_;
};

}  // namespace

void assemble(SdfFile& file, const SdfGraph& graph, const ReadOptions& options, Mechanism& mechanism) {
  Assembly(file, graph, options, mechanism).run();
}

}  // namespace jourdain::model
