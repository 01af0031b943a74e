#include "readback/what_is_read.hpp"

#include <fmt/format.h>

#include <map>

namespace jourdain::readback {

namespace {

/// One text for each value of the program, from its operands'.
std::vector<std::string> read_by_values(const ir::Program& program, const Expected& expected) {
  const std::size_t ny = expected.positions.size(), nz = expected.velocities.size();
  const std::map<ir::LeafKind, std::size_t> first = {{ir::LeafKind::kTime, 0},
                                                     {ir::LeafKind::kPosition, 1},
                                                     {ir::LeafKind::kVelocity, 1 + ny},
                                                     {ir::LeafKind::kInput, 1 + ny + nz}};
  std::vector<std::string> read;
  read.reserve(program.nodes.size());
  for (const ir::Node& node : program.nodes) {
    std::string text(1 + ny + nz + expected.inputs.size(), '0');
    const auto place = first.find(node.leaf);
    if (node.op == ir::Op::kLeaf && place != first.end()) text.at(place->second + node.index) = '1';
    const int operands = ir::operand_count(node.op);
    for (int k = 0; k < operands; ++k) {
      const std::string& of = read[(k == 0 ? node.a : node.b).value];
      for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i] == '1') text[i] = '1';
    }
    read.push_back(std::move(text));
  }
  return read;
}

}  // namespace

std::vector<std::string> what_is_read(const ExpectedVariable& variable, const Expected& expected) {
  const std::map<std::string, std::string> computed_by = {
      {"position_rate", "position_rate"}, {"acceleration", "forward_dynamics"}, {"output", "outputs"}};
  const auto function = computed_by.find(variable.role);
  if (function == computed_by.end()) return {};
  std::string nothing(1 + expected.positions.size() + expected.velocities.size() + expected.inputs.size(),
                      '0');
  const ir::Program* program = ir::find_program(*expected.module, function->second);
  if (!program) {
    if (variable.role != "position_rate" || !expected.rate_is_velocity) return {};
    for (const ExpectedTangent& scalar : expected.scalars)
      if (scalar.position == variable.index) nothing[1 + expected.positions.size() + scalar.velocity] = '1';
    return {nothing};
  }
  const std::vector<std::string> values = read_by_values(*program, expected);
  std::vector<std::string> list(variable.role == "output" ? variable.numbers.size() : 1, nothing);
  for (const ir::Output& output : program->outputs) {
    std::string name = output.name;
    for (const int subscript : {output.row, output.column})
      if (subscript >= 0) name += fmt::format("[{}]", subscript);
    for (std::size_t k = 0; k < list.size(); ++k)
      if (variable.role == "output" ? variable.numbers[k] == name
                                    : output.row == static_cast<int>(variable.index))
        list[k] = values[output.value.value];
  }
  return list;
}

}  // namespace jourdain::readback
