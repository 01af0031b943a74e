#include "loops/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "loops/elimination_order.hpp"
#include "loops/inertia.hpp"
#include "loops/partition.hpp"
#include "loops/position_request.hpp"
#include "loops/regular_rows.hpp"
#include "loops/regularity_proof.hpp"
#include "loops/scales.hpp"
#include "model/checks.hpp"
#include "model/loop_kinds.hpp"
#include "reference/minimal.hpp"

namespace jourdain::loops {

using model::LoopTreatment;
using support::shown;

namespace {

/// Configurations at which rows, freedom and conditioning are judged.
constexpr std::size_t kConfigurations = 48;

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

class Planner {
 public:
  Planner(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
          support::Diagnostics& diagnostics)
      : mechanism_(mechanism),
        constraints_(constraints),
        diagnostics_(diagnostics),
        layout_(model::lay_out_coordinates(mechanism)),
        closure_(mechanism, constraints, model::default_values(mechanism)),
        names_(row_names(mechanism)) {}

  std::optional<LoopPlan> plan() {
    plan_.iterations = mechanism_.loop_options.iterations;
    plan_.stabilisation = mechanism_.loop_options.stabilisation;
    plan_.is_named = mechanism_.loop_options.treatment || !mechanism_.loop_options.independent.empty();
    if (!assemble()) return {};
    configurations_ = walk(closure_, start_, mechanism_, kConfigurations);
    for (const Configuration& c : configurations_) jacobians_.push_back(closure_.jacobian(c));
    if (!check_acting()) return {};
    plan_.rows = regular_rows(jacobians_);
    for (std::size_t r = 0; r < names_.size(); ++r)
      if (std::find(plan_.rows.begin(), plan_.rows.end(), r) == plan_.rows.end())
        plan_.redundant.push_back(names_[r]);
    plan_.freedom = layout_.velocity_count() - std::min(layout_.velocity_count(), plan_.rows.size());
    if (!check_moved_inertia(mechanism_, configurations_, jacobians_, diagnostics_)) return {};
    massless_ = massless_in_tree(mechanism_, start_);
    set_scales(mechanism_, start_, jacobians_.front(), massless_.empty(), plan_);
    if (!(plan_.freedom == 0 ? treat_determined() : treat())) return {};
    if (!check_tree_inertia(mechanism_, massless_, plan_, diagnostics_)) return {};
    set_determinant(mechanism_, configurations_, jacobians_, plan_);
    return plan_;
  }

 private:
  std::vector<std::size_t> named_independent() const {
    std::vector<std::size_t> list;
    for (const auto& name : mechanism_.loop_options.independent)
      list.push_back(*layout_.joints[name.joint.value].velocity[name.coordinate]);
    return list;
  }

  /// Numbers of a file have so and so many digits: rows that follow from others but for those are left open, and that is said.
  void settle_disagreement() {
    const Configuration initial{0, reference::Reference<long double>(mechanism_).initial_state().y};
    std::vector<bool> moving(layout_.velocity_count(), true);
    for (const std::size_t k : named_independent()) moving[k] = false;
    const Configuration nearest = closure_.assembled(initial, moving);
    const Matrix G = closure_.jacobian(nearest);
    const std::vector<std::size_t> regular = regular_rows({G});
    std::vector<std::size_t> others;
    for (std::size_t r = 0; r < names_.size(); ++r)
      if (std::find(regular.begin(), regular.end(), r) == regular.end()) others.push_back(r);
    const long double apart = std::max(closure_.open(nearest), largest_rest(G, regular, others));
    if (others.empty() || apart <= kClosed || apart > kRowTolerance) return;
    closure_.disregard(others);
    if (!stay_nearly_closed(closure_.assembled(nearest, moving), others)) return closure_.disregard({});
    plan_.disagreeing = others;
    plan_.disagreement = static_cast<double>(apart);
    std::vector<std::string> names;
    for (const std::size_t r : others) names.push_back(names_[r]);
    diagnostics_.note(
        mechanism_.loops.front().where,
        fmt::format("constraints {} follow from the others but for {:.1g}: they are left open by that",
                    fmt::join(names, ", "), plan_.disagreement),
        "rounded numbers, or an axis that is askew; more than 1e-6 would hold the mechanism back");
  }

  /// Near a singular configuration rows nearly follow from others, too, but not for long.
  bool stay_nearly_closed(const Configuration& start, const std::vector<std::size_t>& rows) const {
    constexpr long double kNearly = 100 * kRowTolerance;
    for (const Configuration& c : walk(closure_, start, mechanism_, kConfigurations)) {
      const Vector g = closure_.value(c);
      for (const std::size_t r : rows)
        if (!(std::abs(g[at(r)]) <= kNearly)) return false;
    }
    return true;
  }

  bool assemble() {
    settle_disagreement();
    const std::optional<Start> start = find_start(mechanism_, closure_, named_independent(), diagnostics_);
    if (!start) return false;
    start_ = start->configuration;
    plan_.moved = start->moved;
    for (const long double entry : start_.y) plan_.y.push_back(static_cast<double>(entry));
    for (const long double entry : start->z) plan_.z.push_back(static_cast<double>(entry));
    return true;
  }

  /// Every loop must hold some coordinate back somewhere.
  bool check_acting() {
    std::size_t first = 0;
    bool all_act = true;
    for (const model::Loop& loop : mechanism_.loops) {
      const std::size_t count = model::row_count(loop.type);
      const bool acts = std::any_of(jacobians_.begin(), jacobians_.end(), [&](const Matrix& G) {
        return !G.middleRows(at(first), at(count)).isZero(0);
      });
      if (!acts)
        diagnostics_.error(loop.where, fmt::format("loop '{}' holds no coordinate back", shown(loop.name)),
                           "it stays closed however the mechanism moves: leave it out");
      all_act = all_act && acts;
      first += count;
    }
    return all_act;
  }

  /// Coordinates that are driven, or that the description starts with a velocity.
  std::vector<bool> preferred() const {
    std::vector<bool> list(layout_.velocity_count(), false);
    for (const model::Actuator& actuator : mechanism_.actuators)
      list[*layout_.joints[actuator.joint.value].velocity[actuator.coordinate]] = true;
    for (const model::CoordinateForce& force : mechanism_.coordinate_forces)
      if (const auto entry = layout_.joints[force.joint.value].velocity[force.coordinate])
        list[*entry] = true;
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c)
        if (const auto entry = layout_.joints[j].velocity[c];
            entry && !mechanism_.joints[j].coordinates[c].initial_velocity.is_zero())
          list[*entry] = true;
    return list;
  }

  /// Without freedom all positions follow from time; multipliers are left for what is singular on the way.
  bool treat_determined() {
    const model::LoopOptions& options = mechanism_.loop_options;
    if (!layout_.rheonomic)
      diagnostics_.note(mechanism_.loops.front().where, "the loops leave no degree of freedom",
                        "nothing depends on time either: the mechanism stands still");
    if (options.treatment == LoopTreatment::kMultipliers) return true;
    if (!options.independent.empty()) return report_bad({});
    const std::optional<Partition> partition = given_partition(regular_jacobians(), {});
    if (!partition || partition->blocks.empty()) return !options.treatment || report_bad(partition);
    take(*partition);
    if (options.treatment != LoopTreatment::kPartitioned && close_explicitly()) return true;
    if (options.treatment == LoopTreatment::kExplicit) return false;
    const auto found = prove_regular(regularity_request(mechanism_, constraints_, plan_));
    if (const auto* proof = std::get_if<RegularityProof>(&found)) plan_.proof = *proof;
    return true;
  }

  /// G at the configurations seen, without redundant rows.
  std::vector<Matrix> regular_jacobians() const {
    std::vector<Matrix> regular;
    for (const Matrix& G : jacobians_) {
      Matrix part(at(plan_.rows.size()), G.cols());
      for (std::size_t k = 0; k < plan_.rows.size(); ++k) part.row(at(k)) = G.row(at(plan_.rows[k]));
      regular.push_back(part);
    }
    return regular;
  }

  bool treat() {
    const model::LoopOptions& options = mechanism_.loop_options;
    if (options.treatment == LoopTreatment::kMultipliers) return true;
    const std::vector<Matrix> regular = regular_jacobians();
    const std::vector<std::size_t> named = named_independent();
    const std::optional<Partition> partition =
        named.empty() ? choose_partition(regular, velocity_groups(mechanism_), preferred())
                      : given_partition(regular, named);
    if (!partition || (partition->blocks.empty() && !plan_.rows.empty())) {
      plan_.reason = "no choice of independent coordinates is regular at the configurations seen";
      return plan_.is_named ? report_bad(partition) : true;
    }
    take(*partition);
    if (options.treatment == LoopTreatment::kPartitioned) return close_by_newton();
    return close_explicitly() || (options.treatment != LoopTreatment::kExplicit && close_by_newton());
  }

  /// With these velocities independent.
  void take(const Partition& partition) {
    plan_.independent = partition.independent;
    plan_.blocks = partition.blocks;
    plan_.conditioning = partition.conditioning;
    for (Block& block : plan_.blocks)
      for (std::size_t& row : block.rows) row = plan_.rows[row];
    plan_.treatment = LoopTreatment::kPartitioned;
  }

  /// A choice that is not proven is taken only where it is asked for, or where multipliers would need M⁻¹ of a singular M.
  bool close_by_newton() {
    const auto found = prove_regular(regularity_request(mechanism_, constraints_, plan_));
    if (const auto* proof = std::get_if<RegularityProof>(&found)) {
      plan_.proof = *proof;
      return true;
    }
    const std::string& why = std::get<std::string>(found);
    if (plan_.is_named || !massless_.empty()) {
      diagnostics_.warning(
          mechanism_.loop_options.where,
          fmt::format("it is not proven that the other coordinates follow from the independent ones: {}",
                      why),
          "watch 'regularity' of State, declare ranges, or use treatment = \"multipliers\"");
      return true;
    }
    if (!plan_.reason.empty()) plan_.reason += "; ";
    plan_.reason += "no choice of independent coordinates proven: " + why;
    keep_all();
    return true;
  }

  void keep_all() {
    plan_.treatment = LoopTreatment::kMultipliers;
    plan_.independent.clear();
    plan_.blocks.clear();
    plan_.conditioning = 0;
  }

  /// False where there is no closed form; an error where one was asked for.
  bool close_explicitly() {
    std::variant<ClosedForm, std::string> found = solve_positions();
    if (ClosedForm* form = std::get_if<ClosedForm>(&found)) {
      plan_.treatment = LoopTreatment::kExplicit;
      take_orders(*form);
      plan_.closed_form = std::move(*form);
      return true;
    }
    const std::string& why = std::get<std::string>(found);
    plan_.reason = "no closed form: " + why;
    if (mechanism_.loop_options.treatment == LoopTreatment::kExplicit)
      diagnostics_.error(mechanism_.loop_options.where, "the loops cannot be closed explicitly", why);
    return false;
  }

  std::variant<ClosedForm, std::string> solve_positions() const {
    auto request = position_request(mechanism_, constraints_, plan_);
    if (auto* failure = std::get_if<std::string>(&request)) return std::move(*failure);
    auto& positions = std::get<ClosedFormRequest>(request);
    for (const Block& block : plan_.blocks) positions.eliminations.push_back(elimination_of(block));
    return closed_form(positions);
  }

  /// Complete pivoting at the start, where cofactors are dearer; none where a pivot is nearly lost at a configuration seen.
  Elimination elimination_of(const Block& block) const {
    if (block.rows.size() < 3) return {};
    return elimination_order(jacobians_, block.rows, block.dependents);
  }

  void take_orders(const ClosedForm& form) {
    for (std::size_t b = 0; b < plan_.blocks.size(); ++b) {
      const Elimination order = elimination_of(plan_.blocks[b]);
      if (!order.rows.empty() && form.has_pivots[b]) plan_.blocks[b] = {order.rows, order.columns, true};
    }
  }

  bool report_bad(const std::optional<Partition>& partition) {
    const support::SourceRange where = mechanism_.loop_options.where;
    const std::size_t named = mechanism_.loop_options.independent.size();
    if (named != 0 && named != plan_.freedom)
      diagnostics_.error(
          where,
          fmt::format("[loops] names {} independent coordinate{}, the mechanism has {} degree{} of "
                      "freedom",
                      named, named == 1 ? "" : "s", plan_.freedom, plan_.freedom == 1 ? "" : "s"),
          "name as many, or leave 'independent' out");
    else if (!partition)
      diagnostics_.error(where, "no choice of independent coordinates stays regular",
                         "declare the range of coordinates, or use treatment = \"multipliers\"");
    else
      diagnostics_.error(where, "the other coordinates do not follow from the independent ones",
                         "name others, or leave 'independent' out");
    return false;
  }

  const model::Mechanism& mechanism_;
  const ConstraintPrograms& constraints_;
  support::Diagnostics& diagnostics_;
  model::CoordinateLayout layout_;
  NumericClosure closure_;
  std::vector<std::string> names_;
  Configuration start_;
  std::vector<Configuration> configurations_;  ///< closed ones; the first is the start
  std::vector<Matrix> jacobians_;              ///< there
  std::vector<model::JointIndex> massless_;    ///< where the tree's mass matrix is singular
  LoopPlan plan_;
};

}  // namespace

double LoopPlan::least_regularity() const {
  switch (treatment) {
    case LoopTreatment::kExplicit:
      return 1e-6;
    case LoopTreatment::kPartitioned:
      return 1e-3;
    case LoopTreatment::kMultipliers:
      return is_named
                 ? 0
                 : 1e-9;  // ten times the regularisation: a hundredth of the constraint force is left out
  }
  return 0;
}

double LoopPlan::greatest_opening() const {
  constexpr double kLeftOpen = 1e-10;
  switch (treatment) {
    case LoopTreatment::kExplicit:
      return 1e-2;  // closed in any case, but dependent positions were integrated badly
    case LoopTreatment::kPartitioned:
      if (proof) return proof->first_correction * proof->first_correction;
      return std::pow(kLeftOpen, std::ldexp(2.0, -iterations));  // each iteration squares the distance
    case LoopTreatment::kMultipliers:
      return kLeftOpen;  // one step
  }
  return 0;
}

std::vector<std::string> row_names(const model::Mechanism& mechanism) {
  std::vector<std::string> names;
  for (const model::Loop& loop : mechanism.loops)
    for (const model::LoopRow& row : model::loop_kind(loop.type).rows)
      names.push_back(fmt::format("{}.{}", loop.name, row.name));
  return names;
}

std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                   support::Diagnostics& diagnostics) {
  return Planner(mechanism, constraints, diagnostics).plan();
}

}  // namespace jourdain::loops
