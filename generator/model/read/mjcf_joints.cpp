// Joints of MJCF bodies, and what acts along their coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/read/mjcf_bodies.hpp"

namespace jourdain::model {

using support::shown;

JointType MjcfBodyReader::joint_type(const XmlElement& e) {
  if (is_free(e)) return JointType::kFree;
  const std::string type = file_.choice(e, "type", {"hinge", "slide", "ball", "free"}, "hinge");
  if (type == "slide") return JointType::kPrismatic;
  if (type == "ball") return JointType::kSpherical;
  return type == "free" ? JointType::kFree : JointType::kRevolute;
}

void MjcfBodyReader::read_joint(const PlacedElement& placed, Chain& chain, bool alone,
                                std::optional<BodyIndex> last, const std::string& body_name) {
  const XmlElement& e = *placed.element;
  if (!last && !has_room(e)) return;
  Joint joint;
  joint.name = given_name(e, body_name, joint_names_);
  joint.where = e.Attribute("name") ? file_.xml().value(e, "name") : file_.xml().element(e);
  joint.set_type(joint_type(e));
  MjcfBodies::NamedJoint named;
  named.joint = JointIndex(result_.mechanism.joints.size());
  named.type = joint.type;
  Numbers3 anchor{};
  if (joint.type == JointType::kFree) {
    read_free(e, chain, alone, joint);
  } else {
    const bool turns = joint.type != JointType::kPrismatic;
    if (turns) anchor = point_at(placed.frame, file_.triple(e, "pos", {}));
    Pose pose{point_at(chain.pose, anchor), chain.pose.R};
    if (joint.coordinates.size() == 1) {
      joint.axis = product(placed.frame.R, file_.triple(e, "axis", {0, 0, 1}));
      read_motion(e, joint, named);
      step_back(pose, joint, named.reference);
    }
    joint.placement = placement_of(pose, joint.where);
  }
  if (joint.coordinates.empty()) not_of_scalars(e, joint);
  if (!last) last = add_carried_body(body_name, joint);
  result_.joints[joint.name] = named;
  result_.joint_order.push_back(joint.name);
  join(chain.parent, *last, std::move(joint));
  chain.parent = last;
  chain.pose = {times(anchor, -1), kIdentity3};
}

/// A free joint starts where the body is drawn.
void MjcfBodyReader::read_free(const XmlElement& e, const Chain& chain, bool alone, Joint& joint) {
  if (!alone || chain.parent) {
    file_.xml().complete().structure = false;
    file_.error(file_.xml().element(e),
                fmt::format("free joint '{}' {}", shown(joint.name),
                            alone ? "is of a body within another" : "is not its body's only joint"));
  }
  if (is_free(e) && file_.choice(e, "align", {"true", "false", "auto"}, "auto") == "true")
    file_.warning(
        file_.xml().value(e, "align"),
        fmt::format("align of joint '{}' is ignored: its coordinates are those of the body as drawn",
                    shown(joint.name)));
  joint.initial_origin = placement_of(chain.world, joint.where).position;
  const std::array<double, 4> q = quaternion_of(chain.world.R);
  joint.initial_orientation = {q[0], q[1], q[2], q[3]};
}

/// The joint's frame is where the coordinate is zero: back by the reference from where the joint is drawn.
void MjcfBodyReader::step_back(Pose& pose, const Joint& joint, double reference) {
  const Numbers3 axis = joint.axis;
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  if (!(length > 0) || reference == 0) return;
  if (joint.type == JointType::kPrismatic)
    pose.origin = sum(pose.origin, product(pose.R, times(axis, -reference / length)));
  else
    pose.R = product(pose.R, rotation_about(axis, -reference).value_or(kIdentity3));
}

/// Without mass, between two joints of one body or at the anchor of its last one.
BodyIndex MjcfBodyReader::add_carried_body(const std::string& body_name, const Joint& joint) {
  Body carried;
  carried.name = new_name(fmt::format("{}_{}", body_name, joint.name), body_names_);
  carried.where = joint.where;
  body_names_[carried.name] = joint.where;
  return add_body(std::move(carried));
}

/// Of a hinge or slide: its axis, reference, spring, damper, range and armature.
void MjcfBodyReader::read_motion(const XmlElement& e, Joint& joint, MjcfBodies::NamedJoint& named) {
  UrdfFile& xml = file_.xml();
  const XmlElement* axis = file_.holder(e, "axis");
  joint.axis_where = axis ? xml.value(*axis, "axis") : joint.where;
  Coordinate& coordinate = joint.coordinates.front();
  const double unit = coordinate.angular ? file_.angle_unit() : 1;
  named.reference = file_.number(e, "ref", 0) * unit;
  coordinate.initial_position = named.reference;
  coordinate.stiffness = file_.number(e, "stiffness", 0);
  if (!coordinate.stiffness.is_zero()) coordinate.rest = file_.number(e, "springref", 0) * unit;
  if (options_.damping) coordinate.damping = file_.number(e, "damping", 0);
  named.armature = file_.number(e, "armature", 0);
  if (const XmlElement* holder = file_.holder(e, "armature")) named.where = xml.value(*holder, "armature");
  if (named.armature < 0)
    file_.error(named.where, fmt::format("armature of joint '{}' is negative", shown(joint.name)));
  if (const XmlElement* holder = file_.holder(e, "springdamper")) {
    const std::vector<double> pair = file_.numbers(e, "springdamper", {0, 0}, 2);
    if (pair[0] > 0 && pair[1] > 0)
      file_.warning(xml.value(*holder, "springdamper"),
                    fmt::format("springdamper of joint '{}' is ignored", shown(joint.name)),
                    "write the stiffness and damping that MuJoCo makes of it");
  }
  if (options_.friction)
    coordinate.friction = file_.number(e, "frictionloss", 0);
  else if (file_.number(e, "frictionloss", 0) != 0)
    friction_.add(xml.value(*file_.holder(e, "frictionloss"), "frictionloss"), joint.name);
  if (file_.holder(e, "actuatorfrcrange"))
    force_limits_.add(xml.value(*file_.holder(e, "actuatorfrcrange"), "actuatorfrcrange"), joint.name);
  if (file_.truth(e, "actuatorgravcomp", false))
    file_.warning(xml.element(e),
                  fmt::format("actuatorgravcomp of joint '{}' is ignored", shown(joint.name)));
  read_range(e, unit, coordinate);
}

void MjcfBodyReader::read_range(const XmlElement& e, double unit, Coordinate& coordinate) {
  const std::string limited = file_.choice(e, "limited", {"false", "true", "auto"}, "auto");
  const XmlElement* holder = file_.holder(e, "range");
  if (!holder) return;
  const XmlElement* compiler = file_.compiler("autolimits");
  const bool automatic = compiler == nullptr || file_.truth(*compiler, "autolimits", true);
  const SourceRange where = file_.xml().value(*holder, "range");
  if (limited == "auto" && !automatic)
    file_.warning(where, "'range' is ignored: 'limited' is not given and autolimits is false");
  if (limited == "false" || (limited == "auto" && !automatic)) return;
  const std::vector<double> range = file_.numbers(e, "range", {0, 0}, 2);
  if (range[0] < range[1])
    coordinate.range = {range[0] * unit, range[1] * unit};
  else if (range[0] != 0 || range[1] != 0)
    file_.error(where, fmt::format("'range' is empty: {} is not below {}", range[0], range[1]));
}

/// Of ball and free joints: what turns freely has a damper at most.
void MjcfBodyReader::not_of_scalars(const XmlElement& e, Joint& joint) {
  if (is_free(e)) return;
  const bool ball = joint.type == JointType::kSpherical;
  if (ball && options_.damping) joint.spin_damping = file_.number(e, "damping", 0);
  for (const char* attribute : {"stiffness", "armature", "frictionloss", "damping"}) {
    const bool damps = std::string_view(attribute) == "damping";
    if ((damps && (ball || !options_.damping)) || file_.number(e, attribute, 0) == 0) continue;
    file_.warning(
        file_.xml().value(*file_.holder(e, attribute), attribute),
        fmt::format("{} of {} joint '{}' is ignored", attribute, ball ? "ball" : "free", shown(joint.name)),
        ball ? "" : "<freejoint/> has none");
  }
}

}  // namespace jourdain::model
