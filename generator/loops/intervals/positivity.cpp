#include "loops/intervals/positivity.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ir/jacobian.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::IntervalResults;
using ir::LeafValues;
using ir::Program;
using support::Interval;

namespace {

/// Parts of the effort after which bounds need not be sharp any more.
constexpr std::size_t kSharpShare = 10;
/// Interval operations that one proof may take: a large program is looked at on fewer boxes.
constexpr std::size_t kOperations = 500'000'000;

struct Box {
  std::vector<Interval> sides;
  std::vector<int> halvings;
};

class Proof {
 public:
  Proof(const ir::Builder& builder, const std::vector<Bound>& bounds, const Region& region, Effort effort)
      : bounds_(bounds),
        region_(region),
        effort_(effort),
        least_(bounds.size(), INFINITY),
        seen_(least_),
        variation_(bounds.size(), std::vector<double>(region.entries.size(), 0)) {
    std::vector<ir::Signed> values;
    for (const Bound& bound : bounds) values.push_back(bound.value);
    ir::Builder plain = builder;
    for (const ir::Signed value : values) plain.output("f", -1, -1, value);
    values_ = passes::remove_dead_code(plain.finish("values"));
    const ir::Operations count = ir::count_operations(values_);
    is_smooth_ = count.atan2 == 0 && count.selections == 0;
    ir::Builder slopes = builder;
    std::vector<ir::Seed> seeds;
    for (std::size_t k = 0; k < region.entries.size(); ++k)
      seeds.push_back({slopes.leaf(region.entries[k].kind, region.entries[k].index), k, slopes.literal(1)});
    for (const auto& [at, value] : ir::differentiate(slopes, values, seeds, {}))
      slopes.output("f_y", static_cast<int>(at.first), static_cast<int>(at.second), value);
    slopes_ = passes::remove_dead_code(slopes.finish("slopes"));
    const std::size_t each = 2 * values_.nodes.size() + slopes_.nodes.size();
    effort_.boxes = std::min(effort_.boxes, kOperations / std::max<std::size_t>(each, 1));
  }

  std::variant<std::vector<double>, Counterexample> run() {
    Box whole;
    for (const Variable& entry : region_.entries) {
      whole.sides.push_back(region_.leaves[entry.kind][entry.index]);
      whole.halvings.push_back(0);
    }
    std::vector<Box> open = {whole};
    for (std::size_t count = 0; !open.empty(); ++count) {
      const Box box = open.back();
      open.pop_back();
      std::optional<std::size_t> undecided;
      const std::vector<double> lows = lower_bounds(box);
      if (violation_) return *violation_;
      for (std::size_t j = 0; j < bounds_.size() && !undecided; ++j)
        if (!is_enough(j, lows[j], count)) undecided = j;
      if (!undecided) {
        for (std::size_t j = 0; j < bounds_.size(); ++j) least_[j] = std::min(least_[j], lows[j]);
        continue;
      }
      const std::optional<std::size_t> side = widest(box, *undecided);
      if (!side || count >= effort_.boxes) return Counterexample{*undecided, middle(box), false};
      for (const bool upper : {true, false}) open.push_back(half(box, *side, upper));
    }
    return least_;
  }

 private:
  bool is_enough(std::size_t j, double low, std::size_t count) const {
    return low > bounds_[j].least &&
           (!effort_.is_sharp || count > effort_.boxes / kSharpShare || low >= seen_[j] / 2);
  }

  static std::vector<double> middle(const Box& box) {
    std::vector<double> point;
    for (const Interval side : box.sides) point.push_back(side.middle());
    return point;
  }

  /// Of the sides that were not halved too often the one over which the bound's value varies most, as far as
  /// slopes tell; otherwise the one that was halved least.
  std::optional<std::size_t> widest(const Box& box, std::size_t bound) const {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < box.halvings.size(); ++k) {
      if (box.halvings[k] >= effort_.halvings) continue;
      const auto rank = [&](std::size_t side) {
        return std::pair(variation_[bound][side], -box.halvings[side]);
      };
      if (!best || rank(k) > rank(*best)) best = k;
    }
    return best;
  }

  static Box half(Box box, std::size_t side, bool upper) {
    (upper ? box.sides[side].low : box.sides[side].high) = box.sides[side].middle();
    ++box.halvings[side];
    return box;
  }

  IntervalResults over(const Program& program, const std::vector<Interval>& sides) const {
    LeafValues<Interval> leaves = region_.leaves;
    for (std::size_t k = 0; k < sides.size(); ++k)
      leaves[region_.entries[k].kind][region_.entries[k].index] = sides[k];
    return ir::interpret_interval(program, leaves);
  }

  /// Of each value over the box; −∞ where it may not exist. Sets `violation_` where the middle of the box
  /// refutes the bound.
  std::vector<double> lower_bounds(const Box& box) {
    std::vector<Interval> point;
    for (const double x : middle(box)) point.push_back(Interval::point(x));
    const IntervalResults natural = over(values_, box.sides), central = over(values_, point);
    std::vector<double> lows(bounds_.size(), -INFINITY);
    for (std::size_t j = 0; j < bounds_.size(); ++j) {
      if (!central.maybe_undefined[j]) {
        seen_[j] = std::min(seen_[j], central.values[j].high);
        if (central.values[j].high <= bounds_[j].least && !violation_)
          violation_ = Counterexample{j, middle(box), true};
      }
      if (!natural.maybe_undefined[j]) lows[j] = natural.values[j].low;
    }
    if (is_smooth_) raise_by_slopes(box, point, natural, central, lows);
    return lows;
  }

  /// Mean-value form where the natural enclosure is defined.
  void raise_by_slopes(const Box& box, const std::vector<Interval>& point, const IntervalResults& natural,
                       const IntervalResults& central, std::vector<double>& lows) {
    for (std::vector<double>& sides : variation_) std::fill(sides.begin(), sides.end(), 0);
    std::vector<Interval> enclosure = central.values;
    std::vector<bool> usable(bounds_.size());
    for (std::size_t j = 0; j < bounds_.size(); ++j) usable[j] = !natural.maybe_undefined[j];
    const IntervalResults slopes = over(slopes_, box.sides);
    for (std::size_t i = 0; i < slopes.values.size(); ++i) {
      const auto j = static_cast<std::size_t>(slopes_.outputs[i].row),
                 k = static_cast<std::size_t>(slopes_.outputs[i].column);
      if (slopes.maybe_undefined[i]) usable[j] = false;
      const Interval share = slopes.values[i] * (box.sides[k] - point[k]);
      enclosure[j] = enclosure[j] + share;
      variation_[j][k] = std::isfinite(share.width()) ? share.width() : 0;
    }
    for (std::size_t j = 0; j < bounds_.size(); ++j)
      if (usable[j])
        lows[j] = std::max(lows[j], enclosure[j].low);
      else
        std::fill(variation_[j].begin(), variation_[j].end(), 0);
  }

  const std::vector<Bound>& bounds_;
  const Region& region_;
  Effort effort_;
  Program values_, slopes_;
  bool is_smooth_ = true;                       ///< what may jump has no mean-value form
  std::vector<double> least_;                   ///< lower bounds over the boxes that are decided
  std::vector<double> seen_;                    ///< least values at middles
  std::vector<std::vector<double>> variation_;  ///< of each value over each side of the last box; 0: unknown
  std::optional<Counterexample> violation_;
};

}  // namespace

std::variant<std::vector<double>, Counterexample> prove_bounds(const ir::Builder& builder,
                                                               const std::vector<Bound>& bounds,
                                                               const Region& region, Effort effort) {
  return Proof(builder, bounds, region, effort).run();
}

}  // namespace jourdain::loops
