#include "model/read/toml_frame.hpp"
#include "model/read/keys.hpp"

#include <fmt/format.h>

#include "model/coordinates.hpp"
#include "model/read/frames.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Bodies in a scope stand behind the declared frames until an expression uses them.
constexpr std::size_t kBodies = 1'000'000;

void add_frame(Scope& scope, const std::string& name, std::size_t index) {
  using Kind = Variable::Kind;
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto add = [&](const char* letter, Kind kind, const Measure& measure) {
      scope.push_back({fmt::format("{}.{}{}", name, letter, kAxes[k]), {kind, index, k}, measure});
    };
    add("", Kind::kFramePosition, Measure::variable(needed::kLength));
    add("v", Kind::kFrameVelocity, Measure::variable(needed::kSpeed));
    add("w", Kind::kFrameSpin, Measure::variable(needed::kAngularRate));
    add("world_w", Kind::kFrameWorldSpin, Measure::variable(needed::kAngularRate));
    for (std::size_t axis = 0; axis < 3; ++axis)
      scope.push_back({fmt::format("{}.R_{}{}", name, kAxes[k], kAxes[axis]),
                       {Kind::kFrameDirection, index, 3 * k + axis},
                       Measure::variable(needed::kPure)});
  }
}

bool of_frame(const Variable& variable) {
  using Kind = Variable::Kind;
  return variable.kind == Kind::kFramePosition || variable.kind == Kind::kFrameVelocity ||
         variable.kind == Kind::kFrameSpin || variable.kind == Kind::kFrameWorldSpin ||
         variable.kind == Kind::kFrameDirection;
}

}  // namespace

std::optional<FrameIndex> find_frame(TomlFile& file, const TomlTable& table, std::string_view key,
                                     Mechanism& mechanism) {
  const std::optional<std::string> name = table.required_text(key);
  return name ? find_frame(file, table.where(key), table.what(), *name, mechanism) : std::nullopt;
}

std::optional<FrameIndex> find_frame(TomlFile& file, SourceRange where, const std::string& who,
                                     const std::string& name, Mechanism& mechanism) {
  if (const std::optional<FrameIndex> frame = frame_named(mechanism, name)) return frame;
  std::vector<std::string> names;
  for (const Frame& frame : mechanism.frames) names.push_back(frame.name);
  for (const Body& body : mechanism.bodies) names.push_back(body.name);
  const std::string close = support::nearest(name, names);
  if (close.empty() && !file.complete().structure) return {};
  file.error(where, fmt::format("{} names unknown frame or body '{}'", who, shown(name)),
             close.empty() ? "declare a [[frame]]" : fmt::format("did you mean '{}'?", close));
  return {};
}

std::optional<std::pair<FrameIndex, FrameIndex>> find_ends(TomlFile& file, const TomlTable& table,
                                                           Mechanism& mechanism) {
  const auto from = find_frame(file, table, "from", mechanism), to = find_frame(file, table, "to", mechanism);
  if (!from || !to) return {};
  const std::optional<BodyIndex>&a = mechanism.frames[from->value].body,
        &b = mechanism.frames[to->value].body;
  if (a == b)
    table.error(
        "to",
        fmt::format("{} joins {} with itself", table.what(),
                    a ? fmt::format("body '{}'", shown(mechanism.bodies[a->value].name)) : "the world"),
        "its ends must be on two bodies");
  return std::pair(*from, *to);
}

Scope general_scope(const TomlFile& file, const Mechanism& mechanism) {
  using Kind = Variable::Kind;
  Scope scope = time_scope();
  // An actuator is called like its coordinate unless it has a name of its own: the coordinate comes first and wins.
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c) {
      const std::string& name = mechanism.joints[j].coordinates[c].name;
      const CoordinateNeeds needs = coordinate_needs(mechanism.joints[j], c);
      scope.push_back({name, {Kind::kPosition, j, c}, Measure::variable(needs.position)});
      scope.push_back({name + ".rate", {Kind::kVelocity, j, c}, Measure::variable(needs.rate)});
    }
  std::size_t input = 0;
  for (const Actuator& actuator : mechanism.actuators)
    scope.push_back(
        {actuator.name, {Kind::kInput, input++, 0}, Measure::variable(input_needs(mechanism, actuator))});
  for (const Input& own : mechanism.inputs)
    scope.push_back({own.name, {Kind::kInput, input++, 0}, Measure::variable(input_needs(own))});
  for (std::size_t i = 0; i < mechanism.states.size(); ++i)
    scope.push_back(
        {mechanism.states[i].name, {Kind::kState, i}, Measure::variable({{mechanism.states[i].unit}})});
  for (std::size_t i = 0; i < mechanism.frames.size(); ++i) add_frame(scope, mechanism.frames[i].name, i);
  for (std::size_t i = 0; i < mechanism.bodies.size(); ++i)
    add_frame(scope, mechanism.bodies[i].name, kBodies + i);
  for (const Signal& signal : file.signals())
    scope.push_back({signal.name, {}, Measure::variable({{signal.unit}}), {}, signal.value});
  return scope;
}

Scope general_scope_but(const TomlFile& file, const Mechanism& mechanism,
                        std::string_view (*refusal)(const Variable&), std::string_view of_signals) {
  Scope scope = general_scope(file, mechanism);
  for (ScopeEntry& entry : scope) {
    if (!entry.meaning)
      entry.refusal = refusal(entry.variable);
    else if (any_variable(*entry.meaning, [refusal](const Variable& v) { return !refusal(v).empty(); }))
      entry.refusal = of_signals;
  }
  return scope;
}

Needed input_needs(const Mechanism& mechanism, const Actuator& actuator) {
  const bool direct = actuator.gear_ratio.is_constant() && actuator.gear_ratio.constant() == 1;
  const Joint& joint = mechanism.joints[actuator.joint.value];
  return direct && actuator.coordinate < joint.coordinates.size()
             ? coordinate_needs(joint, actuator.coordinate).force
             : needed::kAnything;
}

Needed input_needs(const Input& input) { return {{input.unit}}; }

Vector3 frame_components(Variable::Kind kind, FrameIndex frame) {
  Vector3 vector;
  for (std::size_t k = 0; k < 3; ++k) vector[k] = Expression::variable({kind, frame.value, k});
  return vector;
}

Expression settled(const Expression& expression, Mechanism& mechanism) {
  return expression.substituted([&](const Variable& variable) {
    Variable result = variable;
    if (of_frame(variable) && variable.index >= kBodies)
      result.index = frame_of(mechanism, BodyIndex(variable.index - kBodies)).value;
    return Expression::variable(result);
  });
}

void read_frames(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  const std::vector<Body>& bodies = mechanism.bodies;
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "a frame", file.range(node.source()), keys_of("frame"));
    const std::optional<std::string> name = table.required_text("name"), body = table.required_text("body");
    if (!name || !body) continue;
    Frame frame;
    frame.name = *name;
    frame.where = table.where("name");
    frame.placement = {table.vector("position", needed::kLength), table.rotation("rpy")};
    check_identifier(file, frame.where, "frame", frame.name);
    const bool taken = frame.name == "world" || std::any_of(bodies.begin(), bodies.end(), [&](const Body& b) {
                         return b.name == frame.name;
                       });
    if (taken)
      table.error("name", fmt::format("frame '{}' has the name of a body", shown(frame.name)),
                  "a body's name stands for the frame at its origin");
    if (*body != "world") {
      const auto found = find_named(file, table.where("body"), "a frame names", "body", *body, bodies,
                                    file.complete().structure);
      if (!found) continue;
      frame.body = BodyIndex(*found);
    }
    if (is_new_name(file, frame.where, "frames", frame.name, mechanism.frames))
      mechanism.frames.push_back(frame);
  }
}

namespace {

/// Where a coordinate of that name is declared.
std::optional<SourceRange> coordinate_named(const Mechanism& mechanism, const std::string& name) {
  for (const Joint& joint : mechanism.joints)
    for (const Coordinate& coordinate : joint.coordinates)
      if (coordinate.name == name) return joint.where;
  return {};
}

}  // namespace

void read_inputs(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  for (const toml::node& node : section) {
    const TomlTable table(file, *node.as_table(), "an input", file.range(node.source()), keys_of("input"));
    Input input;
    input.name = table.required_text("name").value_or("");
    input.where = table.where("name");
    if (const std::optional<Unit> unit = table.unit("unit"); table.has("unit") && unit) {
      if (unit->factor != 1)
        table.error("unit", fmt::format("the emitted code takes input '{}' in SI units", shown(input.name)),
                    fmt::format("'{}', with the conversion in the expressions that use it", unit->si));
      input.unit = *table.text("unit");
    }
    input.description = table.text("description").value_or("");
    if (input.name.empty()) continue;
    check_identifier(file, input.where, "input", input.name);
    if (const auto joint = coordinate_named(mechanism, input.name))
      table.error("name", fmt::format("input '{}' has the name of a coordinate", shown(input.name)),
                  "declared at " + file.line_in_words(*joint));
    if (is_new_name(file, input.where, "actuators and inputs", input.name, mechanism.actuators) &&
        is_new_name(file, input.where, "inputs", input.name, mechanism.inputs))
      mechanism.inputs.push_back(input);
  }
}

}  // namespace jourdain::model
