#include "ir/verify.hpp"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <tuple>

namespace jourdain::ir {

namespace {

class Inspection {
 public:
  Inspection(const Program& program, const LeafCounts& leaves) : program_(program), leaves_(leaves) {}

  std::vector<std::string> run() {
    if (program_.labels.size() != program_.nodes.size())
      found("{} labels for {} values", program_.labels.size(), program_.nodes.size());
    for (std::size_t i = 0; i < program_.nodes.size(); ++i) inspect(i);
    inspect_outputs();
    inspect_lanes();
    if (list_.empty()) inspect_uses();  // whose operands exist
    return std::move(list_);
  }

 private:
  template <class... T>
  void found(fmt::format_string<T...> text, T&&... values) {
    list_.push_back(program_.name + ": " + fmt::format(text, std::forward<T>(values)...));
  }

  void inspect(std::size_t i) {
    const Node& node = program_.nodes[i];
    if (node.op == Op::kLiteral && !std::isfinite(node.literal))
      found("%{} is the literal {}", i, node.literal);
    if (node.op == Op::kLeaf && node.index >= leaves_[node.leaf])
      found("%{} is {}[{}] of {}", i, leaf_name(node.leaf), node.index, leaves_[node.leaf]);
    const int operands = operand_count(node.op);
    if (operands >= 1) inspect_operand(i, node.a);
    if (operands == 2) inspect_operand(i, node.b);
    if (node.op == Op::kEntry && node.b.value < i && program_.nodes[node.b.value].op != Op::kLiteral)
      found("%{} is an entry of an array that %{} decides, which is no literal", i, node.b.value);
    inspect_call(i);
  }

  void inspect_call(std::size_t i) {
    const Node& node = program_.nodes[i];
    const auto op_of = [&](ValueId id) { return id.value < i ? program_.nodes[id.value].op : Op::kLeaf; };
    if (node.op == Op::kCall) {
      std::size_t count = 0;
      for (ValueId list = node.a; op_of(list) == Op::kArgument; list = program_.nodes[list.value].b) ++count;
      if (op_of(node.b) != Op::kLiteral)
        found("%{} calls what %{} decides, which is no literal", i, node.b.value);
      else if (const auto& called = support::called_by(program_.nodes[node.b.value].literal);
               called.arguments.size() != count)
        found("%{} calls {} with {} arguments", i, called.member(), count);
    }
    if (node.op == Op::kArgument && op_of(node.b) != Op::kArgument && op_of(node.b) != Op::kLiteral)
      found("%{} is an argument behind %{}, which is none", i, node.b.value);
    const int operands = operand_count(node.op);
    if ((operands >= 1 && node.op != Op::kCall && op_of(node.a) == Op::kArgument) ||
        (operands == 2 && node.op != Op::kArgument && op_of(node.b) == Op::kArgument))
      found("%{} takes arguments of a call for a value", i);
  }

  void inspect_operand(std::size_t i, ValueId operand) {
    if (operand.value >= i)
      found("%{} = {} of %{}, which does not precede it", i, op_name(program_.nodes[i].op), operand.value);
  }

  void inspect_outputs() {
    std::set<std::tuple<std::string, int, int>> seen;
    for (const Output& output : program_.outputs) {
      if (output.value.value >= program_.nodes.size())
        found("output '{}' is %{} of {}", output.name, output.value.value, program_.nodes.size());
      if (!seen.insert({output.name, output.row, output.column}).second)
        found("output '{}' [{}][{}] is given twice", output.name, output.row, output.column);
    }
  }

  void inspect_lanes() {
    std::set<std::size_t> seen;
    for (const std::vector<ValueId>& bundle : program_.lanes) {
      for (std::size_t l = 0; l < bundle.size(); ++l) {
        const std::size_t i = bundle[l].value;
        if (i >= program_.nodes.size() || i != bundle[0].value + l || !seen.insert(i).second ||
            operand_count(program_.nodes[i].op) != 2 || program_.nodes[i].op != program_[bundle[0]].op)
          return found("lane {} of %{} is %{}", l, bundle[0].value, i);
        for (const ValueId operand : {program_.nodes[i].a, program_.nodes[i].b})
          if (operand.value >= bundle[0].value)
            found("%{} needs %{}, which is computed with it", i, operand.value);
      }
      if (bundle.size() < 2) found("%{} is alone in its lanes", bundle.empty() ? 0 : bundle[0].value);
    }
  }

  void inspect_uses() {
    const std::vector<std::size_t> uses = use_counts(program_);
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (uses[i] == 0) found("%{} is used by nothing", i);
  }

  const Program& program_;
  const LeafCounts& leaves_;
  std::vector<std::string> list_;
};

}  // namespace

std::vector<std::string> defects(const Program& program, const LeafCounts& leaves) {
  return Inspection(program, leaves).run();
}

}  // namespace jourdain::ir
