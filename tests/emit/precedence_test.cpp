// What the printer writes for each nesting of two operations: without the right parentheses it is another program.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "emit/body.hpp"
#include "emit/cpp/printer.hpp"

namespace jourdain::emit {
namespace {

using ir::Node;
using ir::Op;
using ir::ValueId;

/// A program over the leaves a, b, c, d, written node by node: no builder simplifies it.
class Written {
 public:
  Written() {
    for (std::uint32_t i = 0; i < 4; ++i)
      program_.nodes.push_back({.op = Op::kLeaf, .leaf = ir::LeafKind::kPosition, .index = i});
  }
  ValueId leaf(std::uint32_t i) const { return ValueId(i); }
  ValueId node(Op op, ValueId a, ValueId b = {}) {
    program_.nodes.push_back({.op = op, .a = a, .b = b});
    return ValueId(program_.nodes.size() - 1);
  }
  ValueId literal(double value) {
    program_.nodes.push_back({.op = Op::kLiteral, .literal = value});
    return ValueId(program_.nodes.size() - 1);
  }
  std::string text(ValueId result) { return lines(result).back(); }
  std::vector<std::string> lines(ValueId result) {
    program_.labels.assign(program_.nodes.size(), "");
    program_.outputs = {{"r", -1, -1, result}};
    const Body body = body_of(
        program_, Names({}), [](ir::LeafKind, std::size_t i) { return name(std::string(1, "abcd"[i])); },
        [](const ir::Output&, const Expression& value) { return Statement{Return{value}}; });
    std::vector<std::string> lines;
    for (const Statement& statement : body.parts.at(0)) {
      const auto* last = std::get_if<Return>(&statement.is);
      lines.push_back(last ? cpp::expression_text(last->value, {})
                           : cpp::statements_text({statement}, {}, 0));
      if (!last) lines.back().pop_back();
    }
    return lines;
  }

 private:
  ir::Program program_;
};

/// a op (b inner c).
std::string right(Op op, Op inner) {
  Written w;
  return w.text(w.node(op, w.leaf(0), w.node(inner, w.leaf(1), w.leaf(2))));
}

/// (a inner b) op c.
std::string left(Op op, Op inner) {
  Written w;
  return w.text(w.node(op, w.node(inner, w.leaf(0), w.leaf(1)), w.leaf(2)));
}

TEST(Precedence, SumsOnTheRightOfASumKeepTheirParentheses) {
  EXPECT_EQ(right(Op::kAdd, Op::kAdd), "a + (b + c)");
  EXPECT_EQ(right(Op::kAdd, Op::kSubtract), "a + (b - c)");
  EXPECT_EQ(right(Op::kSubtract, Op::kAdd), "a - (b + c)");
  EXPECT_EQ(right(Op::kSubtract, Op::kSubtract), "a - (b - c)");
}

TEST(Precedence, SumsOnTheLeftOfASumNeedNone) {
  EXPECT_EQ(left(Op::kAdd, Op::kAdd), "a + b + c");
  EXPECT_EQ(left(Op::kAdd, Op::kSubtract), "a - b + c");
  EXPECT_EQ(left(Op::kSubtract, Op::kAdd), "a + b - c");
  EXPECT_EQ(left(Op::kSubtract, Op::kSubtract), "a - b - c");
}

TEST(Precedence, ProductsOnTheRightOfAProductKeepTheirParentheses) {
  EXPECT_EQ(right(Op::kMultiply, Op::kMultiply), "a * (b * c)");
  EXPECT_EQ(right(Op::kMultiply, Op::kDivide), "a * (b / c)");
  EXPECT_EQ(right(Op::kDivide, Op::kMultiply), "a / (b * c)");
  EXPECT_EQ(right(Op::kDivide, Op::kDivide), "a / (b / c)");
}

TEST(Precedence, ProductsOnTheLeftOfAProductNeedNone) {
  EXPECT_EQ(left(Op::kMultiply, Op::kMultiply), "a * b * c");
  EXPECT_EQ(left(Op::kMultiply, Op::kDivide), "a / b * c");
  EXPECT_EQ(left(Op::kDivide, Op::kMultiply), "a * b / c");
  EXPECT_EQ(left(Op::kDivide, Op::kDivide), "a / b / c");
}

TEST(Precedence, ProductsInSumsNeedNoneAndSumsInProductsDo) {
  EXPECT_EQ(right(Op::kSubtract, Op::kMultiply), "a - b * c");
  EXPECT_EQ(right(Op::kAdd, Op::kDivide), "a + b / c");
  EXPECT_EQ(left(Op::kSubtract, Op::kDivide), "a / b - c");
  EXPECT_EQ(right(Op::kMultiply, Op::kAdd), "a * (b + c)");
  EXPECT_EQ(right(Op::kDivide, Op::kSubtract), "a / (b - c)");
  EXPECT_EQ(left(Op::kMultiply, Op::kSubtract), "(a - b) * c");
  EXPECT_EQ(left(Op::kDivide, Op::kAdd), "(a + b) / c");
}

TEST(Precedence, ANegativeSumOrProductIsNegativeAsAWhole) {
  for (const auto& [op, text] : {std::pair{Op::kAdd, "-(a + b)"},
                                 {Op::kSubtract, "-(a - b)"},
                                 {Op::kMultiply, "-(a * b)"},
                                 {Op::kDivide, "-(a / b)"}}) {
    Written w;
    EXPECT_EQ(w.text(w.node(Op::kNegate, w.node(op, w.leaf(0), w.leaf(1)))), text);
  }
}

TEST(Precedence, ANegativeOperandKeepsItsParenthesesWhereASignWouldMeetAnOperator) {
  const auto with_negative = [](Op op, bool is_left) {
    Written w;
    const ValueId minus = w.node(Op::kNegate, w.leaf(0));
    return w.text(is_left ? w.node(op, minus, w.leaf(1)) : w.node(op, w.leaf(1), minus));
  };
  EXPECT_EQ(with_negative(Op::kSubtract, false), "b - (-a)");
  EXPECT_EQ(with_negative(Op::kAdd, false), "b + (-a)");
  EXPECT_EQ(with_negative(Op::kMultiply, false), "b * (-a)");
  EXPECT_EQ(with_negative(Op::kDivide, false), "b / (-a)");
  EXPECT_EQ(with_negative(Op::kAdd, true), "-a + b");
  EXPECT_EQ(with_negative(Op::kMultiply, true), "(-a) * b");
  Written w;
  EXPECT_EQ(w.text(w.node(Op::kNegate, w.node(Op::kNegate, w.leaf(0)))), "-(-a)");
}

TEST(Precedence, NegativeLiteralsAreWrittenAsNumbers) {
  Written w;
  EXPECT_EQ(w.text(w.node(Op::kSubtract, w.leaf(0), w.literal(-2.5))), "a - Real(-2.5)");
}

TEST(Precedence, ThreeLevelsAreThoseOfTwo) {
  Written w;
  const ValueId inner = w.node(Op::kSubtract, w.leaf(2), w.leaf(3));
  const ValueId product = w.node(Op::kMultiply, w.leaf(1), inner);
  EXPECT_EQ(w.text(w.node(Op::kSubtract, w.leaf(0), product)), "a - b * (c - d)");
}

TEST(Precedence, SinesAndCosinesAreCalledByTheirNames) {
  for (const auto& [op, text] : {std::pair{Op::kSin, "const Real t4 = detail::sine(a);"},
                                 {Op::kCos, "const Real t4 = detail::cosine(a);"}}) {
    Written w;
    EXPECT_EQ(w.lines(w.node(op, w.leaf(0)))[0], text);
  }
}

TEST(Precedence, ThePairOfAnAngleIsSineThenCosineWhicheverComesFirst) {
  using Lines = std::vector<std::string>;
  Written one, other;
  const ValueId s = one.node(Op::kSin, one.leaf(0)), c = one.node(Op::kCos, one.leaf(0));
  EXPECT_EQ(one.lines(one.node(Op::kSubtract, s, c)),
            (Lines{"Real t4, t5;", "detail::sine_cosine(a, t4, t5);", "t4 - t5"}));
  const ValueId cosine = other.node(Op::kCos, other.leaf(0)), sine = other.node(Op::kSin, other.leaf(0));
  EXPECT_EQ(other.lines(other.node(Op::kSubtract, cosine, sine)),
            (Lines{"Real t5, t4;", "detail::sine_cosine(a, t5, t4);", "t4 - t5"}));
}

TEST(Precedence, ArgumentsOfFunctionsNeedNone) {
  Written w;
  const ValueId sum = w.node(Op::kAdd, w.leaf(0), w.leaf(1));
  EXPECT_EQ(w.text(w.node(Op::kSqrt, sum)), "detail::square_root(a + b)");
}

}  // namespace
}  // namespace jourdain::emit
