#include "model/hidden_kinks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "model/expression_nodes.hpp"
#include "support/interval.hpp"

namespace jourdain::model {

namespace {

using support::Function;
using support::Interval;
using Op = Expression::Op;
using Node = Expression::Node;
using Nodes = std::vector<Node>;

constexpr Interval kTurn{0, 6.2831853071795872};
/// Values of nodes that one proof may take.
constexpr std::size_t kMostValues = 2'000'000;
/// A box whose sides are this small, of a turn, of the time or of 1, is no longer divided.
constexpr double kLeastSide = 1e-5;
/// Nothing is proven beyond: s, thirty years; of states and inputs in SI units.
constexpr double kMostTime = 1e9, kMostState = 1e30;
/// Below zero by less than this part of its size a value may be zero, and rounded.
constexpr double kRounding = 1e-12;

/// What values follow from: a variable, or an angle whose sine or cosine is taken, as if it were a variable.
struct Dimension {
  std::size_t node = 0;
  bool is_angle = false;
  Interval side;
};

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

bool is_whole(Interval a) { return a.low == a.high && a.low == std::floor(a.low); }

struct Facts {
  std::string_view words, hint;
};

constexpr Facts facts_of(HiddenKink::Kind kind) {
  using Kind = HiddenKink::Kind;
  switch (kind) {
    case Kind::kRoot:
      return {"a root of what may be zero", "sqrt(x^2 + w^2), with a small width w, has no kink"};
    case Kind::kQuotient:
      return {"a divisor may be zero",
              "at some time from 0 on, or where states are there: keep it away from zero"};
    case Kind::kLogarithm:
      return {"the logarithm of what may be zero", "at some time from 0 on, or where states are there"};
    case Kind::kAngle:
      break;
  }
  return {"an angle may jump by a turn",
          "what goes round: write what grows with it, plus an angle that does not go round"};
}

class Search {
 public:
  Search(const Nodes& nodes, std::span<const double> parameters, bool states_are_given)
      : nodes_(nodes), parameters_(parameters), states_are_given_(states_are_given) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) add(i);
  }

  std::optional<HiddenKink> run() {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::optional<HiddenKink::Kind> kind = kind_of(nodes_[i]);
      if (!kind || is_moved_[i] == 0) continue;
      if (is_given_[nodes_[i].op == Op::kDivide ? nodes_[i].right : i] != 0) {
        if (const std::optional<HiddenKink> kink = possible(i, *kind)) return kink;
      } else if (*kind == HiddenKink::Kind::kRoot && is_certain(i)) {
        return HiddenKink{*kind};
      }
    }
    return {};
  }

 private:
  static std::optional<HiddenKink::Kind> kind_of(const Node& node) {
    using Kind = HiddenKink::Kind;
    if (node.op == Op::kSqrt) return Kind::kRoot;
    if (node.op == Op::kDivide || (node.op == Op::kPower && node.exponent < 0)) return Kind::kQuotient;
    if (node.op != Op::kFunction) return {};
    if (node.function == Function::kPower) return Kind::kRoot;
    if (node.function == Function::kLog) return Kind::kLogarithm;
    if (node.function == Function::kAtan2) return Kind::kAngle;
    return {};
  }

  bool is_given(const Variable& variable) const {
    using Kind = Variable::Kind;
    return variable.kind == Kind::kTime || variable.kind == Kind::kInput ||
           (variable.kind == Kind::kState && states_are_given_);
  }

  void add(std::size_t i) {
    const Node& node = nodes_[i];
    const int operands = operand_count(node);
    const auto of_operands = [&](const std::vector<char>& list, bool all) {
      const bool left = operands >= 1 ? list[node.left] != 0 : all,
                 right = operands == 2 ? list[node.right] != 0 : all;
      return all ? left && right : left || right;
    };
    const bool is_variable = node.op == Op::kVariable;
    is_moved_.push_back(is_variable || of_operands(is_moved_, false));
    is_given_.push_back(is_variable ? is_given(node.variable) : of_operands(is_given_, true));
    values_.emplace_back();
    dimension_.push_back(kNone);
    if (is_variable) {
      dimension_[i] = dimensions_.size();
      dimensions_.push_back({i, false,
                             node.variable.kind == Variable::Kind::kTime
                                 ? Interval{0, kMostTime}
                                 : Interval{-kMostState, kMostState}});
    }
    values_[i] = value(i);
    if ((node.op == Op::kSin || node.op == Op::kCos) && dimension_of_angle(node.left) == kNone &&
        !(values_[node.left].width() < kTurn.high))
      dimensions_.push_back({node.left, true, kTurn});
  }

  std::size_t dimension_of_angle(std::size_t node) const {
    for (std::size_t d = 0; d < dimensions_.size(); ++d)
      if (dimensions_[d].is_angle && dimensions_[d].node == node) return d;
    return kNone;
  }

  Interval angle(std::size_t node) const {
    const std::size_t d = dimension_of_angle(node);
    return d == kNone ? values_[node] : dimensions_[d].side;
  }

  Interval value(std::size_t i) const {
    const Node& node = nodes_[i];
    const auto left = [&] { return values_[node.left]; };
    const auto right = [&] { return values_[node.right]; };
    switch (node.op) {
      case Op::kLiteral:
        return Interval::point(node.value);
      case Op::kParameter:
        return Interval::point(parameters_[node.parameter.value]);
      case Op::kVariable:
        return dimensions_[dimension_[i]].side;
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

  /// Whether the operands, in the box that was evaluated last, may be where the operation has no derivative.
  bool is_suspect(std::size_t i) const {
    const Node& node = nodes_[i];
    const Interval a = values_[node.left];
    switch (*kind_of(node)) {
      case HiddenKink::Kind::kRoot: {
        if (node.op == Op::kSqrt) return a.low <= 0;
        const Interval b = values_[node.right];
        return a.low <= 0 && !(is_whole(b) && b.low >= 0) && !(a.low >= -kRounding && b.low > 1);
      }
      case HiddenKink::Kind::kQuotient:
        return (node.op == Op::kDivide ? values_[node.right] : a).contains(0);
      case HiddenKink::Kind::kLogarithm:
        return a.low <= 0;
      case HiddenKink::Kind::kAngle:
        return a.contains(0) && values_[node.right].low <= 0;
    }
    return true;
  }

  /// Positions of what node `i` is computed from, and itself, in order; of the dimensions those that it depends on.
  struct Part {
    std::vector<std::size_t> nodes, dimensions;
  };

  Part part_of(std::size_t i) const {
    std::vector<char> needed(i + 1);
    needed[i] = 1;
    Part part;
    for (std::size_t n = i + 1; n-- > 0;) {
      if (needed[n] == 0) continue;
      part.nodes.push_back(n);
      const Node& node = nodes_[n];
      const int operands = operand_count(node);
      const bool is_wave = node.op == Op::kSin || node.op == Op::kCos;
      const std::size_t d = node.op == Op::kVariable ? dimension_[n]
                            : is_wave                ? dimension_of_angle(node.left)
                                                     : kNone;
      if (d != kNone && std::find(part.dimensions.begin(), part.dimensions.end(), d) == part.dimensions.end())
        part.dimensions.push_back(d);
      if (is_wave && d != kNone) continue;
      if (operands >= 1) needed[node.left] = 1;
      if (operands == 2) needed[node.right] = 1;
    }
    std::reverse(part.nodes.begin(), part.nodes.end());
    return part;
  }

  void evaluate(const Part& part) {
    for (const std::size_t n : part.nodes) values_[n] = value(n);
  }

  double side_of(std::size_t d) const {
    const Interval side = dimensions_[d].side;
    if (dimensions_[d].is_angle) return side.width() / kTurn.high;
    return side.width() / std::max(1.0, std::min(std::fabs(side.low), std::fabs(side.high)));
  }

  /// In the middle, or as far again as the nearer end where the other one is much farther.
  static double divided_at(Interval side) {
    if (side.low < 0 && side.high > 0) return 0;
    if (side.low >= 0 && side.high > 4 * std::max(side.low, 1.0)) return 2 * std::max(side.low, 1.0);
    if (side.high <= 0 && side.low < 4 * std::min(side.high, -1.0)) return 2 * std::min(side.high, -1.0);
    return side.middle();
  }

  /// By dividing the box wherever there may be one, until there is none, or the box is small.
  std::optional<HiddenKink> possible(std::size_t i, HiddenKink::Kind kind) {
    const Part part = part_of(i);
    const std::vector<Dimension> whole = dimensions_;
    std::vector<std::vector<Dimension>> boxes = {whole};
    std::optional<HiddenKink> found;
    for (std::size_t taken = 0; !boxes.empty() && !found;) {
      dimensions_ = std::move(boxes.back());
      boxes.pop_back();
      evaluate(part);
      taken += part.nodes.size();
      if (!is_suspect(i)) continue;
      const auto widest =
          std::max_element(part.dimensions.begin(), part.dimensions.end(),
                           [&](std::size_t a, std::size_t b) { return side_of(a) < side_of(b); });
      if (side_of(*widest) < kLeastSide || taken > kMostValues) {
        found = HiddenKink{kind, time_in(part)};
        break;
      }
      Interval& side = dimensions_[*widest].side;
      const Interval both = side;
      const double at = divided_at(both);
      side = {at, both.high};
      boxes.push_back(dimensions_);
      side = {both.low, at};
      boxes.push_back(dimensions_);
    }
    dimensions_ = whole;
    evaluate(part);
    return found;
  }

  /// Where the time is all that it depends on.
  std::optional<double> time_in(const Part& part) const {
    if (part.dimensions.size() != 1 || dimensions_[part.dimensions[0]].is_angle) return {};
    const Dimension& only = dimensions_[part.dimensions[0]];
    if (nodes_[only.node].variable.kind != Variable::Kind::kTime || side_of(part.dimensions[0]) >= kLeastSide)
      return {};
    return only.side.middle();
  }

  /// The root of a square, or of what has one variable and touches zero.
  bool is_certain(std::size_t i) const {
    const Node& node = nodes_[i];
    if (!is_suspect(i)) return false;
    if (has_square(node.left)) return true;
    const Interval a = values_[node.left];
    return part_of(node.left).dimensions.size() == 1 && a.low >= -kRounding * std::min(a.high, 1.0);
  }

  /// A factor is a square of what may be zero.
  bool has_square(std::size_t i) const {
    const Node& node = nodes_[i];
    if (is_moved_[i] == 0) return false;
    const bool may_be_zero = operand_count(node) > 0 && values_[node.left].contains(0);
    if (node.op == Op::kPower && node.exponent > 0)
      return (node.exponent % 2 == 0 && may_be_zero) || has_square(node.left);
    if (node.op == Op::kMultiply && node.left == node.right) return may_be_zero;
    if (node.op == Op::kMultiply) return has_square(node.left) || has_square(node.right);
    return node.op == Op::kDivide && has_square(node.left);
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  const Nodes& nodes_;
  std::span<const double> parameters_;
  bool states_are_given_;
  std::vector<char> is_moved_,
      is_given_;  ///< by node: by a variable; by such alone as have any value at some time
  std::vector<std::size_t> dimension_;  ///< by node, of variables
  std::vector<Dimension> dimensions_;
  std::vector<Interval> values_;  ///< by node, over the dimensions
};

}  // namespace

std::optional<HiddenKink> hidden_kink(const Expression& expression, std::span<const double> parameters,
                                      bool states_are_given) {
  return Search(expression.nodes(), parameters, states_are_given).run();
}

std::string in_words(const HiddenKink& kink) {
  return std::string(facts_of(kink.kind).words) +
         (kink.time ? fmt::format(", near t = {:.4g} s", *kink.time) : "");
}

std::string hint_of(const HiddenKink& kink) { return std::string(facts_of(kink.kind).hint); }

}  // namespace jourdain::model
