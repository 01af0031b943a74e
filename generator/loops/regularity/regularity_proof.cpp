#include "loops/regularity/regularity_proof.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loops/closed_form/position_request.hpp"
#include "loops/intervals/subdivision.hpp"
#include "loops/regularity/block_bounds.hpp"
#include "loops/regularity/regularity_layout.hpp"
#include "loops/rows/timeless.hpp"
#include "model/angular_entries.hpp"
#include "reference/decompositions.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using Eigen::VectorXd;

namespace {

using support::at;

constexpr double kPi = std::numbers::pi;
/// Of the dependent blocks: beyond it a configuration counts as singular. Of a pin 1e-3 rad from a dead position.
constexpr double kLeastMargin = 1e-3;
/// While this share of the effort is not used up, margins are proven to half of what is seen.
constexpr std::size_t kSharpShare = 10;
constexpr int kHalvings = 28;  ///< of one side
constexpr int kMostTurns = 4;  ///< of an angle until the others are where they were
/// A margin below this where a proof ends: the reason is a singular configuration nearby.
constexpr double kNearlySingular = 0.03;
constexpr double kCircleSlack = 1e-9;

/// A solution at a point on the branch: the only one in a small box.
struct Anchor {
  VectorXd p, x;
  Intervals X;
};

/// A part that the branch enters.
struct Open {
  std::size_t part = 0;
  Anchor anchor;
};

class Proof {
 public:
  explicit Proof(const RegularityRequest& request) : request_(request) {}

  std::variant<RegularityProof, std::string> run() {
    auto layout = lay_out(request_);
    if (auto* failure = std::get_if<std::string>(&layout)) return std::move(*failure);
    layout_ = std::move(std::get<RegularityLayout>(layout));
    std::vector<int> turns(layout_.free.size(), 1);
    for (;;) {
      set_circles(turns);
      BlockBounds bounds(layout_.problem, *layout_.equations, layout_.start, start_p());
      bounds_ = &bounds;
      seen_ = 1;
      proven_ = 0;
      if (std::string failure = follow(); !failure.empty()) return failure;
      const std::optional<std::size_t> open = open_circle();
      if (!open) return result(bounds);
      if (++turns[*open] > kMostTurns)
        return fmt::format("the dependent coordinates are not where they were after {} turns of {}",
                           kMostTurns, layout_.free[*open].name);
    }
  }

 private:
  void set_circles(const std::vector<int>& turns) {
    for (std::size_t k = 0; k < layout_.free.size(); ++k)
      if (layout_.free[k].is_circle) {
        const double half = turns[k] * kPi + kCircleSlack;
        layout_.free[k].side = {layout_.free[k].start - half, layout_.free[k].start + half};
      }
  }

  VectorXd start_p() const {
    VectorXd p(at(layout_.free.size()));
    for (std::size_t k = 0; k < layout_.free.size(); ++k) p[at(k)] = layout_.free[k].start;
    return p;
  }

  /// Follows the branch over all of the region. Otherwise where it ends.
  std::string follow() {
    const std::optional<Anchor> start = anchor(start_p(), layout_.start);
    if (!start) return "the initial state is singular";
    for (std::size_t i = 0; i < layout_.unknowns.size(); ++i)
      if (std::fabs(start->x[at(i)] - layout_.start[at(i)]) > kAssembled)
        return "the initial state does not close the loops";
    region_.emplace(whole());
    worst_ = start->p;
    open_ = {{0, *start}};
    while (!open_.empty()) {
      const Open next = std::move(open_.back());
      open_.pop_back();
      std::string end = prove(region_->at(next.anchor.p, next.part), next.anchor);
      if (!end.empty()) return end;
    }
    return "";
  }

  Intervals whole() const {
    Intervals sides;
    for (const FreeVariable& f : layout_.free) sides.push_back(f.side);
    return sides;
  }

  std::optional<Anchor> anchor(const VectorXd& p, const VectorXd& near) const {
    Intervals point;
    for (const double value : p) point.push_back(Interval::point(value));
    const std::optional<Branch> branch = enclose_branch(*layout_.equations, point, near);
    if (!branch) return {};
    return Anchor{p, branch->x, branch->over(point)};
  }

  /// The branch through `known` over a part and on to its neighbours, or over half of the part.
  std::string prove(std::size_t index, const Anchor& known) {
    if (const std::optional<Branch>& there = (*region_)[index].branch)
      return is_on(*there, known) ? "" : fmt::format("not decided near {}", text(known.p));
    if (++boxes_ > request_.effort)
      return fmt::format("not decided within {} boxes; nearest to singular near {}", request_.effort,
                         text(worst_));
    if (prove_whole(index, known)) return meet_neighbours(index);
    const std::optional<std::size_t> side = longest((*region_)[index]);
    if (!side) return failure(known);
    region_->halve(index, *side);
    for (const std::size_t half : (*region_)[index].halves)
      if (std::string end = reach(half); !end.empty()) return end;
    open_.push_back({index, known});
    return "";
  }

  bool prove_whole(std::size_t index, const Anchor& known) {
    const Intervals& P = (*region_)[index].P;
    slope_ = slope_at(known);
    std::optional<Branch> branch =
        enclose_branch(*layout_.equations, P, known.x + slope_ * (middle(P) - known.p));
    if (!branch || !is_on(*branch, known)) return false;
    look_at(*branch);
    const bool sharp = boxes_ <= request_.effort / kSharpShare;
    if (!bounds_->include(*branch, sharp ? std::max(kLeastMargin, seen_ / 2) : kLeastMargin)) return false;
    (*region_)[index].branch = std::move(branch);
    ++proven_;
    return true;
  }

  void look_at(const Branch& branch) {
    const double margin = bounds_->margin_near(branch.x, branch.centre);
    if (margin > seen_) return;
    seen_ = margin;
    worst_ = branch.centre;
  }

  /// The branch must go on into every part that it enters, and agree with those that are proven: if it does so
  /// at one point of a shared face it does on all of that, as both are continuous and regular.
  std::string meet_neighbours(std::size_t index) {
    const Branch& branch = *(*region_)[index].branch;
    for (const std::size_t other : region_->touching(branch.P)) {
      const Part& part = (*region_)[other];
      const bool met = enters(branch, part.P) || (part.branch && enters(*part.branch, branch.P));
      if (other == index || !met) continue;
      const VectorXd p = middle(intersection(branch.P, part.P));
      const std::optional<Anchor> shared = anchor_on(branch, p);
      if (!shared || (part.branch && !is_on(*part.branch, *shared)))
        return fmt::format("not decided near {}", text(p));
      if (!part.branch) open_.push_back({other, *shared});
    }
    return "";
  }

  /// A part that is not proven yet is entered from a neighbour that is.
  std::string reach(std::size_t index) {
    const Intervals& P = (*region_)[index].P;
    for (const std::size_t other : region_->touching(P)) {
      const std::optional<Branch>& branch = (*region_)[other].branch;
      if (!branch || !enters(*branch, P)) continue;
      const VectorXd p = middle(intersection(branch->P, P));
      const std::optional<Anchor> shared = anchor_on(*branch, p);
      if (!shared) return fmt::format("not decided near {}", text(p));
      open_.push_back({index, *shared});
      return "";
    }
    return "";
  }

  /// May all dependents be within their ranges somewhere where the branch's box meets P?
  bool enters(const Branch& branch, const Intervals& P) const {
    const Intervals X = branch.over(intersection(branch.P, P));
    for (std::size_t i = 0; i < X.size(); ++i)
      if (const Range& range = request_.range[layout_.unknowns[i]])
        if (X[i].high < (*range)[0] || X[i].low > (*range)[1]) return false;
    return true;
  }

  /// Is that solution on the branch? `there.p` is in the branch's box.
  static bool is_on(const Branch& branch, const Anchor& there) {
    Intervals point;
    for (const double value : there.p) point.push_back(Interval::point(value));
    return is_inside(there.X, branch.over(point));
  }

  /// The branch of a proven part at a point of its box.
  std::optional<Anchor> anchor_on(const Branch& branch, const VectorXd& p) const {
    std::optional<Anchor> found = anchor(p, branch.guess(p));
    return found && is_on(branch, *found) ? found : std::nullopt;
  }

  Eigen::MatrixXd slope_at(const Anchor& known) const {
    if (known.p.size() == 0) return {known.x.size(), 0};
    const Eigen::MatrixXd slopes = layout_.equations->slopes(known.x, known.p);
    return -reference::solved_by_lu<double>(slopes.leftCols(known.x.size()),
                                            Eigen::MatrixXd(slopes.rightCols(known.p.size())));
  }

  /// The side along which the dependents change most, an angle's own change included.
  std::optional<std::size_t> longest(const Part& part) const {
    const Intervals& P = part.P;
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t k = 0; k < P.size(); ++k) {
      double rate = layout_.free[k].is_parameter || !is_angle(k) ? 0 : 1;
      for (std::size_t i = 0; i < layout_.unknowns.size(); ++i)
        rate = std::max(rate, std::fabs(slope_(at(i), at(k))) /
                                  (layout_.problem.slide_unknowns[i] ? bounds_->length() : 1));
      if (part.halvings[k] >= kHalvings || !(rate * P[k].width() > most)) continue;
      most = rate * P[k].width();
      best = k;
    }
    return best;
  }

  bool is_angle(std::size_t k) const {
    const std::size_t entry = layout_.free[k].leaf.index;
    return entry >= request_.initial_y.size() || request_.angular[entry];
  }

  std::string failure(const Anchor& known) const {
    const bool singular = bounds_->margin_near(known.x, known.p) < kNearlySingular;
    return fmt::format(
        "{} near {}",
        singular ? "what is solved for the dependent coordinates turns singular" : "not decided",
        text(known.p));
  }

  std::string text(const VectorXd& p) const {
    std::vector<std::string> list;
    for (std::size_t k = 0; k < layout_.free.size(); ++k)
      list.push_back(fmt::format("{} = {:.4g}", layout_.free[k].name, p[at(k)]));
    return list.empty() ? "the initial state" : fmt::format("{}", fmt::join(list, ", "));
  }

  /// A circle after whose turns the branch is not shown to be where it was.
  std::optional<std::size_t> open_circle() const {
    for (std::size_t k = 0; k < layout_.free.size(); ++k)
      if (layout_.free[k].is_circle && !is_cut(k) && !closes(k)) return k;
    return {};
  }

  /// Do the dependents' ranges keep the branch from the ends of a circle?
  bool is_cut(std::size_t k) const {
    Intervals low = whole(), high = low;
    low[k].high = low[k].low;
    high[k].low = high[k].high;
    return none_proven(low) && none_proven(high);
  }

  bool none_proven(const Intervals& P) const {
    const std::vector<std::size_t> parts = region_->touching(P);
    return std::none_of(parts.begin(), parts.end(),
                        [&](std::size_t part) { return (*region_)[part].branch.has_value(); });
  }

  /// Nothing is known about parts that the dependents' ranges exclude.
  bool is_all_proven() const {
    const std::vector<std::size_t> parts = region_->touching(whole());
    return std::all_of(parts.begin(), parts.end(),
                       [&](std::size_t part) { return (*region_)[part].branch.has_value(); });
  }

  /// The solution half of all turns before the start and that half of them after it, whole turns of angles
  /// taken off, are the same if the second is in the box about the branch at the first in which there is only
  /// one. Two branches that meet anywhere do so everywhere.
  bool closes(std::size_t k) const {
    if (layout_.free.size() > 1 && !is_all_proven()) return false;
    VectorXd p = start_p();
    const double turns = std::round(layout_.free[k].side.width() / (2 * kPi));
    p[at(k)] = layout_.free[k].start - turns * kPi;
    const std::optional<Branch>& before = (*region_)[region_->at(p)].branch;
    const std::optional<Anchor> first = before ? anchor_on(*before, p) : std::nullopt;
    Intervals P;
    for (const double value : p) P.push_back(Interval::point(value));
    P[k] = P[k] + Interval::point(turns) * kTurn;
    const VectorXd later = middle(P);
    const std::optional<Branch>& after = (*region_)[region_->at(later)].branch;
    if (!first || !after) return false;
    const std::optional<Branch> second = enclose_branch(*layout_.equations, P, after->guess(later));
    if (!second || !is_on(*after, {later, second->x, second->over(P)})) return false;
    return is_on(*before, {p, first->x, turned_back(second->over(P), first->x)});
  }

  /// Moved by whole turns, and quaternions to the other sign, to be next to `x`.
  Intervals turned_back(Intervals X, const VectorXd& x) const {
    for (std::size_t i = 0; i < layout_.unknowns.size(); ++i)
      if (request_.angular[layout_.unknowns[i]] && is_periodic(layout_.g, layout_.unknowns[i]))
        X[i] = X[i] - Interval::point(std::round((X[i].middle() - x[at(i)]) / (2 * kPi))) * kTurn;
    for (const std::size_t w : layout_.quaternions) {
      const auto first = static_cast<std::size_t>(
          std::find(layout_.unknowns.begin(), layout_.unknowns.end(), w) - layout_.unknowns.begin());
      double along = 0;
      for (std::size_t i = first; i < first + 4; ++i) along += X[i].middle() * x[at(i)];
      for (std::size_t i = first; along < 0 && i < first + 4; ++i) X[i] = Interval{} - X[i];
    }
    return X;
  }

  RegularityProof result(const BlockBounds& bounds) const {
    RegularityProof proof;
    proof.margin = bounds.margin();
    std::vector<std::string> list;
    for (const FreeVariable& f : layout_.free)
      list.push_back(f.is_circle ? "any " + f.name
                                 : fmt::format("{} in [{}, {}]", f.name, f.side.low, f.side.high));
    for (const std::size_t k : layout_.unknowns)
      if (const Range& range = request_.range[k])
        list.push_back(fmt::format("{} in [{}, {}]", request_.names[k], (*range)[0], (*range)[1]));
    proof.region = fmt::format("{}", fmt::join(list, ", "));
    proof.at_defaults = layout_.at_defaults;
    proof.box = layout_.box;
    proof.boxes = proven_;
    proof.radius = bounds.radius();
    proof.isolation = bounds.isolation();
    proof.first_correction = bounds.first_correction();
    proof.ends_within = bounds.ends_within();
    proof.length = bounds.length();
    return proof;
  }

  static constexpr double kAssembled = 1e-6;
  /// A whole turn.
  static constexpr Interval kTurn{6.283185307179586, 6.283185307179587};

  const RegularityRequest& request_;
  RegularityLayout layout_;
  std::optional<Subdivision> region_;
  std::vector<Open> open_;
  BlockBounds* bounds_ = nullptr;
  Eigen::MatrixXd slope_;  ///< of the dependents, where a box was tried last
  std::size_t boxes_ = 0, proven_ = 0;
  VectorXd worst_;   ///< where the margin seen is least
  double seen_ = 1;  ///< least margin at middles
};

}  // namespace

std::variant<RegularityProof, std::string> prove_regular(const RegularityRequest& request) {
  return Proof(request).run();
}

RegularityRequest regularity_request(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                     const LoopPlan& plan) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  RegularityRequest request;
  request.g = constraints.value;
  request.blocks = plan.blocks;
  request.tangent = layout.tangent;
  request.initial_y = plan.y;
  request.angular = model::angular_positions(mechanism);
  request.range = position_ranges(mechanism);
  request.names = layout.position_names;
  request.parameters = model::default_values(mechanism);
  for (const model::Parameter& parameter : mechanism.parameters) {
    request.parameter_range.push_back(parameter.range);
    request.parameter_names.push_back(parameter.name);
  }
  request.iterations = plan.iterations;
  return request;
}

}  // namespace jourdain::loops
