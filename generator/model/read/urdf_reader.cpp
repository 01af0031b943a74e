// The Unified Robot Description Format. Read are links with their inertials and joints with origin, axis and
// damping, and joints that follow others; limits, geometry, sensors and what simulators add are not. A joint that moves
// and follows none gets an actuator of the same name.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "model/matrix3.hpp"
#include "model/read/read.hpp"
#include "model/read/urdf_file.hpp"
#include "model/read/urdf_limits.hpp"
#include "model/read/urdf_mimic.hpp"
#include "model/read/urdf_schema.hpp"
#include "model/read/xml_text.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;
using support::shown;

class UrdfReader {
 public:
  UrdfReader(UrdfFile& file, const ReadOptions& options) : file_(file), options_(options) {}

  Mechanism read(const XmlElement& robot) {
    mechanism_.gravity = {0.0, 0.0, -kStandardGravity};
    mechanism_.name = file_.name(robot).value_or("");
    mechanism_.where = file_.element(robot);
    file_.check_children(robot, {"link", "joint", "material", "transmission", "gazebo", "sensor"});
    if (is_small(robot, "link") && is_small(robot, "joint")) {
      for (const auto* e = robot.FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
        read_link(*e);
      for (const auto* e = robot.FirstChildElement("joint"); e; e = e->NextSiblingElement("joint"))
        read_joint(*e);
      check_urdf(file_, robot);
    } else {
      file_.complete().structure = false;
    }
    report_friction();
    if (file_.complete().structure) read_mimics(file_, mimics_, mechanism_);
    if (file_.complete().structure) attach_roots();
    return std::move(mechanism_);
  }

 private:
  bool is_small(const XmlElement& robot, const char* name) {
    std::size_t count = 0;
    for (const auto* e = robot.FirstChildElement(name); e; e = e->NextSiblingElement(name)) ++count;
    if (count <= kMaximumBodies) return true;
    error({}, fmt::format("the file has {} <{}> elements, more than {}", count, name, kMaximumBodies));
    return false;
  }

  void error(SourceRange where, std::string message, std::string hint = "") {
    file_.diagnostics().error(where, std::move(message), std::move(hint));
  }

  /// The element's name, if no earlier element of its kind has it.
  std::optional<std::string> new_name(const XmlElement& element,
                                      std::unordered_map<std::string, SourceRange>& names) {
    std::optional<std::string> name = file_.name(element);
    const SourceRange where = file_.value(element, "name");
    if (name && names.emplace(*name, where).second) return name;
    if (name)
      error(where, fmt::format("there are two {}s '{}'", element.Name(), shown(*name)),
            fmt::format("first declared at line {}", names[*name].line));
    file_.complete().structure = false;
    return {};
  }

  void read_link(const XmlElement& element) {
    const std::optional<std::string> name = new_name(element, link_names_);
    file_.check_children(element, {"inertial", "visual", "collision"});
    Body body;
    body.name = name.value_or("");
    body.where = file_.value(element, "name");
    if (const XmlElement* inertial = file_.child(element, "inertial")) read_inertial(*inertial, body);
    if (name) mechanism_.bodies.push_back(std::move(body));
  }

  void read_inertial(const XmlElement& inertial, Body& body) {
    file_.check_children(inertial, {"origin", "mass", "inertia"});
    const Placement placement = file_.origin(inertial);
    body.center_of_mass = placement.position;
    body.inertia_axes = placement.rotation;
    if (const XmlElement* mass = required_child(inertial, "mass")) {
      body.mass = file_.required_number(*mass, "value");
      body.mass_where = file_.value(*mass, "value");
    }
    if (const XmlElement* inertia = required_child(inertial, "inertia")) {
      const auto entry = [&](const char* name) { return file_.required_number(*inertia, name); };
      body.inertia = {entry("ixx"), entry("iyy"), entry("izz"), entry("ixy"), entry("ixz"), entry("iyz")};
      body.inertia_where = file_.element(*inertia);
    }
  }

  const XmlElement* required_child(const XmlElement& parent, const char* name) {
    const XmlElement* found = file_.child(parent, name);
    if (found) return found;
    error(file_.element(parent), fmt::format("<{}> needs <{}>", parent.Name(), name));
    file_.complete().numbers = false;
    return nullptr;
  }

  void read_joint(const XmlElement& element) {
    const std::optional<std::string> name = new_name(element, joint_names_);
    file_.check_children(element, {"origin", "parent", "child", "axis", "calibration", "dynamics", "limit",
                                   "mimic", "safety_controller"});
    Joint joint;
    joint.name = name.value_or("");
    joint.where = file_.value(element, "name");
    const std::optional<JointType> type = joint_type(element, joint.name);
    joint.set_type(type.value_or(JointType::kFixed));
    joint.parent = end(element, "parent", joint);
    const std::optional<BodyIndex> child = end(element, "child", joint);
    joint.placement = file_.origin(element);
    const XmlElement* mimic = joint.type == JointType::kFixed ? nullptr : read_motion(element, joint);
    if (!name || !type || !joint.parent || !child) {
      file_.complete().structure = false;
      return;
    }
    joint.child = *child;
    if (mimic) mimics_.push_back({JointIndex(mechanism_.joints.size()), mimic});
    if (joint.coordinates.size() == 1)
      mechanism_.actuators.push_back({.name = joint.name,
                                      .joint = JointIndex(mechanism_.joints.size()),
                                      .rotor_inertia = 0.0,
                                      .where = joint.where,
                                      .implied = true});
    mechanism_.joints.push_back(std::move(joint));
  }

  std::optional<JointType> joint_type(const XmlElement& element, const std::string& name) {
    const std::optional<std::string> type = file_.required(element, "type");
    if (!type) return {};
    if (*type == "fixed") return JointType::kFixed;
    if (*type == "revolute" || *type == "continuous") return JointType::kRevolute;
    if (*type == "prismatic") return JointType::kPrismatic;
    const SourceRange where = file_.value(element, "type");
    if (*type == "planar") return JointType::kPlanar;
    if (*type == "floating") return JointType::kFree;
    const std::string close =
        support::nearest(*type, {"revolute", "continuous", "prismatic", "fixed", "planar", "floating"});
    error(where, fmt::format("joint '{}' has unknown type '{}'", shown(name), shown(*type)),
          close.empty() ? "known are revolute, continuous, prismatic, fixed, planar, floating"
                        : fmt::format("did you mean '{}'?", close));
    return {};
  }

  /// The link that <parent> or <child> names.
  std::optional<BodyIndex> end(const XmlElement& element, const char* which, Joint& joint) {
    const XmlElement* found = file_.child(element, which);
    if (!found) error(file_.element(element), fmt::format("joint '{}' needs <{}>", shown(joint.name), which));
    const std::optional<std::string> name = found ? file_.required(*found, "link") : std::nullopt;
    if (!name) return {};
    const SourceRange where = file_.value(*found, "link");
    if (std::string_view(which) == "child") joint.child_where = where;
    std::vector<std::string> names;
    for (const Body& body : mechanism_.bodies) names.push_back(body.name);
    const auto link = std::find(names.begin(), names.end(), *name);
    if (link != names.end()) return BodyIndex(static_cast<std::size_t>(link - names.begin()));
    const std::string close = support::nearest(*name, names);
    error(where, fmt::format("joint '{}' names unknown link '{}'", shown(joint.name), shown(*name)),
          close.empty()
              ? ""
              : fmt::format("did you mean '{}', declared at line {}?", close, link_names_[close].line));
    return {};
  }

  /// Returns its <mimic> where that is heeded.
  const XmlElement* read_motion(const XmlElement& element, Joint& joint) {
    const bool locked = std::find(options_.locked_joints.begin(), options_.locked_joints.end(), joint.name) !=
                        options_.locked_joints.end();
    joint.axis = {1, 0, 0};
    if (const XmlElement* axis = file_.child(element, "axis")) {
      joint.axis = file_.triple(*axis, "xyz", joint.axis);
      joint.axis_where = file_.value(*axis, "xyz");
    }
    if (const XmlElement* dynamics = file_.child(element, "dynamics")) {
      const double damping = file_.number(*dynamics, "damping", 0);
      const double friction = file_.number(*dynamics, "friction", 0);
      if (joint.type == JointType::kFree && (damping != 0 || friction != 0))
        file_.diagnostics().warning(
            file_.element(*dynamics),
            fmt::format("the <dynamics> of floating joint '{}' is ignored", shown(joint.name)));
      for (Coordinate& coordinate : joint.coordinates) {
        if (options_.damping) coordinate.damping = damping;
        if (options_.friction) coordinate.friction = friction;
      }
      if (options_.friction && friction < 0)
        error(file_.value(*dynamics, "friction"),
              fmt::format("the friction of joint '{}' is negative", shown(joint.name)));
      if (!options_.friction && friction != 0 && !locked && joint.type != JointType::kFree &&
          ++joints_with_friction_ == 1) {
        first_friction_ = joint.name;
        first_friction_where_ = file_.value(*dynamics, "friction");
      }
    }
    if (const XmlElement* limit = element.FirstChildElement("limit")) {
      for (const char* name : limits_without_number(*limit))
        file_.diagnostics().warning(
            file_.value(*limit, name),
            fmt::format("'{}' in the <limit> of joint '{}' is no number", name, shown(joint.name)),
            "it is left out");
      if (joint.coordinates.size() == 1)
        limit_range(limits_of(*limit, element.Attribute("type", "continuous") != nullptr),
                    joint.coordinates[0]);
    }
    const XmlElement* mimic = file_.child(element, "mimic");
    return options_.mimic ? mimic : nullptr;
  }

  static void limit_range(const Limits& limits, Coordinate& coordinate) {
    if (!limits.lower || !limits.upper || !(*limits.lower < *limits.upper)) return;
    coordinate.range = {*limits.lower, *limits.upper};
    coordinate.range_is_limit = true;
  }

  /// One warning for all joints, at the first.
  void report_friction() {
    if (joints_with_friction_ == 0) return;
    const std::string others =
        joints_with_friction_ == 1 ? "" : fmt::format(" and of {} more", joints_with_friction_ - 1);
    file_.diagnostics().warning(
        first_friction_where_,
        fmt::format("friction of joint '{}'{} is ignored", shown(first_friction_), others),
        "--friction takes it as Coulomb friction, smoothed over 1e-3 rad/s or m/s");
  }

  /// Joins the root link to the world. Several roots are an error; all are attached so that no check repeats
  /// it.
  void attach_roots() {
    std::vector<bool> is_child(mechanism_.bodies.size(), false);
    for (const Joint& joint : mechanism_.joints) is_child[joint.child.value] = true;
    std::optional<std::size_t> first;
    for (std::size_t b = 0; b < is_child.size(); ++b) {
      if (is_child[b]) continue;
      const Body& body = mechanism_.bodies[b];
      if (first)
        error(body.where,
              fmt::format("more than one root link: '{}' and '{}'", shown(mechanism_.bodies[*first].name),
                          shown(body.name)),
              fmt::format("'{}' at line {} is no joint's child either", shown(mechanism_.bodies[*first].name),
                          mechanism_.bodies[*first].where.line));
      else
        first = b;
      const bool free = options_.root == RootJoint::kFree;
      Joint joint;
      joint.name = free ? "root" : body.name + "_to_world";
      while (joint_names_.contains(joint.name)) joint.name += '_';
      joint.set_type(free ? JointType::kFree : JointType::kFixed);
      joint.child = BodyIndex(b);
      joint.where = body.where;
      mechanism_.joints.push_back(std::move(joint));
      free_floating_children(b);
    }
  }

  /// A floating joint on a root link that is fixed to the world is a free joint: its parent becomes the world, and it
  /// starts where it is placed.
  void free_floating_children(std::size_t root) {
    for (Joint& joint : mechanism_.joints) {
      if (joint.type != JointType::kFree || joint.parent != BodyIndex(root)) continue;
      if (options_.root == RootJoint::kFree) continue;
      joint.parent = {};
      joint.initial_origin = joint.placement.position;
      const Vector3& rpy = joint.placement.rotation.rpy;
      const std::array<double, 4> q =
          quaternion_of(rotation_from_rpy({rpy[0].constant(), rpy[1].constant(), rpy[2].constant()}));
      for (std::size_t k = 0; k < 4; ++k) joint.initial_orientation[k] = q[k];
      joint.placement = {};
    }
  }

  UrdfFile& file_;
  const ReadOptions& options_;
  Mechanism mechanism_;
  int joints_with_friction_ = 0;
  std::vector<UrdfMimic> mimics_;
  std::string first_friction_;
  SourceRange first_friction_where_;
  std::unordered_map<std::string, SourceRange> link_names_;
  std::unordered_map<std::string, SourceRange> joint_names_;
};

}  // namespace

std::optional<Part> read_urdf(Diagnostics& diagnostics, const ReadOptions& options) {
  const std::unique_ptr<XmlText> xml = parse_xml(diagnostics);
  const XmlElement* robot = xml ? root_element(*xml, "robot", "a URDF file", diagnostics) : nullptr;
  if (!robot) return {};
  UrdfFile file(diagnostics, xml->starts, xml->document);
  Mechanism mechanism = UrdfReader(file, options).read(*robot);
  return Part{std::move(mechanism), file.complete(), support::Severity::kWarning};
}

}  // namespace jourdain::model
