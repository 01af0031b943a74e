#include <fmt/format.h>

#include <CLI/App.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "commands/model_facts.hpp"
#include "commands/report_text.hpp"
#include "loops/plan/plan_text.hpp"
#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::commands {

namespace {

using Json = nlohmann::ordered_json;

/// "y[2]", "y[0..6]", or "prescribed" where the joint has no entry.
std::string entries_text(const model::JointEntries& entries) {
  if (entries.position_count == 0) return "prescribed";
  if (entries.position_count == 1) return fmt::format("y[{}]", entries.first_position);
  return fmt::format("y[{}..{}]", entries.first_position,
                     entries.first_position + entries.position_count - 1);
}

/// The joints as an indented tree, each with the body it carries and its coordinates.
std::string tree_text(const model::Mechanism& mechanism) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::string text = "  world\n";
  std::map<std::size_t, std::size_t> depth;  // of bodies
  for (model::JointIndex index : model::depth_first(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    const std::size_t level = joint.parent ? depth[joint.parent->value] + 1 : 1;
    depth[joint.child.value] = level;
    text += fmt::format("  {:{}}{} [{}", "", 2 * level, joint.name, model::joint_kind(joint).name);
    if (model::joint_kind(joint).takes("sequence")) text += " " + model::sequence_text(joint);
    if (model::joint_kind(joint).has_axis())
      text += fmt::format(" ({:g}, {:g}, {:g})", joint.axis[0], joint.axis[1], joint.axis[2]);
    if (joint.type != model::JointType::kFixed)
      text += fmt::format(", {}", entries_text(layout.joints[index.value]));
    text += fmt::format("] -> {}\n", mechanism.bodies[joint.child.value].name);
  }
  return text;
}

/// The joints that close loops, each with the frames that it joins.
std::string loops_text(const model::Mechanism& mechanism) {
  const auto end = [&mechanism](model::FrameIndex index) {
    const model::Frame& frame = mechanism.frames[index.value];
    return fmt::format("{} on {}", frame.name,
                       frame.body ? mechanism.bodies[frame.body->value].name : std::string("world"));
  };
  std::string text;
  for (const model::Loop& loop : mechanism.loops) {
    std::string type(model::loop_kind(loop).name);
    std::replace(type.begin(), type.end(), '_', ' ');
    text += fmt::format("  {} {} [{}]", model::loop_kind(loop).is_constraint() ? "constraint" : "loop",
                        loop.name, type);
    if (model::loop_kind(loop).has_ends()) text += fmt::format(": {}, {}", end(loop.from), end(loop.to));
    text += "\n";
  }
  return text;
}

/// How M ż = k̄ − q̄ is solved, with what the two pure ways would cost before any pass.
std::string algorithm_text(const Articulation& articulation) {
  if (articulation.planar && articulation.form != dynamics::PlanarForm::kWorkingFrames)
    return fmt::format("  accelerations: of links, by the angles between them ({} operations on their own)\n",
                       articulation.operations);
  if (articulation.planar)
    return fmt::format(
        "  accelerations: of links, from which those of joints follow ({} operations on their own)\n",
        articulation.operations);
  if (articulation.articulated == 0 || articulation.links.size() == 1) return "";
  const auto links = std::count(articulation.links.begin(), articulation.links.end(), true);
  const std::string factorised =
      articulation.factorised == 0 ? "" : fmt::format("{} by factoring M, ", articulation.factorised);
  return fmt::format(
      "  accelerations: {} of {} links as articulated bodies ({} operations; {}{} with all links "
      "articulated; "
      "before passes)\n",
      links, articulation.links.size(), articulation.operations, factorised, articulation.articulated);
}

/// What the compiler found, in tables and sentences.
std::string compiler_text(const CompiledModel& compiled) {
  std::string text = operations_table(compiled.module) + algorithm_text(compiled.articulation) +
                     omissions_text(compiled.omissions) + passes_text(compiled.passes) +
                     lanes_text(compiled.module) + verdict_text(compiled.verdict);
  for (const std::string& assumption : compiled.assumptions)
    text += fmt::format("  assumes: {}\n", assumption);
  return text;
}

std::string info_text(const LoadedMechanism& loaded, const CompiledModel& compiled) {
  const model::Mechanism& mechanism = loaded.mechanism;
  std::string text = fmt::format("{}{}{}\n{}", mechanism.name, mechanism.description.empty() ? "" : ": ",
                                 mechanism.description, tree_text(mechanism));
  text += fmt::format("{}  {} bodies, {}\n", loops_text(mechanism), mechanism.bodies.size(),
                      freedom_text(loaded));
  if (const loops::LoopPlan* plan = loaded.plan())
    for (const std::string& sentence : loops::sentences(mechanism, *plan))
      text += fmt::format("  loops: {}\n", sentence);
  return text + facts_text(model_facts(loaded, compiled)) + compiler_text(compiled);
}

/// The facts, and what the emitted NAME.json says of functions and loops.
std::string info_json(const LoadedMechanism& loaded, const CompiledModel& compiled) {
  Json info = model_facts(loaded, compiled);
  const Json manifest = Json::parse(compiled.files.back().text);
  for (const auto& [key, value] : manifest.items())
    if (!info.contains(key) && !key.starts_with("parameter_")) info[key] = value;
  if (loaded.plan()) info["closing"] = loops::sentences(loaded.mechanism, *loaded.plan());
  return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct InfoArguments {
  ModelArguments model;
  bool json = false;
};

int run(const InfoArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments.model);
  if (!loaded) return kModelWrong;
  const CompiledModel compiled = compile(loaded->mechanism, loaded->options);
  const bool accepted = compiled.verdict.accepted();
  if (!arguments.json) fmt::print("{}", info_text(*loaded, compiled));
  if (!accepted) return refuse(*loaded, compiled.verdict);
  if (arguments.json) fmt::print("{}", info_json(*loaded, compiled));
  return kSuccess;
}

}  // namespace

void add_info(CLI::App& app, int& status) {
  auto arguments = std::make_shared<InfoArguments>();
  CLI::App* command = app.add_subcommand(
      "info", "print links, joints, frames, coordinates, inputs, operations: jourdain info arm.toml");
  arguments->model.add_to(*command);
  command->add_flag("--json", arguments->json, "the same as one JSON document");
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
