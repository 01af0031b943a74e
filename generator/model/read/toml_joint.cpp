// [[joint]] and [[actuator]]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/joint_kinds.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"
#include "model/taylor.hpp"

namespace jourdain::model {

namespace {

using support::shown;

const std::vector<std::string> kCommonKeys{"name", "type", "parent", "child", "position", "rpy"};

/// Keys that a joint of this kind has beside the common ones.
std::vector<std::string> keys_of(const JointKind& kind) {
  std::vector<std::string> keys;
  const std::span<const JointMotion> coordinates = kind.coordinates();
  if (coordinates.size() == 1) keys = model::keys_of("coordinate");
  if (coordinates.size() > 1)
    for (const JointMotion& motion : coordinates) keys.emplace_back(motion.suffix);
  keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
  return keys;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = kCommonKeys;
  for (std::size_t type = 0; type < joint_type_names().size(); ++type)
    for (const std::string& key : keys_of(joint_kind(static_cast<JointType>(type))))
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
  return keys;
}

/// Those of a joint whose type can be read, or of a revolute one.
std::vector<std::string> shown_keys(const toml::table& table) {
  const std::vector<std::string>& types = joint_type_names();
  const auto type = std::find(types.begin(), types.end(), table["type"].value_or(std::string()));
  const auto known =
      type == types.end() ? JointType::kRevolute : static_cast<JointType>(type - types.begin());
  std::vector<std::string> keys = kCommonKeys;
  for (const std::string& key : keys_of(joint_kind(known))) keys.push_back(key);
  return keys;
}

class JointReader {
 public:
  JointReader(TomlFile& file, const toml::table& table, const std::string& name, SourceRange header,
              const std::vector<Body>& bodies, bool bodies_complete)
      : file_(file),
        bodies_(bodies),
        bodies_complete_(bodies_complete),
        table_(file, table, name.empty() ? "a joint" : fmt::format("joint '{}'", shown(name)), header,
               all_keys(), shown_keys(table)) {}

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
    joint.placement = {table_.vector("position", needed::kLength), table_.rotation("rpy")};
    read_motion(joint);
    if (!sound) file_.complete().structure = false;
    return joint;
  }

 private:
  bool read_type(Joint& joint) {
    if (!table_.has("type"))
      table_.missing("type", fmt::format("one of {}", fmt::join(joint_type_names(), ", ")));
    const auto type = table_.choice("type", joint_type_names());
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
    refuse_foreign_keys(joint);
    joint.axis = table_.direction("axis", joint.axis);
    joint.axis_where = table_.where("axis");
    joint.second_axis = table_.direction("second_axis", joint.second_axis);
    if (joint.coordinates.size() == 1)
      read_coordinate(file_, table_, coordinate_needs(joint, 0), joint.coordinates[0]);
    if (joint.coordinates.size() > 1) read_coordinate_tables(joint);
    const JointKind& kind = joint_kind(joint);
    if (kind.takes("pitch")) {
      if (!table_.has("pitch")) table_.missing("pitch", "m/rad");
      joint.pitch = table_.number("pitch", needed::kPitch);
    }
    if (kind.takes("curve")) read_curve(joint);
    if (kind.takes("sequence")) read_sequence(joint);
    if (kind.takes("damping")) joint.spin_damping = table_.number("damping", needed::kAngularDamping);
    if (!kind.has_quaternion()) return;
    joint.initial_orientation = table_.quaternion("initial_orientation");
    joint.initial_spin = table_.vector("initial_angular_velocity", needed::kAngularRate);
    joint.orientation_where = table_.where_given("initial_orientation");
    joint.spin_where = table_.where_given("initial_angular_velocity");
    if (!kind.has_origin()) return;
    joint.initial_origin = table_.vector("initial_position", needed::kLength);
    joint.initial_origin_velocity = table_.vector("initial_velocity", needed::kSpeed);
    joint.origin_where = table_.where_given("initial_position");
    joint.origin_velocity_where = table_.where_given("initial_velocity");
  }

  void refuse_foreign_keys(const Joint& joint) {
    const JointKind& kind = joint_kind(joint);
    const std::vector<std::string> own = keys_of(kind);
    for (const std::string& key : all_keys()) {
      const bool common = std::find(kCommonKeys.begin(), kCommonKeys.end(), key) != kCommonKeys.end();
      if (common || !table_.has(key) || std::find(own.begin(), own.end(), key) != own.end()) continue;
      table_.error(
          key, fmt::format("{} is {} and has no '{}'", table_.what(), kind.name, key),
          key == "motion" && kind.has_quaternion() ? "only scalar coordinates can be prescribed" : "");
    }
  }

  void read_coordinate_tables(Joint& joint) {
    const std::span<const JointMotion> motions = joint_kind(joint).coordinates();
    for (std::size_t c = 0; c < motions.size(); ++c) {
      const std::string_view suffix = motions[c].suffix;
      const toml::table* section = table_.table(suffix);
      if (!section) continue;
      const TomlTable table(file_, *section, fmt::format("'{}' of {}", suffix, table_.what()),
                            table_.where(suffix), model::keys_of("coordinate"));
      read_coordinate(file_, table, coordinate_needs(joint, c), joint.coordinates[c]);
    }
  }

  /// Two turns in a row about one axis would be one.
  void read_sequence(Joint& joint) {
    const std::optional<std::string> text = table_.text("sequence");
    if (!text) return;
    const bool letters = text->size() == 3 && text->find_first_not_of("xyz") == std::string::npos;
    if (!letters)
      return table_.error("sequence", fmt::format("{} is not three of x, y, z", table_.quoted("sequence")),
                          "such as \"xyz\" or \"zxz\": the axes of three turns, one after the other");
    if ((*text)[0] == (*text)[1] || (*text)[1] == (*text)[2])
      return table_.error("sequence",
                          fmt::format("{} turns about one axis twice in a row", table_.quoted("sequence")),
                          "neighbours must differ");
    for (std::size_t k = 0; k < 3; ++k) joint.sequence[k] = static_cast<std::size_t>((*text)[k] - 'x');
  }

  /// The curve must move with its coordinate where it starts.
  void read_curve(Joint& joint) {
    if (!table_.has("curve")) table_.missing("curve", "three expressions of s, m");
    const std::size_t mark = file_.error_count();
    // The coordinate may be an angle, a length or neither.
    const Scope scope = {{"s", {.kind = Variable::Kind::kArgument}, Measure::open()}};
    joint.curve = table_.functions("curve", needed::kLength, scope);
    if (file_.error_count() != mark || !table_.has("curve")) return;
    std::vector<Taylor<double>> parameters;
    for (const double value : file_.values()) parameters.push_back({value, 0, 0});
    const double start = file_.value(joint.coordinates[0].initial_position);
    double speed = 0;
    for (const Expression& component : joint.curve) {
      const auto at = component.evaluate<Taylor<double>>(
          parameters,
          [](double v) {
            return Taylor<double>{v, 0, 0};
          },
          [start](const Variable&) {
            return Taylor<double>{start, 1, 0};
          });
      speed = std::hypot(speed, at.first);
    }
    if (!(speed > 0) || !std::isfinite(speed))
      table_.error("curve",
                   fmt::format("{} does not move with s at s = {:.6g}", table_.quoted("curve"), start),
                   "a coordinate must change the position where it starts");
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

std::optional<std::size_t> find_coordinate(const TomlTable& table, const Joint& joint) {
  const std::span<const JointMotion> motions = joint_kind(joint).coordinates();
  if (motions.empty()) {
    const std::string reason =
        joint.type == JointType::kFixed ? "is fixed and takes no force" : "has no scalar coordinate";
    table.error("joint", fmt::format("joint '{}' {}", shown(joint.name), reason),
                joint.type == JointType::kFixed ? "" : "a load on a frame of its child takes its place");
    return {};
  }
  if (motions.size() == 1) {
    if (table.has("coordinate"))
      table.error("coordinate", fmt::format("joint '{}' has one coordinate only", shown(joint.name)));
    return 0;
  }
  std::vector<std::string> names;
  for (const JointMotion& motion : motions) names.emplace_back(motion.suffix);
  if (table.has("coordinate")) return table.choice("coordinate", names);
  table.missing("coordinate", fmt::format("one of {}", fmt::join(names, ", ")));
  return {};
}

std::vector<Actuator> read_actuators(TomlFile& file, const toml::array& section,
                                     const std::vector<Joint>& joints) {
  std::vector<Actuator> actuators;
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "an actuator", file.range(node.source()),
                          model::keys_of("actuator"));
    const std::optional<std::string> joint_name = table.required_text("joint");
    if (!joint_name) continue;
    const auto joint =
        find_named(file, table.where("joint"), "an actuator names", "joint", *joint_name, joints, true);
    if (!joint) continue;
    const auto coordinate = find_coordinate(table, joints[*joint]);
    Actuator actuator;
    actuator.joint = JointIndex(*joint);
    actuator.coordinate = coordinate.value_or(0);
    actuator.name = coordinate ? joints[*joint].coordinates[*coordinate].name : *joint_name;
    if (const auto name = table.text("name")) actuator.name = *name;
    actuator.gear_ratio = table.number("gear_ratio", needed::kGearRatio, 1.0);
    actuator.rotor_inertia = table.number("rotor_inertia", needed::kRotorInertia);
    actuator.where = table.where(table.has("name") ? "name" : "joint");
    if (table.has("rotor_inertia") && file.value(actuator.rotor_inertia) < 0)
      table.error("rotor_inertia", fmt::format("{} is negative", table.quoted("rotor_inertia")));
    if (coordinate && joints[*joint].coordinates[*coordinate].motion)
      table.error("joint",
                  fmt::format("coordinate '{}' is prescribed and actuated at once",
                              shown(joints[*joint].coordinates[*coordinate].name)),
                  "an output of kind \"drive\" tells the force that the motion needs");
    if (table.has("name")) check_identifier(file, actuator.where, "actuator", actuator.name);
    if (is_new_name(file, actuator.where, "actuators", actuator.name, actuators))
      actuators.push_back(actuator);
  }
  return actuators;
}

}  // namespace jourdain::model
