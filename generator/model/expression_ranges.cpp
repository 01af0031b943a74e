#include "model/expression_ranges.hpp"

#include <cmath>

#include "model/expression_nodes.hpp"

namespace jourdain::model {

namespace {

using support::Function;
using support::Interval;
using Op = Expression::Op;

constexpr Interval kWholeTurn{0, 6.2831853071795872};

double corner(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }

/// Of real numbers: zero times what is not bounded is zero.
Interval product(Interval a, Interval b) {
  return support::around(
      {corner(a.low, b.low), corner(a.low, b.high), corner(a.high, b.low), corner(a.high, b.high)});
}

double ratio(double a, double b) { return std::isinf(b) ? 0 : a / b; }

/// What a divisor without bound leaves is between zero and what the other end leaves.
Interval quotient(Interval a, Interval b) {
  if (b.contains(0)) return Interval::line();
  return support::around(
      {ratio(a.low, b.low), ratio(a.low, b.high), ratio(a.high, b.low), ratio(a.high, b.high)});
}

Interval power(Interval base, int exponent) {
  const int size = std::abs(exponent);
  Interval value = Interval::point(1);
  for (int i = 0; i < size / 2; ++i) value = product(value, support::square(base));
  if (size % 2 == 1) value = product(value, base);
  return exponent < 0 ? quotient(Interval::point(1), value) : value;
}

}  // namespace

ExpressionEnclosure::ExpressionEnclosure(const Expression& expression, const ExpressionRanges& ranges)
    : nodes_(expression.nodes()), parameters_(ranges.parameters), is_moved_(moved_by_variables(nodes_)) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) add(i, ranges);
}

void ExpressionEnclosure::add(std::size_t i, const ExpressionRanges& ranges) {
  const Node& node = nodes_[i];
  values_.emplace_back();
  dimension_.push_back(kNone);
  const std::optional<Interval> own =
      node.op == Op::kVariable ? std::optional(ranges.variable(node.variable)) : period_of(i);
  if (own) {
    dimension_[i] = dimensions_.size();
    dimensions_.push_back({i, false, *own});
  }
  values_[i] = enclosed(i);
  if ((node.op == Op::kSin || node.op == Op::kCos) && dimension_of_angle(node.left) == kNone &&
      !(values_[node.left].width() < kWholeTurn.high))
    dimensions_.push_back({node.left, true, kWholeTurn});
}

/// Of x − P floor((x − c)/P) with numbers P and c, which has any value of a period, the ends where it begins anew;
/// nothing otherwise.
std::optional<Interval> ExpressionEnclosure::period_of(std::size_t i) const {
  if (nodes_[i].op != Op::kSubtract) return {};
  const auto number = [&](std::size_t n) { return !is_moved(n) ? values_[n].low : NAN; };
  const std::size_t x = nodes_[i].left;
  std::size_t inner = nodes_[i].right;
  double P = 1, c = 0;
  if (nodes_[inner].op == Op::kMultiply) {
    P = number(nodes_[inner].left);
    inner = nodes_[inner].right;
  }
  if (nodes_[inner].op != Op::kFunction || nodes_[inner].function != Function::kFloor) return {};
  inner = nodes_[inner].left;
  if (P != 1) {
    if (nodes_[inner].op != Op::kDivide || number(nodes_[inner].right) != P) return {};
    inner = nodes_[inner].left;
  }
  if (inner != x) {
    if (nodes_[inner].op != Op::kSubtract && nodes_[inner].op != Op::kAdd) return {};
    if (nodes_[inner].left != x) return {};
    c = number(nodes_[inner].right);
    if (nodes_[inner].op == Op::kAdd) c = -c;
  }
  if (!(P > 0) || std::isnan(c)) return {};
  return Interval{support::below(c, 4), support::above(c + P, 4)};
}

std::size_t ExpressionEnclosure::dimension_of_angle(std::size_t node) const {
  for (std::size_t d = 0; d < dimensions_.size(); ++d)
    if (dimensions_[d].is_angle && dimensions_[d].node == node) return d;
  return kNone;
}

Interval ExpressionEnclosure::angle(std::size_t node) const {
  const std::size_t d = dimension_of_angle(node);
  return d == kNone ? values_[node] : dimensions_[d].side;
}

Interval ExpressionEnclosure::enclosed(std::size_t i) const {
  if (dimension_[i] != kNone) return dimensions_[dimension_[i]].side;
  const Node& node = nodes_[i];
  const auto left = [&] { return values_[node.left]; };
  const auto right = [&] { return values_[node.right]; };
  switch (node.op) {
    case Op::kLiteral:
      return Interval::point(node.value);
    case Op::kParameter:
      return parameters_[node.parameter.value];
    case Op::kVariable:
      break;
    case Op::kNegate:
      return -left();
    case Op::kAdd:
      return left() + right();
    case Op::kSubtract:
      return left() - right();
    case Op::kMultiply:
      return node.left == node.right ? support::square(left()) : product(left(), right());
    case Op::kDivide:
      return quotient(left(), right());
    case Op::kPower:
      return power(left(), node.exponent);
    case Op::kSqrt:
      return sqrt(left());
    case Op::kSin:
      return sin(angle(node.left));
    case Op::kCos:
      return cos(angle(node.left));
    case Op::kFunction:
      return value_of(node.function, left(), operand_count(node) == 2 ? right() : Interval{});
  }
  return Interval::line();
}

ExpressionEnclosure::Part ExpressionEnclosure::part_of(std::size_t i) const {
  std::vector<char> needed(i + 1);
  needed[i] = 1;
  Part part;
  for (std::size_t n = i + 1; n-- > 0;) {
    if (needed[n] == 0) continue;
    part.nodes.push_back(n);
    const Node& node = nodes_[n];
    const int operands = operand_count(node);
    const bool is_wave = node.op == Op::kSin || node.op == Op::kCos;
    const std::size_t d = is_wave ? dimension_of_angle(node.left) : dimension_[n];
    if (d != kNone && std::find(part.dimensions.begin(), part.dimensions.end(), d) == part.dimensions.end())
      part.dimensions.push_back(d);
    if (d != kNone) continue;
    if (operands >= 1) needed[node.left] = 1;
    if (operands == 2) needed[node.right] = 1;
  }
  std::reverse(part.nodes.begin(), part.nodes.end());
  return part;
}

void ExpressionEnclosure::evaluate(const Part& part) {
  for (const std::size_t n : part.nodes) values_[n] = enclosed(n);
}

void ExpressionEnclosure::evaluate_all() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) values_[n] = enclosed(n);
}

double ExpressionEnclosure::side_of(std::size_t d) const {
  const Interval side = dimensions_[d].side;
  if (dimensions_[d].is_angle) return side.width() / kWholeTurn.high;
  return side.width() / std::max(1.0, std::min(std::fabs(side.low), std::fabs(side.high)));
}

/// In the middle, or as far again as the nearer end where the other one is much farther.
double ExpressionEnclosure::divided_at(Interval side) {
  if (side.low < 0 && side.high > 0) return 0;
  if (side.low >= 0 && side.high > 4 * std::max(side.low, 1.0)) return 2 * std::max(side.low, 1.0);
  if (side.high <= 0 && side.low < 4 * std::min(side.high, -1.0)) return 2 * std::min(side.high, -1.0);
  return side.middle();
}

}  // namespace jourdain::model
