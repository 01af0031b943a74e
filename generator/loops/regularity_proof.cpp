#include "loops/regularity_proof.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "ir/compose.hpp"
#include "loops/block_bounds.hpp"
#include "loops/timeless.hpp"
#include "model/angles.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using Eigen::VectorXd;
using ir::LeafKind;
using ir::Program;

namespace {

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

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// What the branch is followed over.
struct Free {
  Variable leaf;
  std::string name;
  double start = 0;
  Interval side;
  bool is_circle = false;
  bool is_parameter = false;
};

/// The region taken apart: a box is proven, or its halves are.
struct Part {
  std::optional<Branch> branch;
  std::size_t side = 0;
  double middle = 0;
  std::size_t halves[2] = {0, 0};
};

/// A solution at a point on the branch: the only one in a small box.
struct Anchor {
  VectorXd p, x;
  Intervals X;
};

class Proof {
 public:
  explicit Proof(const RegularityRequest& request) : request_(request) {}

  std::variant<RegularityProof, std::string> run() {
    if (const std::string failure = lay_out(); !failure.empty()) return failure;
    std::vector<int> turns(free_.size(), 1);
    for (;;) {
      parts_.clear();
      set_circles(turns);
      BlockBounds bounds(problem_, *equations_, start_x_, start_p());
      bounds_ = &bounds;
      seen_ = 1;
      if (const std::string failure = follow(); !failure.empty()) return failure;
      const std::optional<std::size_t> open = open_circle();
      if (!open) return result(bounds);
      if (++turns[*open] > kMostTurns)
        return fmt::format("the dependent coordinates are not where they were after {} turns of {}",
                           kMostTurns, free_[*open].name);
    }
  }

 private:
  /// Unknowns, rows and free variables. Otherwise what cannot be handled.
  std::string lay_out() {
    ir::Builder builder;
    const Program rows = used_rows();
    const Timeless timeless = without_clock(builder, rows, request_.initial_y.size());
    if (timeless.drives_with_positions)
      return "an angle depends on time and on coordinates, but not by a sum";
    for (std::size_t i = 0; i < timeless.values.size(); ++i)
      builder.output("g", static_cast<int>(i), -1, timeless.values[i]);
    problem_.g = passes::remove_dead_code(builder.finish("g"));
    problem_.tangent = request_.tangent;
    problem_.positions = request_.initial_y.size();
    problem_.iterations = request_.iterations;
    list_unknowns();
    for (const ir::ValueId angle : timeless.driven) driven_.push_back(value_at_start(rows, angle));
    if (const std::string failure = list_free(); !failure.empty()) return failure;
    ir::LeafValues<double> fixed;
    fixed[LeafKind::kParameter] = request_.parameters;
    fixed[LeafKind::kPosition] = request_.initial_y;
    fixed[LeafKind::kPosition].insert(fixed[LeafKind::kPosition].end(), driven_.begin(), driven_.end());
    fixed[LeafKind::kTime] = {0};
    std::vector<Variable> unknowns, free;
    for (const std::size_t k : unknowns_) unknowns.push_back({LeafKind::kPosition, k});
    for (const Free& f : free_) free.push_back(f.leaf);
    equations_.emplace(with_unit_lengths(problem_.g), unknowns, free, fixed, request_.evaluate);
    start_x_ = VectorXd(at(unknowns_.size()));
    for (std::size_t i = 0; i < unknowns_.size(); ++i) start_x_[at(i)] = request_.initial_y[unknowns_[i]];
    return "";
  }

  /// Rows of the blocks, in their order; `problem_.blocks` counts them anew.
  Program used_rows() {
    Program rows = request_.g;
    rows.outputs.clear();
    for (const Block& block : request_.blocks) {
      problem_.blocks.push_back({{}, block.dependents});
      for (const std::size_t r : block.rows) {
        const auto output = std::find_if(request_.g.outputs.begin(), request_.g.outputs.end(),
                                         [&](const auto& o) { return o.row == static_cast<int>(r); });
        JD_CHECK(output != request_.g.outputs.end(), "no row {}", r);
        problem_.blocks.back().rows.push_back(rows.outputs.size());
        rows.outputs.push_back(*output);
        row_of_.push_back(r);
      }
    }
    return passes::remove_dead_code(rows);
  }

  void list_unknowns() {
    std::set<std::size_t> velocities;
    for (const Block& block : problem_.blocks)
      velocities.insert(block.dependents.begin(), block.dependents.end());
    for (const model::Tangent::Scalar& s : request_.tangent.scalars) {
      problem_.velocities = std::max(problem_.velocities, s.velocity + 1);
      problem_.slides.resize(std::max(problem_.slides.size(), problem_.velocities), false);
      problem_.slides[s.velocity] = !request_.angular[s.position];
      if (velocities.count(s.velocity) == 0) continue;
      unknowns_.push_back(s.position);
      problem_.slide_unknowns.push_back(!request_.angular[s.position]);
    }
    for (const model::Tangent::Scalar& s : request_.tangent.quaternions) {
      problem_.velocities = std::max(problem_.velocities, s.velocity + 3);
      if (velocities.count(s.velocity) == 0) continue;
      quaternions_.push_back(s.position);
      for (std::size_t k = 0; k < 4; ++k) unknowns_.push_back(s.position + k);
      problem_.slide_unknowns.resize(unknowns_.size(), false);
    }
    problem_.slides.resize(problem_.velocities, false);
  }

  double value_at_start(Program program, ir::ValueId value) const {
    program.outputs = {{"angle", -1, -1, value}};
    ir::LeafValues<double> leaves;
    leaves[LeafKind::kParameter] = request_.parameters;
    leaves[LeafKind::kPosition] = request_.initial_y;
    leaves[LeafKind::kTime] = {0};
    return ir::interpret(program, leaves)[0];
  }

  /// (|quaternion|² − 1)/2 = 0 after the rows.
  Program with_unit_lengths(const Program& g) const {
    ir::Builder builder;
    std::vector<ir::Signed> values = ir::insert(builder, g);
    for (const std::size_t w : quaternions_) {
      ir::Signed sum = builder.literal(-0.5);
      for (std::size_t k = 0; k < 4; ++k) {
        const ir::Signed entry = builder.leaf(LeafKind::kPosition, w + k);
        sum = builder.add(sum, builder.multiply(builder.literal(0.5), builder.multiply(entry, entry)));
      }
      values.push_back(sum);
    }
    for (std::size_t i = 0; i < values.size(); ++i) builder.output("g", static_cast<int>(i), -1, values[i]);
    return builder.finish("g");
  }

  /// The leaves that the rows depend on beside the unknowns.
  std::string list_free() {
    std::set<std::size_t> positions, parameters;
    for (const ir::Node& node : problem_.g.nodes) {
      if (node.op != ir::Op::kLeaf) continue;
      if (node.leaf == LeafKind::kTime) return "a constraint depends on time other than by an angle's sine";
      (node.leaf == LeafKind::kPosition ? positions : parameters).insert(node.index);
    }
    for (const std::size_t k : unknowns_) positions.erase(k);
    for (const std::size_t k : positions) {
      const std::size_t ny = request_.initial_y.size();
      Free free;
      free.leaf = {LeafKind::kPosition, k};
      free.name = k < ny ? request_.names[k] : "the driven angle";
      free.start = k < ny ? request_.initial_y[k] : driven_[k - ny];
      const Range range = k < ny ? request_.range[k] : std::nullopt;
      free.is_circle = !range;
      if (range) free.side = {(*range)[0], (*range)[1]};
      if (!range && !((k >= ny || request_.angular[k]) && is_periodic(problem_.g, k)))
        return fmt::format("the constraints depend on {}, which has no range", free.name);
      if (range && !free.side.contains(free.start))
        return fmt::format("{} starts at {:.6g}, outside its range", free.name, free.start);
      free_.push_back(free);
    }
    for (const std::size_t k : parameters) {
      if (!request_.parameter_range[k]) {
        at_defaults_.push_back(request_.parameter_names[k]);
        continue;
      }
      const auto [low, high] = *request_.parameter_range[k];
      free_.push_back({{LeafKind::kParameter, k},
                       request_.parameter_names[k],
                       request_.parameters[k],
                       {low, high},
                       false,
                       true});
    }
    return "";
  }

  void set_circles(const std::vector<int>& turns) {
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (free_[k].is_circle) {
        const double half = turns[k] * kPi + kCircleSlack;
        free_[k].side = {free_[k].start - half, free_[k].start + half};
      }
  }

  VectorXd start_p() const {
    VectorXd p(at(free_.size()));
    for (std::size_t k = 0; k < free_.size(); ++k) p[at(k)] = free_[k].start;
    return p;
  }

  /// Follows the branch over all of the region. Otherwise where it ends.
  std::string follow() {
    const std::optional<Anchor> start = anchor(start_p(), start_x_);
    if (!start) return "the initial state is singular";
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      if (std::fabs(start->x[at(i)] - start_x_[at(i)]) > kAssembled)
        return "the initial state does not close the loops";
    Intervals whole;
    for (const Free& f : free_) whole.push_back(f.side);
    parts_.emplace_back();
    return prove(0, whole, std::vector<int>(free_.size(), 0), *start);
  }

  std::optional<Anchor> anchor(const VectorXd& p, const VectorXd& near) const {
    Intervals point;
    for (const double value : p) point.push_back(Interval::point(value));
    const std::optional<Branch> branch = enclose_branch(*equations_, point, near);
    if (!branch) return {};
    return Anchor{p, branch->x, branch->X};
  }

  /// The branch through `known`, a point of P, over P; as part `index`.
  std::string prove(std::size_t index, const Intervals& P, const std::vector<int>& halvings,
                    const Anchor& known) {
    if (++boxes_ > request_.effort)
      return fmt::format("not decided within {} boxes near {}", request_.effort, text(known.p));
    if (prove_whole(index, P, known)) return "";
    const std::optional<std::size_t> side = longest(P, halvings);
    if (!side) return failure(known);
    return prove_halves(index, P, halvings, known, *side);
  }

  bool prove_whole(std::size_t index, const Intervals& P, const Anchor& known) {
    VectorXd middle(known.p.size());
    for (std::size_t k = 0; k < P.size(); ++k) middle[at(k)] = P[k].middle();
    slope_ = slope_at(known);
    std::optional<Branch> branch = enclose_branch(*equations_, P, known.x + slope_ * (middle - known.p));
    if (!branch || !is_inside(known.X, branch->X)) return false;
    seen_ = std::min(seen_, bounds_->margin_near(branch->x, branch->centre));
    const bool sharp = boxes_ <= request_.effort / kSharpShare;
    if (!bounds_->include(*branch, sharp ? std::max(kLeastMargin, seen_ / 2) : kLeastMargin)) return false;
    parts_[index].branch = std::move(branch);
    ++proven_;
    return true;
  }

  std::string prove_halves(std::size_t index, const Intervals& P, std::vector<int> halvings,
                           const Anchor& known, std::size_t side) {
    ++halvings[side];
    const double middle = P[side].middle();
    Intervals half[2] = {P, P};
    half[0][side].high = half[1][side].low = middle;
    const std::size_t first = known.p[at(side)] <= middle ? 0 : 1;
    parts_[index].side = side;
    parts_[index].middle = middle;
    for (std::size_t& child : parts_[index].halves) {
      child = parts_.size();
      parts_.emplace_back();
    }
    const auto halves = parts_[index].halves;
    const std::size_t one = halves[first], other = halves[1 - first];
    if (const std::string end = prove(one, half[first], halvings, known); !end.empty()) return end;
    VectorXd face = known.p;
    face[at(side)] = middle;
    const std::optional<Anchor> shared = anchor_on(part_with(one, face), face);
    if (!shared) return failure(known);
    return prove(other, half[1 - first], halvings, *shared);
  }

  /// The branch of a proven part at a point of its box.
  std::optional<Anchor> anchor_on(const Branch& branch, const VectorXd& p) const {
    std::optional<Anchor> found = anchor(p, branch.guess(p));
    return found && is_inside(found->X, branch.X) ? found : std::nullopt;
  }

  const Branch& part_with(std::size_t index, const VectorXd& p) const {
    while (!parts_[index].branch)
      index = parts_[index].halves[p[at(parts_[index].side)] <= parts_[index].middle ? 0 : 1];
    return *parts_[index].branch;
  }

  Eigen::MatrixXd slope_at(const Anchor& known) const {
    const Eigen::MatrixXd slopes = equations_->slopes(known.x, known.p);
    return -slopes.leftCols(known.x.size()).partialPivLu().solve(slopes.rightCols(known.p.size()));
  }

  /// The side along which the dependents change most, an angle's own change included.
  std::optional<std::size_t> longest(const Intervals& P, const std::vector<int>& halvings) const {
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t k = 0; k < P.size(); ++k) {
      double rate = free_[k].is_parameter || !is_angle(k) ? 0 : 1;
      for (std::size_t i = 0; i < unknowns_.size(); ++i)
        rate = std::max(
            rate, std::fabs(slope_(at(i), at(k))) / (problem_.slide_unknowns[i] ? bounds_->length() : 1));
      if (halvings[k] >= kHalvings || !(rate * P[k].width() > most)) continue;
      most = rate * P[k].width();
      best = k;
    }
    return best;
  }

  bool is_angle(std::size_t k) const {
    const std::size_t entry = free_[k].leaf.index;
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
    for (std::size_t k = 0; k < free_.size(); ++k)
      list.push_back(fmt::format("{} = {:.4g}", free_[k].name, p[at(k)]));
    return list.empty() ? "the initial state" : fmt::format("{}", fmt::join(list, ", "));
  }

  /// A circle after whose turns the branch is not shown to be where it was.
  std::optional<std::size_t> open_circle() const {
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (free_[k].is_circle && !closes(k)) return k;
    return {};
  }

  /// One solution half of all turns before the start and one half of them after it, whole turns of angles taken off, are the same if the
  /// second is in the box about the branch at the first in which there is only one. Two branches that meet anywhere do so everywhere.
  bool closes(std::size_t k) const {
    VectorXd p = start_p();
    const double turns = std::round(free_[k].side.width() / (2 * kPi));
    p[at(k)] = free_[k].start - turns * kPi;
    const Branch& before = part_with(0, p);
    const std::optional<Anchor> first = anchor_on(before, p);
    Intervals P;
    for (const double value : p) P.push_back(Interval::point(value));
    P[k] = P[k] + Interval::point(turns) * kTurn;
    p[at(k)] = P[k].middle();
    const Branch& after = part_with(0, p);
    const std::optional<Branch> second = enclose_branch(*equations_, P, after.guess(p));
    if (!first || !second || !is_inside(second->X, after.X)) return false;
    return is_inside(turned_back(second->X, first->x), before.X);
  }

  /// Moved by whole turns, and quaternions to the other sign, to be next to `x`.
  Intervals turned_back(Intervals X, const VectorXd& x) const {
    for (std::size_t i = 0; i < unknowns_.size(); ++i)
      if (request_.angular[unknowns_[i]] && is_periodic(problem_.g, unknowns_[i]))
        X[i] = X[i] - Interval::point(std::round((X[i].middle() - x[at(i)]) / (2 * kPi))) * kTurn;
    for (const std::size_t w : quaternions_) {
      const auto first =
          static_cast<std::size_t>(std::find(unknowns_.begin(), unknowns_.end(), w) - unknowns_.begin());
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
    for (const Free& f : free_)
      list.push_back(f.is_circle ? "any " + f.name
                                 : fmt::format("{} in [{}, {}]", f.name, f.side.low, f.side.high));
    proof.region = fmt::format("{}", fmt::join(list, ", "));
    proof.at_defaults = at_defaults_;
    proof.boxes = proven_;
    proof.radius = bounds.radius();
    proof.residual = bounds.residual();
    proof.ends_within = bounds.ends_within();
    proof.length = bounds.length();
    proof.row_scale.assign(request_.g.outputs.size(), 0);
    for (std::size_t i = 0; i < row_of_.size(); ++i) proof.row_scale[row_of_[i]] = bounds.row_scale()[i];
    return proof;
  }

  static constexpr double kAssembled = 1e-6;
  /// A whole turn.
  static constexpr Interval kTurn{6.283185307179586, 6.283185307179587};

  const RegularityRequest& request_;
  NewtonProblem problem_;
  std::vector<std::size_t> row_of_;    ///< of the request's g, by row of the problem's
  std::vector<std::size_t> unknowns_;  ///< entries of y; the four of a quaternion
  std::vector<std::size_t> quaternions_;
  std::vector<double> driven_;  ///< at t = 0
  std::vector<Free> free_;
  std::vector<std::string> at_defaults_;
  std::optional<BranchEquations> equations_;
  VectorXd start_x_;
  std::vector<Part> parts_;
  BlockBounds* bounds_ = nullptr;
  Eigen::MatrixXd slope_;  ///< of the dependents, where a box was tried last
  std::size_t boxes_ = 0, proven_ = 0;
  double seen_ = 1;  ///< least margin at middles
};

}  // namespace

std::variant<RegularityProof, std::string> prove_regular(const RegularityRequest& request) {
  return Proof(request).run();
}

RegularityRequest regularity_request(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                     const LoopPlan& plan, const std::vector<double>& parameters) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  RegularityRequest request;
  request.g = constraints.value;
  request.blocks = plan.blocks;
  request.tangent = model::tangent_of(mechanism, layout);
  request.initial_y = plan.y;
  request.angular = model::angular_positions(mechanism);
  request.range.resize(layout.position_count());
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].position[c])
        request.range[*entry] = mechanism.joints[j].coordinates[c].range;
  request.names = layout.position_names;
  request.parameters = parameters;
  for (const model::Parameter& parameter : mechanism.parameters) {
    request.parameter_range.emplace_back();
    request.parameter_names.push_back(parameter.name);
  }
  request.iterations = plan.iterations;
  return request;
}

}  // namespace jourdain::loops
