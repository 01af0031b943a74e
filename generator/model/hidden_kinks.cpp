#include "model/hidden_kinks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

#include "model/expression_nodes.hpp"
#include "model/expression_ranges.hpp"

namespace jourdain::model {

namespace {

using support::Function;
using support::Interval;
using Op = Expression::Op;
using Node = Expression::Node;
using Hidden = HiddenKink::Kind;

/// Nothing is proven beyond: s, thirty years; of what else moves in SI units.
constexpr double kMostTime = 1e9, kMostValue = 1e30;
/// How far beside a small box values are looked at, of 1 or of where it is.
constexpr double kNearby = 1e-3;
/// Below zero by less than this a value may be zero, and rounded.
constexpr double kRounding = 1e-12;

struct Facts {
  std::string_view words, hint;
};

constexpr Facts facts_of(Hidden kind) {
  switch (kind) {
    case Hidden::kRoot:
      return {"a root of what may be zero", "sqrt(x^2 + w^2), with a small width w, has no kink"};
    case Hidden::kQuotient:
      return {"a divisor may be zero",
              "at some time from 0 on, or where states are there: keep it away from zero"};
    case Hidden::kLogarithm:
      return {"the logarithm of what may be zero", "at some time from 0 on, or where states are there"};
    case Hidden::kAngle:
      break;
  }
  return {"an angle may jump by a turn",
          "what goes round: write what grows with it, plus an angle that does not go round"};
}

bool is_whole(Interval a) { return a.low == a.high && a.low == std::floor(a.low); }

std::optional<Hidden> hidden_kind_of(const Node& node) {
  if (node.op == Op::kSqrt) return Hidden::kRoot;
  if (node.op == Op::kDivide || (node.op == Op::kPower && node.exponent < 0)) return Hidden::kQuotient;
  if (node.op != Op::kFunction) return {};
  if (node.function == Function::kPower) return Hidden::kRoot;
  if (node.function == Function::kLog) return Hidden::kLogarithm;
  if (node.function == Function::kAtan2) return Hidden::kAngle;
  return {};
}

class Search {
 public:
  using Part = ExpressionEnclosure::Part;

  Search(const Expression& expression, const ExpressionRanges& ranges)
      : enclosure_(expression, ranges), nodes_(expression.nodes()) {}

  /// Of variables for which `is_given` holds all that may be, of others only what is sure.
  template <class IsGiven>
  std::optional<HiddenKink> run(const IsGiven& is_given) {
    std::vector<char> given;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      const int operands = operand_count(node);
      given.push_back(node.op == Op::kVariable ? is_given(node.variable)
                                               : (operands < 1 || given[node.left] != 0) &&
                                                     (operands < 2 || given[node.right] != 0));
      const std::optional<Hidden> kind = hidden_kind_of(node);
      if (!kind || !enclosure_.is_moved(i) || !is_suspect(i)) continue;
      std::optional<HiddenKink> kink;
      if (given[node.op == Op::kDivide ? node.right : i] != 0)
        kink = found_before_end(i);
      else if (*kind == Hidden::kRoot && has_square(node.left))
        kink = HiddenKink{*kind};
      else if (enclosure_.part_of(i).dimensions.size() == 1)
        kink = found(i, [&](const Part& part, bool is_small) { return is_small && is_certain(i, part); });
      if (kink) return kink;
    }
    return {};
  }

  /// The first one, of any variables, but angles and, unless they are asked for, roots.
  std::optional<HiddenKink> undefined(bool with_roots) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::optional<Hidden> kind = hidden_kind_of(nodes_[i]);
      if (!kind || *kind == Hidden::kAngle || (*kind == Hidden::kRoot && !with_roots)) continue;
      if (!is_suspect(i)) continue;
      if (!enclosure_.is_moved(i)) return HiddenKink{*kind};
      if (const auto kink = found(i, [](const Part&, bool) { return true; })) return kink;
    }
    return {};
  }

 private:
  /// Whether the operands, in the box that was evaluated last, may be where the operation has no derivative.
  bool is_suspect(std::size_t i) const {
    const Node& node = nodes_[i];
    const Interval a = enclosure_.value(node.left);
    switch (*hidden_kind_of(node)) {
      case Hidden::kRoot: {
        if (node.op == Op::kSqrt) return a.low <= 0;
        const Interval b = enclosure_.value(node.right);
        return a.low <= 0 && !(is_whole(b) && b.low >= 0) && !(a.low >= -kRounding && b.low >= 2);
      }
      case Hidden::kQuotient:
        return (node.op == Op::kDivide ? enclosure_.value(node.right) : a).contains(0);
      case Hidden::kLogarithm:
        return a.low <= 0;
      case Hidden::kAngle:
        return a.contains(0) && enclosure_.value(node.right).low <= 0;
    }
    return true;
  }

  template <class IsOne>
  std::optional<HiddenKink> found(std::size_t i, const IsOne& is_one) {
    const Part part = enclosure_.part_of(i);
    HiddenKink kink{*hidden_kind_of(nodes_[i])};
    const bool is_found = enclosure_.any(
        part, [&] { return is_suspect(i); },
        [&](bool is_small) {
          kink.time = is_small ? time_in(part) : std::nullopt;
          return is_one(part, is_small);
        });
    return is_found ? std::optional(kink) : std::nullopt;
  }

  /// Nothing where what is first found, as boxes of earlier times come first, is the end: no value is real from there
  /// on, which no run passes in silence.
  std::optional<HiddenKink> found_before_end(std::size_t i) {
    bool ends = false;
    const std::optional<HiddenKink> kink = found(i, [&](const Part& part, bool is_small) {
      ends = is_small && ends_behind(i, part);
      return true;
    });
    return ends ? std::nullopt : kink;
  }

  /// Whether a root or a logarithm is of negative numbers at all later times than those of the box evaluated last.
  bool ends_behind(std::size_t i, const Part& part) {
    const Hidden kind = *hidden_kind_of(nodes_[i]);
    if ((kind != Hidden::kRoot && kind != Hidden::kLogarithm) || !time_in(part)) return false;
    Interval& side = enclosure_.dimension(part.dimensions[0]).side;
    const Interval box = side;
    side = {box.high + kNearby * std::max(1.0, box.high), kMostTime};
    enclosure_.evaluate(part);
    const bool is_negative = enclosure_.value(nodes_[i].left).high < 0;
    side = box;
    enclosure_.evaluate(part);
    return is_negative;
  }

  /// Where the time is all that it depends on.
  std::optional<double> time_in(const Part& part) const {
    if (part.dimensions.size() != 1) return {};
    const ExpressionEnclosure::Dimension& only = enclosure_.dimension(part.dimensions[0]);
    const Node& node = nodes_[only.node];
    if (only.is_angle || node.op != Op::kVariable || node.variable.kind != Variable::Kind::kTime) return {};
    return only.side.middle();
  }

  /// Whether what has one dimension has one in the small box that was evaluated last: what is beside it is on either
  /// side of it, and has values there.
  bool is_certain(std::size_t i, const Part& part) {
    const Node& node = nodes_[i];
    const Hidden kind = *hidden_kind_of(node);
    if (kind == Hidden::kQuotient) return is_hidden_pole(i, part);
    const bool is_behind = kind == Hidden::kAngle && enclosure_.value(node.right).high < 0;
    Interval& side = enclosure_.dimension(part.dimensions[0]).side;
    const Interval box = side;
    const double away = kNearby * std::max(1.0, std::fabs(box.middle()));
    const auto at = [&](double x) {
      side = Interval::point(x);
      enclosure_.evaluate(part);
      return enclosure_.value(node.left);
    };
    const Interval before = at(box.low - away), behind = at(box.high + away);
    side = box;
    enclosure_.evaluate(part);
    if (kind == Hidden::kAngle)
      return is_behind && ((before.high < 0 && behind.low > 0) || (before.low > 0 && behind.high < 0));
    return before.low > 0 && behind.low > 0;
  }

  /// What follows from the pole is bounded, as of atan(1/x).
  bool is_hidden_pole(std::size_t i, const Part& part) {
    std::vector<char> follows(nodes_.size());
    follows[i] = 1;
    for (std::size_t n = i + 1; n < nodes_.size(); ++n) {
      const Node& node = nodes_[n];
      const int operands = operand_count(node);
      follows[n] = (operands >= 1 && follows[node.left] != 0) || (operands == 2 && follows[node.right] != 0);
      const bool may_be_bounded = node.op == Op::kSin || node.op == Op::kCos || node.op == Op::kFunction;
      if (follows[n] == 0 || !may_be_bounded) continue;
      const Part of_it = enclosure_.part_of(n);
      if (of_it.dimensions != part.dimensions) continue;
      enclosure_.evaluate(of_it);
      if (std::isfinite(enclosure_.value(n).width())) return true;
    }
    return false;
  }

  /// A factor is a square of what may be zero.
  bool has_square(std::size_t i) const {
    const Node& node = nodes_[i];
    if (!enclosure_.is_moved(i)) return false;
    const bool may_be_zero = operand_count(node) > 0 && enclosure_.value(node.left).contains(0);
    if (node.op == Op::kPower && node.exponent > 0)
      return (node.exponent % 2 == 0 && may_be_zero) || has_square(node.left);
    if (node.op == Op::kMultiply && node.left == node.right) return may_be_zero;
    if (node.op == Op::kMultiply) return has_square(node.left) || has_square(node.right);
    return node.op == Op::kDivide && has_square(node.left);
  }

  ExpressionEnclosure enclosure_;
  const std::vector<Node>& nodes_;
};

}  // namespace

Interval widest_range(const Variable& variable) {
  if (variable.kind == Variable::Kind::kTime) return {0, kMostTime};
  if (variable.kind == Variable::Kind::kFrameDirection) return {-1, 1};
  return {-kMostValue, kMostValue};
}

std::optional<HiddenKink> hidden_kink(const Expression& expression, std::span<const double> parameters) {
  ExpressionRanges ranges{{}, widest_range};
  for (const double value : parameters) ranges.parameters.push_back(Interval::point(value));
  return Search(expression, ranges).run([](const Variable& variable) {
    using Of = Variable::Kind;
    return variable.kind == Of::kTime || variable.kind == Of::kInput || variable.kind == Of::kState;
  });
}

std::optional<HiddenKink> undefined_part(const Expression& expression, const ExpressionRanges& ranges,
                                         bool with_roots) {
  return Search(expression, ranges).undefined(with_roots);
}

std::string in_words(const HiddenKink& kink) {
  return std::string(facts_of(kink.kind).words) +
         (kink.time ? fmt::format(", near t = {:.4g} s", *kink.time) : "");
}

std::string hint_of(const HiddenKink& kink) { return std::string(facts_of(kink.kind).hint); }

}  // namespace jourdain::model
