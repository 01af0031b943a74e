#include "passes/constants.hpp"

#include <optional>
#include <utility>

#include "ir/fixed_values.hpp"
#include "passes/constant_terms.hpp"
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
        constant_(ir::fixed_values(program)),
        copy_(program),
        products_(program.nodes.size()) {}

  Program run() {
    return remove_dead_code(copy_.run([this](ValueId id) -> std::optional<Signed> {
      const Node& node = program_[id];
      if (node.op == Op::kMultiply && (is_reciprocal(node.a, node.b) || is_reciprocal(node.b, node.a)))
        return copy_.builder().literal(1);
      if (const auto quotient = quotient_instead(id)) return quotient;
      if (constant_[id.value] || (node.op != Op::kMultiply && node.op != Op::kDivide)) return {};
      return joined(products_[id.value] = product(node));
    }));
  }

 private:
  /// Is `value` 1 over `divisor`?
  bool is_reciprocal(ValueId value, ValueId divisor) const {
    const Node& node = program_[value];
    if (node.op != Op::kDivide || node.b != divisor) return false;
    const Node& dividend = program_[node.a];
    return dividend.op == Op::kLiteral && dividend.literal == 1 && dividend.tail[0] == 0;
  }

  /// x/d for x (1/d) where that is all that 1/d is for.
  std::optional<Signed> quotient_instead(ValueId id) {
    const Node& node = program_[id];
    if (node.op != Op::kMultiply || node.a == node.b) return {};
    for (const auto& [reciprocal, x] : {std::pair(node.b, node.a), std::pair(node.a, node.b)}) {
      const Node& other = program_[reciprocal];
      if (uses_[reciprocal.value] > 1 || constant_[reciprocal.value] || !is_reciprocal(reciprocal, other.b))
        continue;
      return joined(products_[id.value] = quotient(x, other.b));
    }
    return {};
  }

  Product product(const Node& node) {
    if (node.op == Op::kDivide) return quotient(node.a, node.b);
    Product result;
    multiply_in(result, node.a);
    multiply_in(result, node.b);
    return result;
  }

  Product quotient(ValueId dividend, ValueId by) {
    Product result;
    multiply_in(result, dividend);
    const Signed divisor = copy_[by];
    std::optional<Signed>& side = constant_[by.value] ? result.constant : result.rest;
    side = copy_.builder().divide(side ? *side : copy_.builder().literal(1), divisor);
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
  return settled(program, [](const Program& p) { return group_constant_terms(Grouping(p).run()); });
}

}  // namespace jourdain::passes
