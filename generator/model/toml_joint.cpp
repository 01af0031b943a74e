// [[joint]] and [[actuator]]
#include <fmt/format.h>

#include <array>

#include "model/toml_names.hpp"
#include "model/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

constexpr std::array kMotionKeys{"axis",    "stiffness",        "rest",
                                 "damping", "initial_position", "initial_velocity"};

class JointReader {
 public:
  JointReader(TomlFile& file, const toml::table& table, const std::string& name, SourceRange header,
              const std::vector<Body>& bodies, bool bodies_complete)
      : file_(file),
        bodies_(bodies),
        bodies_complete_(bodies_complete),
        table_(file, table, name.empty() ? "a joint" : fmt::format("joint '{}'", shown(name)), header,
               {"name", "type", "parent", "child", "position", "rpy", "axis", "stiffness", "rest", "damping",
                "initial_position", "initial_velocity"}) {}

  /// A joint whose type or one of whose ends is unknown leaves the file's structure incomplete.
  Joint read(const std::vector<Joint>& earlier) {
    Joint joint;
    joint.name = table_.required_text("name").value_or("");
    joint.where = table_.where("name");
    bool sound = !joint.name.empty();
    if (sound) {
      check_identifier(file_, joint.where, "joint", joint.name);
      sound = is_new_name(file_, joint.where, "joints", joint.name, earlier);
    }
    sound = read_type(joint) && sound;
    sound = read_ends(joint) && sound;
    joint.placement = {table_.vector("position"), table_.rotation("rpy")};
    read_motion(joint);
    if (!sound) file_.complete().structure = false;
    return joint;
  }

 private:
  bool read_type(Joint& joint) {
    if (!table_.has("type")) table_.missing("type", "revolute, prismatic or fixed");
    const auto type = table_.choice("type", {"fixed", "revolute", "prismatic"});
    if (!type || !table_.has("type")) {
      joint.set_type(JointType::kRevolute);
      return false;
    }
    joint.set_type(static_cast<JointType>(*type));
    return true;
  }

  bool read_ends(Joint& joint) {
    const std::optional<std::string> parent = table_.required_text("parent");
    const std::optional<std::string> child = table_.required_text("child");
    joint.child_where = table_.where("child");
    bool known = parent && child;
    if (parent && *parent != "world") known = find(*parent, "parent", joint.parent) && known;
    if (child == "world") {
      table_.error("child", fmt::format("{} has the world as its child", table_.what()),
                   "the world cannot move");
      return false;
    }
    std::optional<BodyIndex> body;
    if (child) known = find(*child, "child", body) && known;
    if (body) joint.child = *body;
    return known;
  }

  bool find(const std::string& name, std::string_view key, std::optional<BodyIndex>& body) {
    const auto found = find_named(file_, table_.where(key), table_.what() + " names", "body", name, bodies_,
                                  bodies_complete_);
    if (found) body = BodyIndex(*found);
    return found.has_value();
  }

  void read_motion(Joint& joint) {
    joint.axis = table_.constant_vector("axis", joint.axis);
    joint.axis_where = table_.where("axis");
    for (Coordinate& coordinate : joint.coordinates) {
      coordinate.stiffness = table_.number("stiffness");
      coordinate.rest = table_.number("rest");
      coordinate.damping = table_.number("damping");
      coordinate.initial_position = table_.number("initial_position");
      coordinate.initial_velocity = table_.number("initial_velocity");
    }
    if (joint.type != JointType::kFixed) return;
    for (const char* key : kMotionKeys)
      if (table_.has(key)) table_.error(key, fmt::format("{} is fixed and has no '{}'", table_.what(), key));
  }

  TomlFile& file_;
  const std::vector<Body>& bodies_;
  bool bodies_complete_;
  TomlTable table_;
};

}  // namespace

std::vector<Joint> read_joints(TomlFile& file, const toml::array& section, const std::vector<Body>& bodies) {
  const bool bodies_complete = file.complete().structure;
  std::vector<Joint> joints;
  for (const toml::node& node : section) {
    const toml::table& table = *node.as_table();
    const std::string name = table["name"].value_or(std::string());
    JointReader reader(file, table, name, file.range(node.source()), bodies, bodies_complete);
    joints.push_back(reader.read(joints));
  }
  return joints;
}

std::vector<Actuator> read_actuators(TomlFile& file, const toml::array& section,
                                     const std::vector<Joint>& joints) {
  std::vector<Actuator> actuators;
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "an actuator", file.range(node.source()),
                          {"name", "joint"});
    const std::optional<std::string> joint_name = table.required_text("joint");
    if (!joint_name) continue;
    const auto joint =
        find_named(file, table.where("joint"), "an actuator names", "joint", *joint_name, joints, true);
    if (!joint) continue;
    if (joints[*joint].type == JointType::kFixed)
      table.error("joint", fmt::format("joint '{}' is fixed and takes no force", shown(*joint_name)));
    Actuator actuator{.name = table.text("name").value_or(*joint_name),
                      .joint = JointIndex(*joint),
                      .rotor_inertia = 0.0,
                      .where = table.where("joint")};
    if (table.has("name")) actuator.where = table.where("name");
    if (table.has("name")) check_identifier(file, actuator.where, "actuator", actuator.name);
    if (is_new_name(file, actuator.where, "actuators", actuator.name, actuators))
      actuators.push_back(actuator);
  }
  return actuators;
}

}  // namespace jourdain::model
