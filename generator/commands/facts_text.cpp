// The facts about a model as tables.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "commands/model_facts.hpp"
#include "report/text_table.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;

std::string number_text(const Json& value) { return fmt::format("{:g}", value.get<double>()); }

/// "(0, 0, 0.333)"
std::string vector_text(const Json& values) {
  std::vector<std::string> texts;
  for (const Json& value : values) texts.push_back(number_text(value));
  return fmt::format("({})", fmt::join(texts, ", "));
}

/// Of a fact's text, vector, number or list of names; empty where it is missing.
std::string cell(const Json& fact, const char* key) {
  const auto found = fact.find(key);
  if (found == fact.end()) return "";
  if (found->is_number_integer()) return fmt::format("{}", found->get<std::size_t>());
  if (found->is_number()) return number_text(*found);
  if (found->is_string()) return found->get<std::string>();
  if (!found->empty() && found->front().is_string())
    return fmt::format("{}", fmt::join(found->get<std::vector<std::string>>(), ", "));
  return vector_text(*found);
}

std::string range_text(const Json& fact) {
  const auto found = fact.find("range");
  if (found == fact.end()) return "";
  return fmt::format("{} to {}", number_text((*found)[0]), number_text((*found)[1]));
}

std::string links_text(const Json& links) {
  report::TextTable table({"links", "parent", "joint", ">mass, kg", "centre of mass, m", "depends on"});
  for (const Json& link : links)
    table.add({cell(link, "name"), cell(link, "parent"), cell(link, "joint"), cell(link, "mass"),
               cell(link, "center_of_mass"), cell(link, "depends_on")});
  return table.text();
}

std::string frames_text(const Json& frames) {
  report::TextTable table({"frames", "on", "position, m", "roll pitch yaw, rad", "depends on"});
  for (const Json& frame : frames)
    table.add({cell(frame, "name"), cell(frame, "body"), cell(frame, "position"), cell(frame, "rpy"),
               cell(frame, "depends_on")});
  return table.text();
}

std::string joints_text(const Json& joints) {
  report::TextTable table({"joints", "type", "axis", "second axis", ">pitch", "position, m",
                           "roll pitch yaw, rad", "depends on", "prescribed"});
  for (const Json& joint : joints)
    table.add({cell(joint, "name"), cell(joint, "type"),
               cell(joint, joint.contains("sequence") ? "sequence" : "axis"), cell(joint, "second_axis"),
               cell(joint, "pitch"), cell(joint, "position"), cell(joint, "rpy"), cell(joint, "depends_on"),
               cell(joint, "prescribed")});
  return table.text();
}

/// Limits are facts for people, which the equations do not know.
std::string limits_text(const Json& joints) {
  report::TextTable table(
      {"limits (not in the equations)", ">lower", ">upper", ">velocity", ">effort", "units"});
  for (const Json& joint : joints) {
    const auto limits = joint.find("limits");
    if (limits != joint.end())
      table.add({cell(joint, "name"), cell(*limits, "lower"), cell(*limits, "upper"),
                 cell(*limits, "velocity"), cell(*limits, "effort"), cell(*limits, "units")});
  }
  return table.text();
}

/// Of y or z.
std::string entries_text(const std::string& title, const char* array, const Json& entries) {
  report::TextTable table({title, "name", "joint", "unit", ">initial", "range"});
  for (const Json& entry : entries) {
    const std::string name = cell(entry, "name"),
                      joint = entry.contains("joint") ? cell(entry, "joint") : "(state)";
    table.add({fmt::format("{}[{}]", array, cell(entry, "index")), name, joint == name ? "" : joint,
               cell(entry, "unit"), cell(entry, "initial"), range_text(entry)});
  }
  return table.text();
}

std::string inputs_text(const Json& inputs) {
  report::TextTable table({"inputs", "name", "unit", "acts on", "description"});
  for (const Json& input : inputs)
    table.add({fmt::format("u[{}]", cell(input, "index")), cell(input, "name"), cell(input, "unit"),
               cell(input, "coordinate"), cell(input, "description")});
  return table.text();
}

/// First and last of the numbers.
std::string numbers_text(const Json& numbers) {
  if (numbers.empty()) return "";
  if (numbers.size() == 1) return cell(numbers[0], "name");
  return fmt::format("{} ... {}", cell(numbers.front(), "name"), cell(numbers.back(), "name"));
}

std::string outputs_text(const Json& outputs) {
  report::TextTable table({"outputs", "kind", "of", ">numbers", "names"});
  for (const Json& output : outputs)
    table.add({cell(output, "name"), cell(output, "kind"), cell(output, "of"),
               fmt::format("{}", output["numbers"].size()), numbers_text(output["numbers"])});
  return table.text();
}

std::string parameters_text(const Json& parameters) {
  report::TextTable table({"parameters", ">value", "unit", "range", "description"});
  for (const Json& parameter : parameters)
    table.add({cell(parameter, "name"), cell(parameter, "value"), cell(parameter, "unit"),
               range_text(parameter), cell(parameter, "description")});
  return table.text();
}

}  // namespace

std::string facts_text(const Json& facts) {
  return fmt::format("  root {}; gravity {} m/s^2\n", cell(facts, "roots"), cell(facts, "gravity")) +
         links_text(facts["links"]) + frames_text(facts["frames"]) + joints_text(facts["joints"]) +
         limits_text(facts["joints"]) + entries_text("positions", "y", facts["positions"]) +
         entries_text("velocities", "z", facts["velocities"]) + inputs_text(facts["inputs"]) +
         outputs_text(facts["outputs"]) + parameters_text(facts["parameters"]);
}

}  // namespace jourdain::commands
