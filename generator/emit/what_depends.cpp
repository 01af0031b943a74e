#include "emit/what_depends.hpp"

#include <fmt/format.h>

namespace jourdain::emit {

namespace {

using ir::LeafKind;
using programs::Role;

class Reader {
 public:
  explicit Reader(const programs::SceneFacts& scene)
      : positions_(scene.positions.size()),
        velocities_(scene.velocities.size()),
        none_(1 + positions_ + velocities_ + scene.inputs.size(), '0') {}

  const std::string& none() const { return none_; }

  /// That is entry `velocity` of z.
  std::string of_velocity(std::size_t velocity) const {
    std::string text = none_;
    text[1 + positions_ + velocity] = '1';
    return text;
  }

  std::string of(const ir::Program& program, ir::ValueId output) const {
    std::string text = none_;
    std::vector<bool> seen(program.nodes.size());
    std::vector<ir::ValueId> open = {output};
    while (!open.empty()) {
      const ir::ValueId id = open.back();
      open.pop_back();
      if (seen[id.value]) continue;
      seen[id.value] = true;
      const ir::Node& node = program[id];
      if (node.op == ir::Op::kLeaf) mark(node, text);
      const int operands = ir::operand_count(node.op);
      if (operands >= 1) open.push_back(node.a);
      if (operands == 2) open.push_back(node.b);
    }
    return text;
  }

 private:
  void mark(const ir::Node& leaf, std::string& text) const {
    switch (leaf.leaf) {
      case LeafKind::kTime:
        text[0] = '1';
        break;
      case LeafKind::kPosition:
        text[1 + leaf.index] = '1';
        break;
      case LeafKind::kVelocity:
        text[1 + positions_ + leaf.index] = '1';
        break;
      case LeafKind::kInput:
        text[1 + positions_ + velocities_ + leaf.index] = '1';
        break;
      case LeafKind::kParameter:
      case LeafKind::kConstant:
      case LeafKind::kAcceleration:
      case LeafKind::kMultiplier:
      case LeafKind::kStepLength:
      case LeafKind::kHeld:
        break;
    }
  }

  std::size_t positions_, velocities_;
  std::string none_;
};

std::string subscripted(const ir::Output& output) {
  return output.name + (output.row < 0 ? "" : fmt::format("[{}]", output.row)) +
         (output.column < 0 ? "" : fmt::format("[{}]", output.column));
}

const char* function_of(Role role) {
  switch (role) {
    case Role::kPositionRate:
      return "position_rate";
    case Role::kAcceleration:
      return "forward_dynamics";
    case Role::kOutput:
      return "outputs";
    case Role::kTime:
    case Role::kPosition:
    case Role::kVelocity:
    case Role::kInput:
    case Role::kParameter:
    case Role::kConstant:
      break;
  }
  return nullptr;
}

}  // namespace

std::vector<std::string> what_depends(const programs::Variable& variable, const programs::SceneFacts& scene,
                                      const ir::Module& module) {
  const char* const function = function_of(variable.role);
  if (!function) return {};
  const Reader reader(scene);
  if (variable.role == Role::kPositionRate && !scene.has_rate()) {
    for (const model::Tangent::Scalar& scalar : scene.tangent.scalars)
      if (scalar.position == variable.index) return {reader.of_velocity(scalar.velocity)};
    return {};
  }
  const ir::Program* program = ir::find_program(module, function);
  if (!program) return {};
  std::vector<std::string> list(variable.role == Role::kOutput ? variable.numbers.size() : 1, reader.none());
  for (const ir::Output& output : program->outputs)
    for (std::size_t k = 0; k < list.size(); ++k)
      if (variable.role == Role::kOutput ? variable.numbers[k] == subscripted(output)
                                         : output.row == static_cast<int>(variable.index))
        list[k] = reader.of(*program, output.value);
  return list;
}

}  // namespace jourdain::emit
