// [[output]]
#include <fmt/format.h>

#include "model/names.hpp"
#include "model/output_kinds.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_frame.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

using support::shown;

/// Keys that an output about such a thing needs beside its name and kind.
std::vector<std::string> keys_of_subject(OutputSubject subject) {
  switch (subject) {
    case OutputSubject::kNone:
      return {};
    case OutputSubject::kFrame:
      return {"frame"};
    case OutputSubject::kJoint:
      return {"joint"};
    case OutputSubject::kCoordinate:
      return {"joint", "coordinate"};
    case OutputSubject::kValue:
      return {"value"};
  }
  return {};
}

bool read_joint(TomlFile& file, const TomlTable& table, Output& output, const Mechanism& mechanism) {
  const std::optional<std::string> name = table.required_text("joint");
  if (!name) return false;
  const auto joint = find_named(file, table.where("joint"), table.what() + " names", "joint", *name,
                                mechanism.joints, file.complete().structure);
  if (!joint) return false;
  output.joint = JointIndex(*joint);
  if (output_kind(output.kind).subject == OutputSubject::kJoint) return true;
  const auto coordinate = find_coordinate(table, mechanism.joints[*joint]);
  if (!coordinate) return false;
  output.coordinate = *coordinate;
  const Coordinate& driven = mechanism.joints[*joint].coordinates[*coordinate];
  if (!driven.motion)
    table.error(
        "joint",
        fmt::format("coordinate '{}' has no prescribed motion that a drive could make", shown(driven.name)),
        "motion = \"...\" prescribes it");
  return true;
}

bool read_content(TomlFile& file, const TomlTable& table, Output& output, const Scope& scope,
                  Mechanism& mechanism) {
  const OutputKindRow& kind = output_kind(output.kind);
  const std::vector<std::string> keys = keys_of_subject(kind.subject);
  for (const char* key : {"frame", "joint", "coordinate", "value"})
    if (table.has(key) && std::find(keys.begin(), keys.end(), key) == keys.end())
      table.error(key, fmt::format("an output of kind '{}' has no '{}'", kind.name, key));
  if (keys.empty()) return true;
  if (keys[0] == "joint") return read_joint(file, table, output, mechanism);
  if (keys[0] == "frame") {
    const auto frame = find_frame(file, table, "frame", mechanism);
    if (frame) output.frame = *frame;
    return frame.has_value();
  }
  if (!table.has("value")) table.missing("value", "an expression");
  output.value = settled(table.function("value", needed::kAnything, scope), mechanism);
  return true;
}

}  // namespace

void read_outputs(TomlFile& file, const TomlTables& section, Mechanism& mechanism) {
  const Scope scope = general_scope(file, mechanism);
  for (const toml::node& node : section) {
    Output output;
    output.name = file.text_or(*node.as_table(), "name");
    const TomlTable table(file, *node.as_table(),
                          output.name.empty() ? "an output" : fmt::format("output '{}'", shown(output.name)),
                          file.range(node.source()), keys_of("output"));
    table.required_text("name");
    output.where = table.where("name");
    if (!table.has("kind"))
      table.missing("kind", fmt::format("one of {}", fmt::join(output_kind_names(), ", ")));
    const auto kind = table.choice("kind", output_kind_names());
    if (!kind || !table.has("kind") || output.name.empty()) continue;
    output.kind = static_cast<OutputKind>(*kind);
    check_identifier(file, output.where, "output", output.name);
    if (is_reserved(output.name))
      table.error("name",
                  fmt::format("'{}' is reserved in C++ and cannot name an output", shown(output.name)));
    const bool sound = read_content(file, table, output, scope, mechanism);
    if (sound && is_new_name(file, output.where, "outputs", output.name, mechanism.outputs))
      mechanism.outputs.push_back(output);
  }
}

}  // namespace jourdain::model
