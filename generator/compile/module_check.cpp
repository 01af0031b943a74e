#include "compile/module_check.hpp"

#include <algorithm>

#include "ir/verify.hpp"

namespace jourdain {

using ir::LeafKind;

namespace {

/// Leaves that the arguments of a function are.
ir::LeafCounts leaves_of(const std::string& name, const programs::SceneShape& shape) {
  const std::vector<programs::FunctionInfo>& all = programs::all_functions();
  const auto function =
      std::find_if(all.begin(), all.end(), [&](const programs::FunctionInfo& f) { return f.name == name; });
  ir::LeafCounts leaves;
  if (function == all.end() || function->shape == programs::Shape::kState) return leaves;
  leaves[LeafKind::kPosition] = shape.positions;
  leaves[LeafKind::kVelocity] = shape.velocities;
  leaves[LeafKind::kTime] = 1;
  if (function->takes_input) leaves[LeafKind::kInput] = shape.inputs;
  if (function->takes_acceleration) leaves[LeafKind::kAcceleration] = shape.velocities;
  return leaves;
}

}  // namespace

std::vector<std::string> module_defects(const ir::Module& module, const programs::SceneShape& shape,
                                        std::size_t parameters) {
  ir::LeafCounts of_constants;
  of_constants[LeafKind::kParameter] = parameters;
  std::vector<std::string> list = ir::defects(module.constants, of_constants);
  for (const ir::Program& program : module.functions) {
    ir::LeafCounts leaves = leaves_of(program.name, shape);
    leaves[LeafKind::kConstant] = module.constants.outputs.size();
    if (module.constants.outputs.empty()) leaves[LeafKind::kParameter] = parameters;  // not hoisted yet
    for (std::string& sentence : ir::defects(program, leaves)) list.push_back(std::move(sentence));
  }
  return list;
}

}  // namespace jourdain
