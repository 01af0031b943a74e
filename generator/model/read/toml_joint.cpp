// [[joint]]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/expression_taylor.hpp"
#include "model/joint_kinds.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

const std::vector<std::string> kCommonKeys{"name", "type", "parent", "child", "position", "rpy"};

/// Keys that a joint of this kind has beside the common ones.
std::vector<std::string> own_keys_of(const JointKind& kind) {
  std::vector<std::string> keys;
  const std::span<const JointMotion> coordinates = kind.coordinates();
  if (coordinates.size() == 1) keys = keys_of("coordinate");
  if (coordinates.size() > 1)
    for (const JointMotion& motion : coordinates) keys.emplace_back(motion.suffix);
  keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
  return keys;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = kCommonKeys;
  for (std::size_t type = 0; type < joint_type_names().size(); ++type)
    for (const std::string& key : own_keys_of(joint_kind(static_cast<JointType>(type))))
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
  for (const std::string& key : own_keys_of(joint_kind(known))) keys.push_back(key);
  return keys;
}

/// The bodies that a joint names.
struct Ends {
  TomlFile& file;
  const TomlTable& table;
  const std::vector<Body>& bodies;
  bool bodies_complete;

  bool read(Joint& joint) const {
    const std::optional<std::string> parent = table.required_text("parent");
    const std::optional<std::string> child = table.required_text("child");
    joint.child_where = table.where("child");
    bool known = parent && child;
    if (parent && *parent != "world") known = find(*parent, "parent", joint.parent) && known;
    if (child == "world") {
      table.error("child", fmt::format("{} has the world as its child", table.what()),
                  "the world cannot move");
      return false;
    }
    std::optional<BodyIndex> body;
    if (child) known = find(*child, "child", body) && known;
    if (body) joint.child = *body;
    return known;
  }

 private:
  bool find(const std::string& name, std::string_view key, std::optional<BodyIndex>& body) const {
    const auto found =
        find_named(file, table.where(key), table.what() + " names", "body", name, bodies, bodies_complete);
    if (found) body = BodyIndex(*found);
    return found.has_value();
  }
};

class JointReader {
 public:
  JointReader(TomlFile& file, const toml::table& table, const std::string& name, SourceRange header,
              const std::vector<std::string>& known, const std::vector<std::string>& shown_keys)
      : file_(file),
        table_(file, table, name.empty() ? "a joint" : fmt::format("joint '{}'", shown(name)), header, known,
               shown_keys) {}

  /// A joint whose type or one of whose ends is unknown leaves the file's structure incomplete.
  Joint read(const Mechanism& mechanism, bool bodies_complete) {
    Joint joint;
    joint.name = table_.required_text("name").value_or("");
    joint.where = table_.where("name");
    bool sound = !joint.name.empty();
    if (sound) {
      check_identifier(file_, joint.where, "joint", joint.name);
      sound = is_new_name(file_, joint.where, "joints", joint.name, mechanism.joints);
    }
    sound = read_type(joint) && sound;
    sound = Ends{file_, table_, mechanism.bodies, bodies_complete}.read(joint) && sound;
    joint.axis_where = table_.where("axis");
    read_over(joint);
    for (const auto& [key, hint] :
         {std::pair("pitch", "m/rad"), std::pair("curve", "three expressions of s, m")})
      if (joint_kind(joint).takes(key) && !table_.has(key)) table_.missing(key, hint);
    if (!sound) file_.complete().structure = false;
    return joint;
  }

  /// Keys that are left out change nothing.
  void read_over(Joint& joint) {
    refuse_foreign_keys(joint);
    joint.placement.position = table_.vector("position", needed::kLength, joint.placement.position);
    if (table_.has("rpy")) joint.placement.rotation = table_.rotation("rpy");
    if (table_.has("axis")) joint.axis_where = table_.where("axis");
    joint.axis = table_.direction("axis", joint.axis);
    joint.second_axis = table_.direction("second_axis", joint.second_axis);
    if (joint.coordinates.size() == 1)
      read_coordinate(file_, table_, coordinate_needs(joint, 0), joint.coordinates[0]);
    if (joint.coordinates.size() > 1) read_coordinate_tables(joint);
    const JointKind& kind = joint_kind(joint);
    if (kind.takes("pitch")) joint.pitch = table_.number("pitch", needed::kPitch, joint.pitch);
    if (kind.takes("curve") && table_.has("curve")) read_curve(joint);
    if (kind.takes("sequence")) read_sequence(joint);
    if (kind.takes("damping"))
      joint.spin_damping = table_.number("damping", needed::kAngularDamping, joint.spin_damping);
    if (kind.has_quaternion()) read_turning_start(joint);
    if (kind.has_origin()) read_origin_start(joint);
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

  void read_turning_start(Joint& joint) {
    if (table_.has("initial_orientation")) {
      joint.initial_orientation = table_.quaternion("initial_orientation");
      joint.orientation_where = table_.where("initial_orientation");
    }
    joint.initial_spin = table_.vector("initial_angular_velocity", needed::kAngularRate, joint.initial_spin);
    if (table_.has("initial_angular_velocity")) joint.spin_where = table_.where("initial_angular_velocity");
  }

  void read_origin_start(Joint& joint) {
    joint.initial_origin = table_.vector("initial_position", needed::kLength, joint.initial_origin);
    joint.initial_origin_velocity =
        table_.vector("initial_velocity", needed::kSpeed, joint.initial_origin_velocity);
    if (table_.has("initial_position")) joint.origin_where = table_.where("initial_position");
    if (table_.has("initial_velocity")) joint.origin_velocity_where = table_.where("initial_velocity");
  }

  void refuse_foreign_keys(const Joint& joint) {
    const JointKind& kind = joint_kind(joint);
    const std::vector<std::string> own = own_keys_of(kind);
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
                            table_.where(suffix), keys_of("coordinate"));
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
    const std::size_t mark = file_.error_count();
    // The coordinate may be an angle, a length or neither.
    const Scope scope = {{"s", {.kind = Variable::Kind::kArgument}, Measure::open()}};
    joint.curve = table_.functions("curve", needed::kLength, scope);
    if (file_.error_count() != mark) return;
    bool is_known = true;
    for (std::size_t k = 0; k < joint.curve.size(); ++k) {
      refuse_kinks(file_, table_, "curve",
                   [&] { return table_.functions("curve", needed::kLength, scope)[k]; });
      is_known = is_known && !joint.curve[k].calls(support::Function::kCall);
    }
    if (!is_known) return;
    const double start = file_.value(joint.coordinates[0].initial_position);
    double speed = 0;
    for (const Expression& component : joint.curve) {
      const auto at = taylor_of<double>(component, file_.values(), [start](const Variable&) {
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
  TomlTable table_;
};

}  // namespace

void read_joints(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  const bool bodies_complete = file.complete().structure;
  for (const toml::node& node : section) {
    const toml::table& table = *node.as_table();
    JointReader reader(file, table, file.text_or(table, "name"), file.range(node.source()), all_keys(),
                       shown_keys(table));
    mechanism.joints.push_back(reader.read(mechanism, bodies_complete));
  }
}

void change_joint(TomlFile& file, const toml::table& table, SourceRange where, Joint& joint) {
  const auto changeable = [](std::vector<std::string> keys) {
    std::erase_if(keys,
                  [](const std::string& key) { return key == "type" || key == "parent" || key == "child"; });
    std::replace(keys.begin(), keys.end(), std::string("name"), std::string("joint"));
    return keys;
  };
  std::vector<std::string> own = kCommonKeys;
  for (const std::string& key : own_keys_of(joint_kind(joint))) own.push_back(key);
  JointReader(file, table, joint.name, where, changeable(all_keys()), changeable(own)).read_over(joint);
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

}  // namespace jourdain::model
