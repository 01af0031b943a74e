#include "passes/hoist.hpp"

#include <map>

#include "ir/compose.hpp"
#include "ir/fixed_values.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Builder;
using ir::LeafKind;
using ir::Module;
using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

class Hoisting {
 public:
  explicit Hoisting(const Module& module)
      : module_(module), known_(ir::insert(constants_, module.constants)) {}

  Module run() {
    Module result;
    for (const Program& function : module_.functions) result.functions.push_back(split(function));
    name_constants(result.functions);
    result.constants = remove_dead_code(constants_.finish("constants"));
    return result;
  }

 private:
  /// Value of a function on either side of the cut.
  struct Copy {
    Signed value;
    bool fixed = false;  ///< lives in the constants program
  };

  Program split(const Program& function) {
    Builder body;
    std::vector<Copy> copy(function.nodes.size());
    const auto inside = [&](ValueId id) {
      return copy[id.value].fixed ? read(body, copy[id.value].value) : copy[id.value].value;
    };
    for (std::size_t i = 0; i < function.nodes.size(); ++i) {
      const Node& node = function.nodes[i];
      const int operands = ir::operand_count(node.op);
      const bool fixed =
          (operands == 0 && (node.op == Op::kLiteral || ir::is_made_with_the_model(node.leaf))) ||
          (operands >= 1 && !ir::is_call(node.op) && copy[node.a.value].fixed &&
           (operands == 1 || copy[node.b.value].fixed));
      if (fixed)
        copy[i] = {node.op == Op::kLeaf && node.leaf == LeafKind::kConstant
                       ? known_[node.index]
                       : constants_.apply(node, copy[node.a.value].value, copy[node.b.value].value),
                   true};
      else {
        const Signed a = operands >= 1 ? inside(node.a) : Signed{};  // in order: reading may add a leaf
        const Signed b = operands == 2 ? inside(node.b) : Signed{};
        copy[i] = {body.apply(node, a, b), false};
      }
      if (!function.labels[i].empty())
        (fixed ? constants_ : body).label(copy[i].value.value, function.labels[i]);
    }
    for (const ir::Output& output : function.outputs)
      body.output(output.name, output.row, output.column, inside(output.value));
    return without_unused(body.finish(function.name));
  }

  /// A value of the constants program as seen from a function: literals are copied, others become a leaf.
  Signed read(Builder& body, Signed value) {
    const Node& node = constants_.program()[value.value];
    if (node.op == Op::kLiteral) {
      const Signed literal = body.apply(node, {}, {});
      return value.negative ? -literal : literal;
    }
    const auto [it, is_new] = index_.try_emplace(value.value, index_.size());
    if (is_new) constants_.output("constant", static_cast<int>(it->second), -1, {value.value, false});
    const Signed leaf = body.leaf(LeafKind::kConstant, it->second);
    return value.negative ? -leaf : leaf;
  }

  /// At the end, as a function may read a constant that a later one names.
  void name_constants(std::vector<Program>& functions) const {
    std::vector<std::string> names(index_.size());
    for (const auto& [value, index] : index_) names[index] = constants_.program().labels[value.value];
    for (Program& function : functions)
      for (std::size_t i = 0; i < function.nodes.size(); ++i)
        if (const Node& node = function.nodes[i]; node.op == Op::kLeaf && node.leaf == LeafKind::kConstant)
          function.labels[i] = names[node.index];
  }

  const Module& module_;
  Builder constants_;
  std::vector<Signed> known_;  ///< constants that the module already has
  std::map<ValueId, std::size_t> index_;
};

}  // namespace

Module hoist(const Module& module) { return Hoisting(module).run(); }

}  // namespace jourdain::passes
