#include <fmt/format.h>

#include <map>
#include <memory>

#include "commands/commands.hpp"
#include "commands/load.hpp"
#include "commands/report_text.hpp"

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

/// The joints as an indented tree, each with the body it carries and its coordinate.
std::string tree_text(const model::Mechanism& mechanism) {
  std::string text = "  world\n";
  std::map<std::size_t, std::size_t> depth;  // of bodies
  std::size_t coordinate = 0;
  for (model::JointIndex index : model::depth_first(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    const std::size_t level = joint.parent ? depth[joint.parent->value] + 1 : 1;
    depth[joint.child.value] = level;
    text += fmt::format("  {:{}}{} [{}", "", 2 * level, joint.name, type_name(joint.type));
    if (joint.type != model::JointType::kFixed)
      text += fmt::format(" {} ({:g}, {:g}, {:g}), y[{}]",
                          joint.type == model::JointType::kRevolute ? "about" : "along", joint.axis[0],
                          joint.axis[1], joint.axis[2], coordinate++);
    text += fmt::format("] -> {}\n", mechanism.bodies[joint.child.value].name);
  }
  return text;
}

int run(const ModelArguments& arguments) {
  const std::optional<LoadedMechanism> loaded = load(arguments);
  if (!loaded) return kModelWrong;
  const model::Mechanism& mechanism = loaded->mechanism;
  const CompiledModel compiled = compile(mechanism, loaded->options);
  fmt::print("{}{}{}\n{}", mechanism.name, mechanism.description.empty() ? "" : ": ", mechanism.description,
             tree_text(mechanism));
  fmt::print("  {} bodies, {} degrees of freedom\n", mechanism.bodies.size(),
             model::moving_joints(mechanism).size());
  for (std::size_t i = 0; i < mechanism.actuators.size(); ++i)
    fmt::print("  input u[{}] {} acts on {}\n", i, mechanism.actuators[i].name,
               mechanism.joints[mechanism.actuators[i].joint.value].name);
  for (const model::Parameter& parameter : mechanism.parameters)
    fmt::print("  parameter {} = {:g} {} {}\n", parameter.name, parameter.value, parameter.unit,
               parameter.description);
  fmt::print("{}{}{}{}", operations_table(compiled.module), omissions_text(compiled.omissions),
             passes_text(compiled.passes), verdict_text(compiled.verdict));
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
