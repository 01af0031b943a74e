// Enclosures of what an expression computes while its variables are anywhere in given ranges, over boxes that may be
// divided.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "model/expression.hpp"
#include "support/interval.hpp"

namespace jourdain::model {

/// Where values are looked for.
struct ExpressionRanges {
  std::vector<support::Interval> parameters;
  std::function<support::Interval(const Variable&)> variable;  ///< bounded
};

/// By node of one expression, which must outlive it. What sines and cosines are of, where that goes round, varies over
/// a turn by itself, and so does what begins anew with each period of a repeating table.
class ExpressionEnclosure {
 public:
  using Node = Expression::Node;

  /// What values follow from.
  struct Dimension {
    std::size_t node = 0;
    bool is_angle = false;  ///< whose sine or cosine is taken; otherwise the node's own value
    support::Interval side = {};
  };
  /// Of a node, those that it is computed from and itself, in order; the dimensions that it depends on.
  struct Part {
    std::vector<std::size_t> nodes, dimensions;
  };
  /// Values of nodes that one search may take.
  static constexpr std::size_t kMostValues = 2'000'000;

  ExpressionEnclosure(const Expression& expression, const ExpressionRanges& ranges);

  const std::vector<Node>& nodes() const { return nodes_; }
  /// Whether the node depends on a variable.
  bool is_moved(std::size_t i) const { return is_moved_[i]; }
  /// Over the box that was evaluated last.
  support::Interval value(std::size_t i) const { return values_[i]; }
  Part part_of(std::size_t i) const;
  void evaluate(const Part& part);
  void evaluate_all();
  Dimension& dimension(std::size_t d) { return dimensions_[d]; }
  const Dimension& dimension(std::size_t d) const { return dimensions_[d]; }
  /// Of a turn, of where it is, or of 1.
  double side_of(std::size_t d) const;

  /// Divides the box of `part` wherever `is_suspect()` holds of it, and calls `is_one(is_small)` where it is small, or
  /// where that has taken too long; true where one of these is, at once. Values are those of the whole box afterwards.
  template <class IsSuspect, class IsOne>
  bool any(const Part& part, const IsSuspect& is_suspect, const IsOne& is_one);

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  /// A box whose sides are this small is no longer divided.
  static constexpr double kLeastSide = 1e-5;

  void add(std::size_t i, const ExpressionRanges& ranges);
  std::optional<support::Interval> period_of(std::size_t i) const;
  std::size_t dimension_of_angle(std::size_t node) const;
  support::Interval angle(std::size_t node) const;
  support::Interval enclosed(std::size_t i) const;
  static double divided_at(support::Interval side);

  const std::vector<Node>& nodes_;
  std::vector<support::Interval> parameters_;
  std::vector<bool> is_moved_;
  std::vector<std::size_t> dimension_;  ///< by node
  std::vector<Dimension> dimensions_;
  std::vector<support::Interval> values_;  ///< by node
};

template <class IsSuspect, class IsOne>
bool ExpressionEnclosure::any(const Part& part, const IsSuspect& is_suspect, const IsOne& is_one) {
  const std::vector<Dimension> whole = dimensions_;
  std::vector<std::vector<Dimension>> boxes = {whole};
  bool found = false;
  for (std::size_t taken = 0; !boxes.empty() && !found && taken <= kMostValues;) {
    dimensions_ = std::move(boxes.back());
    boxes.pop_back();
    evaluate(part);
    taken += part.nodes.size();
    if (!is_suspect()) continue;
    const auto widest =
        std::max_element(part.dimensions.begin(), part.dimensions.end(),
                         [&](std::size_t a, std::size_t b) { return side_of(a) < side_of(b); });
    const bool is_small = side_of(*widest) < kLeastSide;
    if (is_small || taken > kMostValues) {
      found = is_one(is_small);
      continue;
    }
    support::Interval& side = dimensions_[*widest].side;
    const support::Interval both = side;
    const double at = divided_at(both);
    side = {at, both.high};
    boxes.push_back(dimensions_);
    side = {both.low, at};
    boxes.push_back(dimensions_);
  }
  dimensions_ = whole;
  evaluate_all();  // what is asked of a small box may have looked at more than its part
  return found;
}

}  // namespace jourdain::model
