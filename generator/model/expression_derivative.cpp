#include "model/expression_derivative.hpp"

#include <cstddef>
#include <vector>

#include "model/expression_nodes.hpp"
#include "support/function_derivatives.hpp"

namespace jourdain::model {

namespace {

using Op = Expression::Op;
using Node = Expression::Node;
using support::Function;

/// A node of a list, with arithmetic that adds nodes.
struct Symbol {
  NodeList* list;
  std::size_t node;

  Symbol with(Op op, const Symbol& b) const {
    return {list, list->add({.op = op, .left = node, .right = b.node})};
  }
  Symbol number(double value) const { return {list, list->add({.op = Op::kLiteral, .value = value})}; }

  friend Symbol operator-(const Symbol& a) { return a.with(Op::kNegate, a); }
  friend Symbol operator+(const Symbol& a, const Symbol& b) { return a.with(Op::kAdd, b); }
  friend Symbol operator-(const Symbol& a, const Symbol& b) { return a.with(Op::kSubtract, b); }
  friend Symbol operator*(const Symbol& a, const Symbol& b) { return a.with(Op::kMultiply, b); }
  friend Symbol operator/(const Symbol& a, const Symbol& b) { return a.with(Op::kDivide, b); }
  friend Symbol value_of(Function function, const Symbol& a, const Symbol& b) {
    return {a.list,
            a.list->add({.op = Op::kFunction, .function = function, .left = a.node, .right = b.node})};
  }
};

/// `negative` where `sign` < 0, elsewhere `other`.
Symbol chosen(const Symbol& sign, const Symbol& negative, const Symbol& other) {
  return value_of(Function::kWhereNegative, sign, negative) +
         value_of(Function::kWhereNotNegative, sign, other);
}

Symbol rate_with_kinks(Function function, const Symbol& a, const Symbol& b, const Symbol& da,
                       const Symbol& db) {
  switch (function) {
    case Function::kAbs:
      return chosen(a, -da, da);
    case Function::kFloor:
    case Function::kEntry:
      return a.number(0);
    case Function::kMin:
      return chosen(b - a, db, da);
    case Function::kMax:
      return chosen(a - b, db, da);
    case Function::kWhereNegative:
    case Function::kWhereNotNegative:  // the condition has no part in the slope
      return value_of(function, a, db);
    default:
      throw support::InternalError("a function without kinks");
  }
}

Symbol rate_of_function(Function function, const Symbol& a, const Symbol& b, const Symbol& da,
                        const Symbol& db, bool of_a_alone) {
  if (support::is_opaque(function))
    throw support::InternalError("a call of user code is not differentiated here");
  const support::FunctionFacts& facts = support::facts_of(function);
  if (facts.has_kinks) return rate_with_kinks(function, a, b, da, db);
  const Symbol one = a.number(1);
  if (facts.operands == 1) return support::curve_of(function, a, one).slope * da;
  if (function == Function::kPower && of_a_alone) return support::power_of(a, b, one).slope * da;
  const support::Surface<Symbol> f = support::surface_of(function, a, b, one);
  return f.by_a * da + f.by_b * db;
}

}  // namespace

Expression derivative(const Expression& expression, const std::function<Expression(const Variable&)>& rate) {
  NodeList list;
  const Symbol zero{&list, list.add({.op = Op::kLiteral})};
  std::vector<Symbol> values, rates;
  for (Node node : expression.nodes()) {
    const int operands = operand_count(node);
    const std::size_t left = node.left, right = operands == 2 ? node.right : node.left;
    if (operands > 0) {
      node.left = values[left].node;
      node.right = values[right].node;
    }
    const Symbol value{&list, list.add(node)};
    const auto unmoved = [&](std::size_t i) { return rates[i].node == zero.node; };
    Symbol slope = zero;
    if (node.op == Op::kVariable) slope = {&list, list.append(rate(node.variable))};
    if (operands > 0 && !(unmoved(left) && unmoved(right))) {
      const Symbol &a = values[left], &b = values[right], &da = rates[left], &db = rates[right];
      switch (node.op) {
        case Op::kNegate:
          slope = -da;
          break;
        case Op::kAdd:
          slope = da + db;
          break;
        case Op::kSubtract:
          slope = da - db;
          break;
        case Op::kMultiply:
          slope = da * b + a * db;
          break;
        case Op::kDivide:
          slope = (da - value * db) / b;
          break;
        case Op::kPower: {
          const Symbol less{&list,
                            list.add({.op = Op::kPower, .exponent = node.exponent - 1, .left = a.node})};
          slope = a.number(node.exponent) * less * da;
          break;
        }
        case Op::kSqrt:
          slope = da / (value + value);
          break;
        case Op::kSin:
          slope = a.with(Op::kCos, a) * da;
          break;
        case Op::kCos:
          slope = -(a.with(Op::kSin, a) * da);
          break;
        case Op::kFunction:
          slope = rate_of_function(node.function, a, b, da, db, unmoved(right));
          break;
        case Op::kLiteral:
        case Op::kParameter:
        case Op::kVariable:
          break;
      }
    }
    values.push_back(value);
    rates.push_back(slope);
  }
  return Expression::composed({}, list.finish(rates.back().node));
}

Expression derivative(const Expression& expression, const Variable& by) {
  return derivative(expression, [&by](const Variable& variable) { return variable == by ? 1.0 : 0.0; });
}

}  // namespace jourdain::model
