#include "readback/node_table.hpp"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace jourdain::readback {

namespace {

constexpr std::uint32_t kMark = 1000;  ///< beyond the kinds of leaves

}  // namespace

std::size_t NodeTable::Hash::operator()(const Node& node) const {
  std::uint64_t hash = node.bits;
  for (const std::uint64_t part : {node.op, node.a, node.b})
    hash = (hash ^ part) * 0x9e3779b97f4a7c15u + (hash >> 29);
  return hash;
}

Number NodeTable::intern(const Node& node) {
  const auto [it, is_new] = known_.try_emplace(node, static_cast<Number>(nodes_.size()));
  if (is_new) nodes_.push_back(node);
  return it->second;
}

double NodeTable::rounded(double value) const {
  return rounds_to_float_ ? static_cast<double>(static_cast<float>(value)) : value;
}

Number NodeTable::array(std::vector<double> values) {
  for (double& value : values) value = rounded(value);
  return Domain::array(std::move(values));
}

Number NodeTable::literal(double given) {
  const double value = rounded(given);
  return intern({static_cast<std::uint32_t>(ir::Op::kLiteral), 0, 0, std::bit_cast<std::uint64_t>(value)});
}

Number NodeTable::leaf(ir::LeafKind kind, std::size_t index) {
  return intern({static_cast<std::uint32_t>(ir::Op::kLeaf), static_cast<std::uint32_t>(kind),
                 static_cast<std::uint32_t>(index), 0});
}

Number NodeTable::mark(std::size_t index) {
  return intern({static_cast<std::uint32_t>(ir::Op::kLeaf), kMark, static_cast<std::uint32_t>(index), 0});
}

Number NodeTable::apply(ir::Op op, Number a, Number b) {
  return intern({static_cast<std::uint32_t>(op), a, ir::operand_count(op) == 2 ? b : 0, 0});
}

std::vector<Number> NodeTable::insert(const ir::Program& program) {
  std::vector<Number> values;
  values.reserve(program.nodes.size());
  for (const ir::Node& node : program.nodes) {
    if (node.op == ir::Op::kLiteral)
      values.push_back(literal(node.literal));
    else if (node.op == ir::Op::kLeaf)
      values.push_back(leaf(node.leaf, node.index));
    else if (node.op == ir::Op::kEntry)
      values.push_back(apply(node.op, values[node.a.value],
                             array(support::array_of(static_cast<std::uint32_t>(program[node.b].literal)))));
    else
      values.push_back(apply(node.op, values[node.a.value],
                             ir::operand_count(node.op) == 2 ? values[node.b.value] : Number(0)));
  }
  std::vector<Number> outputs;
  for (const ir::Output& output : program.outputs) outputs.push_back(values[output.value.value]);
  return outputs;
}

std::string NodeTable::print(Number number, int depth) const {
  const Node& node = nodes_[number];
  const auto op = static_cast<ir::Op>(node.op);
  if (op == ir::Op::kLiteral) return fmt::format("{}", std::bit_cast<double>(node.bits));
  if (op == ir::Op::kLeaf)
    return node.a == kMark ? fmt::format("old[{}]", node.b)
                           : fmt::format("{}[{}]", ir::leaf_name(static_cast<ir::LeafKind>(node.a)), node.b);
  if (depth == 0) return "…";
  if (ir::operand_count(op) == 1) return fmt::format("{}({})", ir::op_name(op), print(node.a, depth - 1));
  return fmt::format("{}({}, {})", ir::op_name(op), print(node.a, depth - 1), print(node.b, depth - 1));
}

}  // namespace jourdain::readback
