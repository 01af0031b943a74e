#include "passes/lane_order.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <set>
#include <utility>

#include "support/check.hpp"

namespace jourdain::passes {

using ir::Node;
using ir::ValueId;

namespace {

class Ordering {
 public:
  Ordering(const ir::Program& program, const Groups& groups, const std::vector<LikeGroups>& bundles)
      : program_(program),
        groups_(groups),
        bundles_(bundles),
        values_(program.nodes.size()),
        unit_(values_),
        waits_(values_ + bundles.size()),
        exists_(values_ + bundles.size(), false),
        placed_(values_ + bundles.size(), false),
        users_(values_ + bundles.size()) {
    number_units();
    for (std::size_t unit = 0; unit < exists_.size(); ++unit)
      if (exists_[unit]) wait_for_operands(unit);
  }

  /// The bundles that are given up so that all else can be placed, by number.
  std::set<std::size_t> given_up() {
    std::set<std::size_t> list;
    for (place_what_is_ready(); waiting() < exists_.size(); place_what_is_ready()) {
      const std::size_t bundle = bundle_in_a_cycle();
      give_up(bundle);
      list.insert(bundle);
    }
    return list;
  }

  LaneOrder run() {
    place_what_is_ready();
    JD_CHECK(waiting() == exists_.size(), "bundles of '{}' wait for each other", program_.name);
    return {bundles_, std::move(unit_), std::move(order_)};
  }

 private:
  /// Values within the groups of bundles have no unit: nothing else reads them.
  void number_units() {
    for (std::size_t i = 0; i < values_; ++i)
      if (ir::operand_count(program_.nodes[i].op) > 0) unit_[i] = i;
    for (std::size_t p = 0; p < bundles_.size(); ++p)
      for (const LikeGroups::Lane& lane : bundles_[p].lanes) {
        for_each_within(lane.root, [this](ValueId value) { unit_[value.value].reset(); });
        unit_[lane.root.value] = values_ + p;
      }
    for (const std::optional<std::size_t>& unit : unit_)
      if (unit) exists_[*unit] = true;
  }

  void for_each_within(ValueId value, const std::function<void(ValueId)>& visit) const {
    const Node& node = program_[value];
    for (int k = 0; k < ir::operand_count(node.op); ++k) {
      const ValueId operand = k == 0 ? node.a : node.b;
      if (!groups_.is_within(operand)) continue;
      visit(operand);
      for_each_within(operand, visit);
    }
  }

  std::vector<std::size_t> needed(std::size_t unit) const {
    std::vector<std::size_t> list;
    const auto add = [&](ValueId value) {
      if (unit_[value.value]) list.push_back(*unit_[value.value]);
    };
    if (unit >= values_) {
      for (const LikeGroups::Lane& lane : bundles_[unit - values_].lanes)
        for (const Term& term : lane.terms) add(term.value);
    } else {
      const Node& node = program_.nodes[unit];
      if (ir::operand_count(node.op) >= 1) add(node.a);
      if (ir::operand_count(node.op) == 2) add(node.b);
    }
    return list;
  }

  void wait_for_operands(std::size_t unit) {
    waits_[unit] = 0;
    for (const std::size_t operand : needed(unit)) {
      if (placed_[operand]) continue;
      ++waits_[unit];
      users_[operand].push_back(unit);
    }
    if (waits_[unit] == 0) make_ready(unit);
  }

  void make_ready(std::size_t unit) {
    ready_.emplace(unit < values_ ? unit : bundles_[unit - values_].lanes[0].root.value, unit);
  }

  void place_what_is_ready() {
    while (!ready_.empty()) {
      const std::size_t unit = ready_.top().second;
      ready_.pop();
      order_.push_back(unit);
      placed_[unit] = true;
      for (const std::size_t user : users_[unit])
        if (exists_[user] && --waits_[user] == 0) make_ready(user);
    }
  }

  /// The first unit that is not placed, or their number.
  std::size_t waiting() {
    while (first_ < exists_.size() && (!exists_[first_] || placed_[first_])) ++first_;
    return first_;
  }

  /// Reached by going from operand to operand.
  std::size_t bundle_in_a_cycle() {
    std::set<std::size_t> passed;
    std::size_t unit = waiting();
    std::vector<std::size_t> way;
    while (passed.insert(unit).second) {
      way.push_back(unit);
      for (const std::size_t operand : needed(unit))
        if (!placed_[operand]) {
          unit = operand;
          break;
        }
    }
    const auto bundle = std::find_if(std::find(way.begin(), way.end(), unit), way.end(),
                                     [this](std::size_t u) { return u >= values_; });
    JD_CHECK(bundle != way.end(), "a value of '{}' needs itself", program_.name);
    return *bundle - values_;
  }

  /// Each of its operations becomes a unit of its own; who waits for it waits for its lane.
  void give_up(std::size_t bundle) {
    const std::size_t unit = values_ + bundle;
    exists_[unit] = false;
    std::vector<std::size_t> restored;
    const auto restore = [&](ValueId value) {
      unit_[value.value] = value.value;
      exists_[value.value] = true;
      restored.push_back(value.value);
      first_ = std::min<std::size_t>(first_, value.value);
    };
    for (const LikeGroups::Lane& lane : bundles_[bundle].lanes) {
      restore(lane.root);
      for_each_within(lane.root, restore);
    }
    std::vector<std::size_t> users = std::move(users_[unit]);
    std::sort(users.begin(), users.end());
    users.erase(std::unique(users.begin(), users.end()), users.end());
    for (const std::size_t user : users) {
      if (!exists_[user]) continue;
      for (const std::size_t operand : needed(user))
        if (std::find(restored.begin(), restored.end(), operand) != restored.end())
          users_[operand].push_back(user);
    }
    for (const std::size_t value : restored) wait_for_operands(value);
  }

  const ir::Program& program_;
  const Groups& groups_;
  const std::vector<LikeGroups>& bundles_;
  const std::size_t values_;
  std::vector<std::optional<std::size_t>> unit_;
  std::vector<std::size_t>
      waits_;  ///< for how many operands that are not placed, each as often as it is read
  std::vector<bool> exists_, placed_;
  std::vector<std::vector<std::size_t>> users_;
  using Entry = std::pair<std::size_t, std::size_t>;  ///< where it stands in the program, and the unit
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready_;
  std::size_t first_ = 0;
  std::vector<std::size_t> order_;
};

}  // namespace

LaneOrder order_in_lanes(const ir::Program& program, const Groups& groups, std::vector<LikeGroups> bundles) {
  const std::set<std::size_t> given_up = Ordering(program, groups, bundles).given_up();
  std::vector<LikeGroups> kept;
  for (std::size_t p = 0; p < bundles.size(); ++p)
    if (given_up.count(p) == 0) kept.push_back(std::move(bundles[p]));
  return Ordering(program, groups, kept).run();
}

}  // namespace jourdain::passes
