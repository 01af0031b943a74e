#include "compile/module_check.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "ir/verify.hpp"

namespace jourdain {

using ir::LeafKind;

namespace {

/// Leaves that the arguments of a function are.
ir::LeafCounts leaves_of(const std::string& name, const programs::SceneFacts& scene) {
  std::vector<programs::FunctionInfo> all = programs::all_functions();
  for (programs::FunctionInfo& function : programs::kinematic_functions(scene))
    all.push_back(std::move(function));
  const auto function =
      std::find_if(all.begin(), all.end(), [&](const programs::FunctionInfo& f) { return f.name == name; });
  ir::LeafCounts leaves;
  if (function == all.end() || function->shape == programs::Shape::kState) return leaves;
  leaves[LeafKind::kPosition] = scene.positions.size();
  leaves[LeafKind::kVelocity] = scene.velocities.size();
  leaves[LeafKind::kTime] = 1;
  if (function->shape == programs::Shape::kSampling) leaves[LeafKind::kStepLength] = 1;
  if (programs::takes_input(*function, scene)) leaves[LeafKind::kInput] = scene.inputs.size();
  if (function->takes_acceleration) leaves[LeafKind::kAcceleration] = scene.velocities.size();
  return leaves;
}

using Entry = std::tuple<std::string, int, int>;

/// Name and subscripts of every number of the outputs, as their kinds declare them.
std::vector<Entry> declared_entries(const programs::SceneFacts& scene) {
  std::vector<Entry> entries;
  for (const programs::OutputFacts& output : scene.outputs)
    for (const programs::OutputMember& member : output.members)
      for (int k = 0; k < member.rows * member.columns; ++k)
        entries.emplace_back(output.name + (member.name.empty() ? "" : "." + member.name),
                             member.rows > 1 ? k / member.columns : -1,
                             member.is_matrix ? k % member.columns : -1);
  return entries;
}

/// They are derived as they are declared: in this order, member by member.
void compare_outputs(const ir::Module& module, const programs::SceneFacts& scene,
                     std::vector<std::string>& list) {
  const ir::Program* program = ir::find_program(module, ir::FunctionId::kOutputs);
  if (!program) return;
  std::vector<Entry> derived;
  for (const ir::Output& output : program->outputs)
    derived.emplace_back(output.name, output.row, output.column);
  if (derived != declared_entries(scene)) list.push_back("outputs: derived are others than are declared");
}

}  // namespace

std::vector<std::string> module_defects(const ir::Module& module, const programs::SceneFacts& scene) {
  ir::LeafCounts of_constants;
  of_constants[LeafKind::kParameter] = scene.parameters.size();
  std::vector<std::string> list = ir::defects(module.constants, of_constants);
  compare_outputs(module, scene, list);
  for (const ir::Program& program : module.functions) {
    ir::LeafCounts leaves = leaves_of(program.name, scene);
    leaves[LeafKind::kConstant] = module.constants.outputs.size();
    if (module.constants.outputs.empty())
      leaves[LeafKind::kParameter] = scene.parameters.size();  // not hoisted yet
    for (std::string& sentence : ir::defects(program, leaves)) list.push_back(std::move(sentence));
  }
  return list;
}

}  // namespace jourdain
