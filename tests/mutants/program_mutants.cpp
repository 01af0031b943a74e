#include "mutants/program_mutants.hpp"

#include <algorithm>
#include <bit>

#include "properties/random.hpp"
#include "support/check.hpp"

namespace jourdain::tests {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::ValueId;

namespace {

bool is_sum(Op op) { return op == Op::kAdd || op == Op::kSubtract; }
bool is_ordered(Op op) { return op == Op::kSubtract || op == Op::kDivide || op == Op::kAtan2; }

std::size_t leaves_of_kind(const Program& program, ir::LeafKind kind) {
  std::size_t count = 0;
  for (const Node& node : program.nodes)
    if (node.op == Op::kLeaf && node.leaf == kind) count = std::max(count, node.index + std::size_t{1});
  return count;
}

Op other_operation(Op op) {
  switch (op) {
    case Op::kAdd:
    case Op::kSubtract:
    case Op::kDivide:
      return Op::kMultiply;
    case Op::kMultiply:
      return Op::kAdd;
    case Op::kNegate:
      return Op::kSqrt;
    case Op::kSqrt:
    case Op::kSin:
    case Op::kCos:
      return Op::kNegate;
    case Op::kAtan2:
      return Op::kDivide;
    case Op::kLiteral:
    case Op::kLeaf:
    default:
      break;
  }
  return op;
}

bool fits(const Program& program, const Node& node, std::size_t at, ProgramFault fault) {
  const int operands = ir::operand_count(node.op);
  switch (fault) {
    case ProgramFault::kFlipSum:
      return is_sum(node.op);
    case ProgramFault::kSwapOperands:
      return is_ordered(node.op) && node.a != node.b;
    case ProgramFault::kOtherOperand:
      return operands > 0 && at > 1;
    case ProgramFault::kOtherLeaf:
      return node.op == Op::kLeaf && leaves_of_kind(program, node.leaf) > 1;
    case ProgramFault::kOtherOperation:
    case ProgramFault::kBypass:
      return operands > 0;
    case ProgramFault::kSwapFunction:
      return node.op == Op::kSin || node.op == Op::kCos;
    case ProgramFault::kNumberByUlps:
    case ProgramFault::kNumberByPart:
    case ProgramFault::kNumberSign:
      return node.op == Op::kLiteral && node.literal != 0;
    case ProgramFault::kOtherOutput:
    case ProgramFault::kOutputIndex:
      return false;
  }
  return false;
}

/// The next output of the same array, or the same one where there is none.
std::size_t next_output(const Program& program, std::size_t at) {
  for (std::size_t k = 1; k < program.outputs.size(); ++k) {
    const std::size_t next = (at + k) % program.outputs.size();
    if (program.outputs[next].name == program.outputs[at].name) return next;
  }
  return at;
}

void plant(Program& program, Node& node, const ProgramSite& site, Random& random) {
  switch (site.fault) {
    case ProgramFault::kFlipSum:
      node.op = node.op == Op::kAdd ? Op::kSubtract : Op::kAdd;
      break;
    case ProgramFault::kSwapOperands:
      std::swap(node.a, node.b);
      break;
    case ProgramFault::kOtherOperand: {
      ValueId& operand = site.operand == 0 ? node.a : node.b;
      const std::size_t step = 1 + random.below(site.at - 1);
      operand = ValueId((operand.value + step) % site.at);
      break;
    }
    case ProgramFault::kOtherLeaf:
      node.index = static_cast<std::uint32_t>((node.index + 1) % leaves_of_kind(program, node.leaf));
      break;
    case ProgramFault::kOtherOperation:
      node.op = other_operation(node.op);
      break;
    case ProgramFault::kSwapFunction:
      node.op = node.op == Op::kSin ? Op::kCos : Op::kSin;
      break;
    case ProgramFault::kNumberByUlps:
      node.literal = std::bit_cast<double>(std::bit_cast<std::uint64_t>(node.literal) + (1u << 20));
      break;
    case ProgramFault::kNumberByPart:
      node.literal *= 1 + 1e-9;
      break;
    case ProgramFault::kNumberSign:
      node.literal = -node.literal;
      break;
    case ProgramFault::kBypass:
    case ProgramFault::kOtherOutput:
    case ProgramFault::kOutputIndex:
      break;
  }
}

/// Values that some output depends on.
std::vector<bool> live(const Program& program) {
  std::vector<bool> needed(program.nodes.size(), false);
  for (const ir::Output& output : program.outputs) needed[output.value.value] = true;
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    if (!needed[i]) continue;
    const Node& node = program.nodes[i];
    if (ir::operand_count(node.op) > 0) needed[node.a.value] = true;
    if (ir::operand_count(node.op) > 1) needed[node.b.value] = true;
  }
  return needed;
}

/// Every use of one value reads another.
void redirect(Program& program, ValueId from, ValueId to) {
  for (Node& node : program.nodes) {
    if (ir::operand_count(node.op) > 0 && node.a == from) node.a = to;
    if (ir::operand_count(node.op) > 1 && node.b == from) node.b = to;
  }
  for (ir::Output& output : program.outputs)
    if (output.value == from) output.value = to;
}

}  // namespace

const char* name_of(ProgramFault fault) {
  constexpr const char* kNames[kProgramFaults] = {
      "sum <-> difference", "operands swapped", "other operand",      "other leaf",
      "other operation",    "sine <-> cosine",  "operation dropped",  "number by 2^20 ulp",
      "number by 1e-9",     "sign of a number", "value of an output", "subscript of an output"};
  return kNames[static_cast<std::size_t>(fault)];
}

std::vector<ProgramSite> sites(const Program& program, ProgramFault fault) {
  std::vector<ProgramSite> list;
  const std::vector<bool> needed = live(program);
  for (std::size_t i = 0; i < program.nodes.size(); ++i) {
    if (!needed[i] || !fits(program, program.nodes[i], i, fault)) continue;
    const int choices = fault == ProgramFault::kOtherOperand ? ir::operand_count(program.nodes[i].op) : 1;
    for (int k = 0; k < choices; ++k) list.push_back({fault, i, static_cast<std::size_t>(k)});
  }
  if (fault == ProgramFault::kOtherOutput || fault == ProgramFault::kOutputIndex)
    for (std::size_t k = 0; k < program.outputs.size(); ++k)
      if (next_output(program, k) != k) list.push_back({fault, k, 0});
  return list;
}

Program planted(const Program& program, const ProgramSite& site, std::uint64_t seed) {
  Program mutant = program;
  if (site.fault == ProgramFault::kOtherOutput || site.fault == ProgramFault::kOutputIndex) {
    ir::Output& one = mutant.outputs[site.at];
    ir::Output& other = mutant.outputs[next_output(program, site.at)];
    if (site.fault == ProgramFault::kOutputIndex) std::swap(one.value, other.value);
    if (site.fault == ProgramFault::kOtherOutput) one.value = other.value;
  } else if (site.fault == ProgramFault::kBypass) {
    redirect(mutant, ValueId(site.at), program.nodes[site.at].a);
  } else {
    Random random(seed);
    plant(mutant, mutant.nodes[site.at], site, random);
  }
  return mutant;
}

}  // namespace jourdain::tests
