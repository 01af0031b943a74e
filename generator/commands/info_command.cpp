#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "commands/report_text.hpp"
#include "loops/closed_system.hpp"
#include "model/coordinates.hpp"
#include "model/loop_kinds.hpp"

namespace jourdain::commands {

namespace {

const char* type_name(model::JointType type) {
  switch (type) {
    case model::JointType::kFixed:
      return "fixed";
    case model::JointType::kRevolute:
      return "revolute";
    case model::JointType::kPrismatic:
      return "prismatic";
    case model::JointType::kScrew:
      return "screw";
    case model::JointType::kCylindrical:
      return "cylindrical";
    case model::JointType::kUniversal:
      return "universal";
    case model::JointType::kPlanar:
      return "planar";
    case model::JointType::kSpherical:
      return "spherical";
    case model::JointType::kFree:
      return "free";
    case model::JointType::kCurve:
      return "curve";
  }
  return "";
}

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
    text += fmt::format("  {:{}}{} [{}", "", 2 * level, joint.name, type_name(joint.type));
    if (!joint.coordinates.empty() && joint.type != model::JointType::kCurve)
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
    std::string type(model::loop_kind(loop.type).name);
    std::replace(type.begin(), type.end(), '_', ' ');
    text += fmt::format("  loop {} [{}]", loop.name, type);
    if (loop.type != model::LoopType::kResidual)
      text += fmt::format(": {}, {}", end(loop.from), end(loop.to));
    text += "\n";
  }
  return text;
}

/// How M ż = k̄ − q̄ is solved, with what the two pure ways would cost before any pass.
std::string algorithm_text(const Articulation& articulation) {
  if (articulation.planar)
    return fmt::format(
        "  accelerations: of links, from which those of joints follow ({} operations, before passes)\n",
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

std::string range_text(const model::Parameter& parameter) {
  if (!parameter.range) return "";
  return fmt::format(" (from {:g} to {:g})", (*parameter.range)[0], (*parameter.range)[1]);
}

int run(const ModelArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments);
  if (!loaded) return kModelWrong;
  const model::Mechanism& mechanism = loaded->mechanism;
  const CompiledModel compiled = compile(mechanism, loaded->options);
  fmt::print("{}{}{}\n{}", mechanism.name, mechanism.description.empty() ? "" : ": ", mechanism.description,
             tree_text(mechanism));
  fmt::print("{}  {} bodies, {}\n", loops_text(mechanism), mechanism.bodies.size(), freedom_text(*loaded));
  if (const loops::LoopPlan* plan = loaded->plan())
    for (const std::string& sentence : loops::sentences(mechanism, *plan))
      fmt::print("  loops: {}\n", sentence);
  for (std::size_t i = 0; i < mechanism.actuators.size(); ++i) {
    const model::Actuator& actuator = mechanism.actuators[i];
    fmt::print("  input u[{}] {} acts on {}\n", i, actuator.name,
               mechanism.joints[actuator.joint.value].coordinates[actuator.coordinate].name);
  }
  for (std::size_t i = 0; i < mechanism.inputs.size(); ++i)
    fmt::print("  input u[{}] {} {}\n", mechanism.actuators.size() + i, mechanism.inputs[i].name,
               mechanism.inputs[i].unit);
  for (const model::Parameter& parameter : mechanism.parameters)
    fmt::print("  parameter {} = {:g} {} {}{}\n", parameter.name, parameter.value, parameter.unit,
               parameter.description, range_text(parameter));
  fmt::print("{}{}{}{}", operations_table(compiled.module) + algorithm_text(compiled.articulation),
             omissions_text(compiled.omissions), passes_text(compiled.passes),
             verdict_text(compiled.verdict));
  for (const std::string& assumption : compiled.assumptions) fmt::print("  assumes: {}\n", assumption);
  if (compiled.verdict.accepted()) return kSuccess;
  print_refusal(compiled.verdict);
  return kInternal;
}

}  // namespace

void add_info(CLI::App& app, int& status) {
  auto arguments = std::make_shared<ModelArguments>();
  CLI::App* command =
      app.add_subcommand("info", "print the tree, operations and what was left out: jourdain info arm.toml");
  arguments->add_to(*command);
  command->callback([arguments, &status] { status = run(*arguments); });
}

}  // namespace jourdain::commands
