// [[force]] and [[spring]]
#include <fmt/format.h>

#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Of a spring's length, and of its rate too where that is asked for.
Scope spring_scope(bool with_rate) {
  Scope scope = {{"length", {.kind = Variable::Kind::kArgument}, Measure::variable(needed::kLength)}};
  if (with_rate)
    scope.push_back(
        {"rate", {.kind = Variable::Kind::kArgument, .component = 1}, Measure::variable(needed::kSpeed)});
  return scope;
}

void read_load(TomlFile& file, const TomlTable& table, const std::string& name, const Scope& scope,
               Mechanism& mechanism) {
  const auto frame = find_frame(file, table, "frame", mechanism);
  if (!table.has("force") && !table.has("moment"))
    table.missing("force", "or a moment, or both: three expressions each");
  Load load;
  load.name = name;
  load.where = table.where("frame");
  load.axes = static_cast<LoadAxes>(table.choice("axes", {"frame", "world"}).value_or(0));
  load.force = table.functions("force", needed::kForce, scope);
  load.moment = table.functions("moment", needed::kMoment, scope);
  if (!frame) return;
  if (!mechanism.frames[frame->value].body)
    table.error("frame", fmt::format("{} acts on the world, which cannot move", table.what()));
  for (std::size_t k = 0; k < 3; ++k) {
    load.force[k] = settled(load.force[k], mechanism);
    load.moment[k] = settled(load.moment[k], mechanism);
  }
  load.frame = *frame;
  mechanism.loads.push_back(load);
}

void read_coordinate_force(TomlFile& file, const TomlTable& table, const std::string& name,
                           const Scope& scope, Mechanism& mechanism) {
  for (const char* key : {"force", "moment", "axes"})
    if (table.has(key))
      table.error(key, fmt::format("{} acts on a joint and has no '{}'", table.what(), key),
                  "write value = \"...\"");
  if (!table.has("value")) table.missing("value", "an expression, N m or N");
  const std::optional<std::string> joint_name = table.required_text("joint");
  const auto joint = find_named(file, table.where("joint"), table.what() + " names", "joint", *joint_name,
                                mechanism.joints, file.complete().structure);
  const auto coordinate = joint ? find_coordinate(table, mechanism.joints[*joint]) : std::nullopt;
  const Needed needed =
      coordinate ? coordinate_needs(mechanism.joints[*joint], *coordinate).force : needed::kAnything;
  CoordinateForce force;
  force.name = name;
  force.where = table.where("joint");
  force.force = settled(table.function("value", needed, scope), mechanism);
  if (!coordinate) return;
  force.joint = JointIndex(*joint);
  force.coordinate = *coordinate;
  mechanism.coordinate_forces.push_back(force);
}

/// The name that a table gives, or "<what><number>".
std::string name_or_number(const toml::table& table, const char* what, std::size_t number) {
  return table["name"].value_or(fmt::format("{}{}", what, number));
}

}  // namespace

void read_forces(TomlFile& file, const toml::array& section, Mechanism& mechanism) {
  const Scope scope = general_scope(mechanism);
  std::size_t number = 0;
  for (const toml::node& node : section) {
    const std::string name = name_or_number(*node.as_table(), "force", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("force '{}'", shown(name)),
                          file.range(node.source()), keys_of("force"));
    if (table.has("frame") == table.has("joint"))
      file.error(file.range(node.source()),
                 fmt::format("force '{}' needs either 'frame' or 'joint'", shown(name)));
    else if (table.has("frame"))
      read_load(file, table, name, scope, mechanism);
    else
      read_coordinate_force(file, table, name, scope, mechanism);
  }
}

void read_springs(TomlFile& file, const toml::array& section, Mechanism& mechanism) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    Spring spring;
    spring.name = name_or_number(*node.as_table(), "spring", ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("spring '{}'", shown(spring.name)),
                          file.range(node.source()), keys_of("spring"));
    const auto from = find_frame(file, table, "from", mechanism),
               to = find_frame(file, table, "to", mechanism);
    spring.where = table.where("from");
    spring.stiffness = table.number("stiffness", needed::kStiffness);
    spring.damping = table.number("damping", needed::kDamping);
    spring.free_length = table.number("free_length", needed::kLength);
    spring.law = table.function("law", needed::kForce, spring_scope(true));
    if (table.has("potential"))
      spring.potential = table.function("potential", needed::kEnergy, spring_scope(false));
    if (!from || !to) continue;
    spring.from = *from;
    spring.to = *to;
    const std::optional<BodyIndex>&a = mechanism.frames[from->value].body,
          &b = mechanism.frames[to->value].body;
    if (a == b)
      table.error("to",
                  a ? fmt::format("spring '{}' joins body '{}' with itself", shown(spring.name),
                                  shown(mechanism.bodies[a->value].name))
                    : fmt::format("spring '{}' joins the world with itself", shown(spring.name)),
                  "its ends must be on two bodies");
    mechanism.springs.push_back(spring);
  }
}

}  // namespace jourdain::model
