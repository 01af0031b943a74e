#include "passes/constants.hpp"

#include <optional>

#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

/// A product taken apart: the constant factors multiplied together, and the others.
struct Product {
  std::optional<Signed> constant, rest;
};

class Grouping {
 public:
  explicit Grouping(const Program& program)
      : program_(program),
        uses_(ir::use_counts(program)),
        constant_(program.nodes.size()),
        copy_(program),
        products_(program.nodes.size()) {
    for (std::size_t i = 0; i < program.nodes.size(); ++i) constant_[i] = is_constant(program.nodes[i]);
  }

  Program run() {
    return remove_dead_code(copy_.run([this](ValueId id) -> std::optional<Signed> {
      const Node& node = program_[id];
      if (node.op == Op::kMultiply && (is_reciprocal(node.a, node.b) || is_reciprocal(node.b, node.a)))
        return copy_.builder().literal(1);
      if (constant_[id.value] || (node.op != Op::kMultiply && node.op != Op::kDivide)) return {};
      return joined(products_[id.value] = product(node));
    }));
  }

 private:
  bool is_constant(const Node& node) const {
    if (node.op == Op::kLiteral) return true;
    if (node.op == Op::kLeaf)
      return node.leaf == ir::LeafKind::kParameter || node.leaf == ir::LeafKind::kConstant;
    return constant_[node.a.value] && (ir::operand_count(node.op) == 1 || constant_[node.b.value]);
  }

  /// Is `value` 1 over `divisor`?
  bool is_reciprocal(ValueId value, ValueId divisor) const {
    const Node& node = program_[value];
    if (node.op != Op::kDivide || node.b != divisor) return false;
    const Node& dividend = program_[node.a];
    return dividend.op == Op::kLiteral && dividend.literal == 1 && dividend.tail[0] == 0;
  }

  Product product(const Node& node) {
    Product result;
    multiply_in(result, node.a);
    if (node.op == Op::kMultiply) {
      multiply_in(result, node.b);
    } else if (constant_[node.b.value]) {
      const Signed divisor = copy_[node.b];
      result.constant = result.constant ? copy_.builder().divide(*result.constant, divisor)
                                        : copy_.builder().divide(copy_.builder().literal(1), divisor);
    } else {
      const Signed divisor = copy_[node.b];
      result.rest = copy_.builder().divide(result.rest ? *result.rest : copy_.builder().literal(1), divisor);
    }
    return result;
  }

  void multiply_in(Product& product, ValueId factor) {
    const auto times = [this](std::optional<Signed>& side, Signed value) {
      side = side ? copy_.builder().multiply(*side, value) : value;
    };
    const Product& inner = products_[factor.value];
    if (constant_[factor.value]) return times(product.constant, copy_[factor]);
    if (!inner.constant || !inner.rest || uses_[factor.value] > 1) return times(product.rest, copy_[factor]);
    times(product.constant, *inner.constant);
    times(product.rest, *inner.rest);
  }

  Signed joined(const Product& product) {
    if (!product.constant) return *product.rest;
    return product.rest ? copy_.builder().multiply(*product.constant, *product.rest) : *product.constant;
  }

  const Program& program_;
  std::vector<std::size_t> uses_;
  std::vector<bool> constant_;
  Copy copy_;
  std::vector<Product> products_;
};

}  // namespace

Program group_constants(const Program& program) {
  return settled(program, [](const Program& p) { return Grouping(p).run(); });
}

}  // namespace jourdain::passes
