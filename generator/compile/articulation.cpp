#include "compile/articulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "compile/program_cost.hpp"
#include "dynamics/absolute_rates.hpp"
#include "dynamics/link_equations.hpp"
#include "dynamics/scene.hpp"
#include "lowering/lower.hpp"

namespace jourdain {

using dynamics::PlanarForm;
using kinematics::kGround;

namespace {

/// Fewer coordinates than this always go without articulated bodies.
constexpr std::size_t kSmallScene = 5;
/// From this many on M is not factored as a whole even to be counted.
constexpr std::size_t kLargeScene = 64;
/// Errors up to that many units are rounding; another way's must be that much less, and its operations at most
/// so many times more.
constexpr double kFewUnits = 32, kMuchLess = 16;
constexpr std::size_t kMostMore = 2;
/// Depths in a row without a saving that end a search.
constexpr std::size_t kPatience = 3;

ir::Program lowered(const dynamics::Equations& equations) {
  std::vector<lowering::Target> targets;
  for (std::size_t i = 0; i < equations.zdot.size(); ++i)
    targets.push_back({"zdot", static_cast<int>(i), -1, equations.zdot[i]});
  return lowering::lower(equations.statements, targets, "zdot");
}

/// What a link's joint is, and which entries of its pose are not zero.
std::string shape_of(const kinematics::Link& link) {
  std::string shape(1, static_cast<char>('A' + static_cast<int>(link.kind)));
  for (const kinematics::Vector3& row : {link.R_PL[0], link.R_PL[1], link.R_PL[2], link.r_PL})
    for (const kinematics::Ex& entry : row.entries) shape += entry.is_zero() ? '0' : '1';
  return shape;
}

class Choice {
 public:
  Choice(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options)
      : mechanism_(mechanism), options_(options), ways_(mechanism, options.link_tree) {
    kinematics::Statements statements;
    const dynamics::Scene scene(mechanism, options.link_tree, statements);
    moves_in_planes_ = dynamics::moves_in_planes(scene);
    velocities_ = scene.layout.velocity_count();
    has_link_equations_ =
        velocities_ <= kMostLinkEquations && velocities_ > 0 && dynamics::has_link_equations(scene);
    for (const kinematics::Link& link : scene.tree.links) {
      const bool root = link.parent == kGround;
      depth_.push_back(root ? 0 : depth_[link.parent] + 1);
      parent_.push_back(link.parent);
      shape_.push_back(shape_of(link));
    }
    children_.resize(parent_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] != kGround) ++children_[parent_[i]];
  }

  Articulation choose() {
    Articulation result = choose_links();
    if (moves_in_planes_ && velocities_ < kLargeScene) keep(result, {none(), true});
    for (const Way& way : by_angles()) keep_cheaper(result, way);
    judge(result);
    return result;
  }

 private:
  struct Way {
    std::vector<bool> links;
    bool planar = false;
    PlanarForm form = PlanarForm::kWorkingFrames;

    bool operator==(const Way&) const = default;
    friend bool operator<(const Way& a, const Way& b) {
      return std::tie(a.planar, a.form, a.links) < std::tie(b.planar, b.form, b.links);
    }
  };

  static Way way_of(const Articulation& chosen) { return {chosen.links, chosen.planar, chosen.form}; }

  static void set(Articulation& chosen, const Way& way, std::size_t operations) {
    chosen.links = way.links;
    chosen.planar = way.planar;
    chosen.form = way.form;
    chosen.operations = operations;
  }

  std::vector<Way> by_angles() const {
    if (!has_link_equations_) return {};
    return {{none(), true, PlanarForm::kAngles}, {none(), true, PlanarForm::kAnglesToUnitRows}};
  }

  void keep_cheaper(Articulation& best, const Way& way) {
    if (cost(way).saves_on(cost(way_of(best)))) set(best, way, operations(way));
  }

  ProgramCost cost(const Way& way) { return cost_behind_passes(program(way)); }

  std::vector<bool> none() const { return std::vector<bool>(parent_.size(), false); }

  /// Takes another way where what the one of the fewest operations loses is more than rounding, and the
  /// other's much less.
  void judge(Articulation& best) {
    const ForwardError errors(mechanism_);
    best.error = best.fewest_error = errors.of(program(way_of(best)));
    if (best.error.units <= kFewUnits) return;
    std::vector<Way> ways = {{std::vector<bool>(parent_.size(), true), false}};
    if (velocities_ < kLargeScene) ways.push_back({none(), false});
    if (velocities_ < kLargeScene && moves_in_planes_) ways.push_back({none(), true});
    for (const Way& way : by_angles()) ways.push_back(way);
    const std::size_t fewest = best.operations;
    for (const Way& way : ways) {
      const ir::Program zdot = program(way);
      const std::size_t count = operations(way);
      const SampledError error = errors.of(zdot);
      if (count > kMostMore * fewest || !(error.units * kMuchLess < best.error.units)) continue;
      set(best, way, count);
      best.error = error;
    }
    best.spent = best.operations > fewest ? best.operations - fewest : 0;
  }

  Articulation choose_links() {
    Articulation result;
    result.links.assign(parent_.size(), velocities_ >= kLargeScene);
    result.operations = operations(result.links);
    if (velocities_ < kSmallScene) return result;
    const std::size_t deepest = *std::max_element(depth_.begin(), depth_.end()) + 1;
    result.articulated = operations(std::vector<bool>(parent_.size(), true));
    if (velocities_ >= kLargeScene) {
      search_inward(result, deepest);
      return result;
    }
    result.factorised = result.operations;
    std::size_t worse = 0;
    for (std::size_t depth = 1; depth <= deepest && worse < kPatience; ++depth)
      worse = keep(result, down_to(depth)) ? 0 : worse + 1;
    // A few articulated links may cost more than none where all cost less.
    if (keep(result, std::vector<bool>(parent_.size(), true))) search_inward(result, deepest);
    refine(result);
    return result;
  }

  void search_inward(Articulation& best, std::size_t deepest) {
    std::size_t worse = 0;
    for (std::size_t depth = deepest; depth-- > 0 && worse < kPatience;)
      worse = keep(best, down_to(depth)) ? 0 : worse + 1;
  }

  std::vector<bool> down_to(std::size_t depth) const {
    std::vector<bool> links;
    for (const std::size_t d : depth_) links.push_back(d < depth);
    return links;
  }

  bool keep(Articulation& best, const std::vector<bool>& links) { return keep(best, Way{links}); }

  bool keep(Articulation& best, const Way& way) {
    const std::size_t count = operations(way);
    if (count >= best.operations) return false;
    set(best, way, count);
    return true;
  }

  std::size_t operations(const std::vector<bool>& links) { return operations(Way{links}); }

  std::size_t operations(const Way& way) {
    if (const auto known = counted_.find(way); known != counted_.end()) return known->second;
    if (has_link_equations_) return counted_[way] = cost(way).arithmetic;
    ir::Program zdot = program(way);
    const std::size_t count = counted_[way] = ir::count_operations(zdot).arithmetic();
    if (!cheapest_ || count < counted_.at(cheapest_->first)) cheapest_ = {way, std::move(zdot)};
    return count;
  }

  /// Of the accelerations, before any pass.
  ir::Program program(const Way& way) {
    if (cheapest_ && cheapest_->first == way) return cheapest_->second;
    options_.articulated = way.links;
    options_.planar = way.planar;
    options_.planar_form = way.form;
    return lowered(ways_.by(options_));
  }

  /// First links of the branches: at the ground and where a link has several children.
  std::vector<std::size_t> branches() const {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] == kGround || children_[parent_[i]] > 1) first.push_back(i);
    return first;
  }

  bool is_in(std::size_t link, std::size_t branch) const {
    for (std::size_t i = link; i != kGround; i = parent_[i])
      if (i == branch) return true;
    return false;
  }

  /// One layer of links of a branch more (or less) articulated.
  std::vector<bool> changed(const std::vector<bool>& links, std::size_t branch, bool more) const {
    std::vector<bool> result = links;
    std::size_t deepest = 0;
    for (std::size_t i = 0; i < links.size(); ++i)
      if (links[i] && is_in(i, branch)) deepest = std::max(deepest, depth_[i]);
    for (std::size_t i = 0; i < links.size(); ++i) {
      if (!is_in(i, branch)) continue;
      const bool reachable = parent_[i] == kGround || links[parent_[i]];
      if (more && !links[i] && reachable) result[i] = true;
      if (!more && links[i] && depth_[i] == deepest) result[i] = false;
    }
    return result;
  }

  /// The links of a branch, what they are made of and which are articulated: of both legs of a robot the same.
  std::string look_of(std::size_t branch, const std::vector<bool>& links) const {
    std::string look;
    for (std::size_t i = branch; i < parent_.size(); ++i)
      if (is_in(i, branch)) look += fmt::format("{}{}{};", depth_[i], links[i] ? 'a' : 'm', shape_[i]);
    return look;
  }

  void refine(Articulation& best) {
    std::set<std::string> settled;  // looks of branches where no change saved anything
    for (const std::size_t branch : branches()) {
      const std::string look = look_of(branch, best.links);
      if (settled.contains(look)) continue;
      bool saved = false;
      for (const bool more : {true, false})
        while (keep(best, changed(best.links, branch, more))) saved = true;
      if (!saved) settled.insert(look);
    }
  }

  const model::Mechanism& mechanism_;
  dynamics::DerivationOptions options_;
  dynamics::AccelerationWays ways_;
  std::optional<std::pair<Way, ir::Program>> cheapest_;
  bool moves_in_planes_ = false, has_link_equations_ = false;
  std::size_t velocities_ = 0;
  std::vector<std::size_t> depth_, parent_, children_;
  std::vector<std::string> shape_;
  std::map<Way, std::size_t> counted_;
};

}  // namespace

Articulation choose_articulation(const model::Mechanism& mechanism,
                                 const dynamics::DerivationOptions& options) {
  return Choice(mechanism, options).choose();
}

ir::Program lower_accelerations(const model::Mechanism& mechanism,
                                const dynamics::DerivationOptions& options) {
  return lowered(dynamics::AccelerationWays(mechanism, options.link_tree).by(options));
}

std::string accuracy_sentence(const Articulation& articulation) {
  const auto text = [](const SampledError& error) {
    return fmt::format("{:.1g} units{}", error.units, error.where.empty() ? "" : " at " + error.where);
  };
  if (articulation.fewest_error.units <= kFewUnits) return "";
  if (articulation.error.units >= articulation.fewest_error.units)
    return fmt::format(
        "accelerations in double lose up to {} (of rounding of the largest; median of sampled states): no "
        "way of "
        "at most {} times the operations that was tried loses {} times less",
        text(articulation.error), kMostMore, kMuchLess);
  return fmt::format(
      "accelerations take {} operations more than the fewest (before passes), which lose up to {} where "
      "these lose {} "
      "(of rounding of the largest; median of sampled states)",
      articulation.spent, text(articulation.fewest_error), text(articulation.error));
}

}  // namespace jourdain
