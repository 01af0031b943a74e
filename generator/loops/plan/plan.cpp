#include "loops/plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "loops/closed_form/position_request.hpp"
#include "loops/plan/bend_check.hpp"
#include "loops/plan/constraint_domain.hpp"
#include "loops/plan/elimination_order.hpp"
#include "loops/plan/inertia.hpp"
#include "loops/plan/partition.hpp"
#include "loops/plan/preferred.hpp"
#include "loops/plan/redundant_in_time.hpp"
#include "loops/plan/scales.hpp"
#include "loops/plan/sharing_rows.hpp"
#include "loops/plan/start.hpp"
#include "loops/plan/states.hpp"
#include "loops/plan/velocity_partition.hpp"
#include "loops/plan/velocity_rows.hpp"
#include "loops/regularity/regularity_proof.hpp"
#include "loops/rows/disagreement.hpp"
#include "loops/rows/regular_rows.hpp"
#include "model/loop_kinds.hpp"
#include "model/motion_sources.hpp"
#include "model/time_dependence.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using model::LoopTreatment;

namespace {

using support::at;

/// Configurations at which rows, freedom and conditioning are judged.
constexpr std::size_t kConfigurationsSeen = 48;

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
    if (!check_linear(mechanism_, constraints_, diagnostics_) || !assemble()) return {};
    configurations_ = walk(closure_, start_, mechanism_, kConfigurationsSeen);
    for (const Configuration& c : configurations_) jacobians_.push_back(closure_.jacobian(c));
    if (!check_acting()) return {};
    plan_.rows =
        plan_.disagreeing.empty() ? kept_rows(closure_, configurations_) : all_but(plan_.disagreeing);
    for (const std::size_t r : all_but(plan_.rows)) plan_.redundant.push_back(names_[r]);
    if (!check_bend(mechanism_, closure_, start_, start_z_, plan_.rows, diagnostics_)) return {};
    if (!check_later(mechanism_, closure_, start_, plan_, diagnostics_)) return {};
    plan_.freedom = layout_.velocity_count() - std::min(layout_.velocity_count(), plan_.rows.size());
    if (!check_moved_inertia(mechanism_, configurations_, jacobians_, diagnostics_)) return {};
    massless_ = massless_in_tree(mechanism_, start_);
    set_scales(mechanism_, configurations_, jacobians_, massless_.empty(), plan_);
    if (model::binds_velocities(mechanism_)) {
      if (!check_velocities(mechanism_, closure_, configurations_, plan_.rows, diagnostics_)) return {};
      if (!treat_velocities()) return {};
    } else if (!(plan_.freedom == 0 ? treat_determined() : treat())) {
      return {};
    }
    if (!check_tree_inertia(mechanism_, massless_, plan_, diagnostics_)) return {};
    if (!plan_.is_reduced() && !share()) return {};
    set_determinant(mechanism_, configurations_, jacobians_, plan_);
    return plan_;
  }

 private:
  std::vector<std::size_t> named_independent() const { return loops::named_independent(mechanism_); }

  std::vector<std::size_t> all_but(const std::vector<std::size_t>& rows) const {
    return loops::all_but(rows, names_.size());
  }

  bool assemble() {
    const Disagreement found =
        settle_disagreement(mechanism_, closure_, named_independent(), kConfigurationsSeen, diagnostics_);
    plan_.disagreeing = found.rows;
    plan_.disagreement = found.amount;
    plan_.length_unit = static_cast<double>(closure_.units().length);
    const std::optional<Start> start = find_start(mechanism_, closure_, named_independent(), diagnostics_);
    if (!start) return false;
    start_ = start->configuration;
    start_z_ = start->z;
    take_start(*start, plan_);
    return true;
  }

  /// Every loop must hold some coordinate back somewhere, with those that continue it.
  bool check_acting() {
    std::size_t first = 0;
    bool all_act = true;
    for (std::size_t l = 0; l < mechanism_.loops.size();) {
      const model::Loop& loop = mechanism_.loops[l];
      std::size_t count = model::row_count(loop.type);
      for (++l; l < mechanism_.loops.size() && mechanism_.loops[l].continues; ++l)
        count += model::row_count(mechanism_.loops[l].type);
      const bool acts = std::any_of(jacobians_.begin(), jacobians_.end(), [&](const Matrix& G) {
        return !G.middleRows(at(first), at(count)).isZero(0);
      });
      if (!acts)
        diagnostics_.error(loop.where, fmt::format("{} holds no coordinate back", in_words(loop)),
                           "it stays closed however the mechanism moves: leave it out");
      all_act = all_act && acts;
      first += count;
    }
    return all_act;
  }

  /// Without freedom all positions follow from time; multipliers are left for what is singular on the way.
  bool treat_determined() {
    const model::LoopOptions& options = mechanism_.loop_options;
    if (!model::time_dependence(mechanism_).positions)
      diagnostics_.note(mechanism_.loops.front().where, "the loops leave no degree of freedom",
                        "nothing depends on time either: the mechanism stands still");
    if (options.treatment == LoopTreatment::kMultipliers) return true;
    if (!options.independent.empty()) return report_bad({});
    const std::optional<Partition> partition = given_partition(regular_jacobians(), open_jacobians(), {});
    if (!partition || partition->blocks.empty()) return !options.treatment || report_bad(partition);
    take(*partition);
    if (options.treatment != LoopTreatment::kPartitioned && close_explicitly()) return true;
    if (options.treatment == LoopTreatment::kExplicit) return refuse_explicit();
    const std::string why = prove();
    if (why.empty()) return true;
    if (!is_dead(closure_.in_units(jacobians_.front()), plan_.blocks))
      return warn_unproven("coordinates follow from time", why);
    if (plan_.is_named) return refuse_dead();
    plan_.reason = "the initial state is a dead position";
    keep_all();
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

  /// Off the loops, at other parameters: what vanishes there is no part of a row. Rods of equal lengths hide
  /// some parts where loops are closed.
  std::vector<Matrix> open_jacobians() const {
    return open_rows(mechanism_, constraints_, configurations_, plan_.rows);
  }

  bool treat() {
    const model::LoopOptions& options = mechanism_.loop_options;
    if (options.treatment == LoopTreatment::kMultipliers) return true;
    const std::vector<Partition> choices = partitions();
    if (choices.empty() || (choices.front().blocks.empty() && !plan_.rows.empty())) {
      plan_.reason = "no choice of independent coordinates is regular at the configurations seen";
      return plan_.is_named ? report_bad(choices.empty() ? std::nullopt : std::optional(choices.front()))
                            : true;
    }
    if (options.treatment != LoopTreatment::kPartitioned)
      for (const Partition& choice : choices) {
        take(choice);
        if (close_explicitly()) return true;
      }
    if (options.treatment == LoopTreatment::kExplicit) return refuse_explicit();
    std::string why;
    for (const Partition& choice : choices) {
      take(choice);
      const std::string failure = prove();
      if (failure.empty()) return true;
      if (why.empty()) why = failure;
    }
    take(choices.front());
    return go_without_proof(why);
  }

  /// Multipliers meet constraints of velocities, all coordinates are kept; where the description asks for it velocities
  /// follow from independent ones, which must be proven.
  bool treat_velocities() {
    const model::LoopOptions& options = mechanism_.loop_options;
    plan_.reason = "constraints of velocities leave positions free";
    if (!plan_.is_named || options.treatment == LoopTreatment::kMultipliers) return true;
    const std::optional<Partition> partition = partition_of_velocities();
    if (!options.independent.empty() && !partition) return report_bad({});
    std::string why = why_not_reduced(constraints_, plan_.rows, partition, mechanism_);
    if (why.empty()) why = why_undefined(mechanism_, true);
    if (why.empty()) {
      take(*partition);
      plan_.reason.clear();
      if (close_explicitly()) return true;
      why = explicit_failure_;
    }
    return refuse("velocities are not proven to follow from independent ones", why);
  }

  std::optional<Partition> partition_of_velocities() const {
    const std::vector<Matrix> regular = regular_jacobians(), open = open_jacobians();
    const std::vector<std::size_t> named = named_independent();
    if (!named.empty()) return given_partition(regular, open, named);
    return choose_with_velocities(regular, open, bind_positions(constraints_, plan_.rows),
                                  velocity_groups(mechanism_), preferred_velocities(mechanism_, jacobians_));
  }

  /// Those that may be closed: the one that is named; otherwise the one that is conditioned best, and the one
  /// of the coordinates with a range, over which more can be proven.
  std::vector<Partition> partitions() const {
    const std::vector<Matrix> regular = regular_jacobians(), open = open_jacobians();
    const std::vector<std::size_t> named = named_independent();
    const std::vector<std::size_t> following = following_velocities(mechanism_);
    const bool all_follow = named.empty() && following.size() == plan_.rows.size() && !following.empty();
    std::optional<Partition> best;
    if (!named.empty()) best = given_partition(regular, open, named);
    if (all_follow)
      best = given_partition(regular, open, loops::all_but(following, layout_.velocity_count()));
    if (named.empty() && (!best || best->blocks.empty()))
      best = choose_partition(regular, open, velocity_groups(mechanism_),
                              preferred_velocities(mechanism_, jacobians_));
    if (!best) return {};
    std::vector<Partition> list = {*best};
    const std::vector<std::size_t> ranged = ranged_velocities(mechanism_);
    if (!named.empty() || ranged.size() != plan_.freedom || ranged == best->independent) return list;
    if (const auto other = given_partition(regular, open, ranged); other && other->conditioning > 0)
      list.push_back(*other);
    return list;
  }

  /// With these velocities independent.
  void take(const Partition& partition) {
    plan_.independent = partition.independent;
    plan_.blocks = partition.blocks;
    plan_.conditioning = partition.conditioning;
    for (Block& block : plan_.blocks) {
      for (std::size_t& row : block.rows) row = plan_.rows[row];
      block.binds_positions = bind_positions(constraints_, block.rows).front();
    }
    plan_.treatment = LoopTreatment::kPartitioned;
  }

  /// Why there is no proof for the choice taken; empty where there is one.
  std::string prove() {
    if (std::string why = why_undefined(mechanism_, false); !why.empty()) return why;
    const auto found = prove_regular(regularity_request(mechanism_, constraints_, plan_));
    if (const auto* why = std::get_if<std::string>(&found)) return *why;
    plan_.proof = std::get<RegularityProof>(found);
    return "";
  }

  /// A choice that is not proven is taken only where it is asked for, or where multipliers would need M⁻¹ of a
  /// singular M.
  bool go_without_proof(const std::string& why) {
    if (plan_.is_named && is_dead(closure_.in_units(jacobians_.front()), plan_.blocks)) return refuse_dead();
    if (plan_.is_named || !massless_.empty())
      return warn_unproven("the other coordinates follow from the independent ones", why);
    if (!plan_.reason.empty()) plan_.reason += "; ";
    plan_.reason += "no choice of independent coordinates proven: " + why;
    keep_all();
    return true;
  }

  bool refuse_dead() {
    return refuse("the initial state is a dead position: dependent velocities do not follow there",
                  "start elsewhere, name other independent coordinates, or use treatment = \"multipliers\"");
  }

  bool warn_unproven(const char* what, const std::string& why) {
    diagnostics_.warning(mechanism_.loop_options.where,
                         fmt::format("it is not proven that {}: {}", what, why),
                         "watch 'regularity' of State, declare ranges, or use treatment = \"multipliers\"");
    return true;
  }

  bool share() {
    plan_.sharing = sharing_rows(closure_.in_units(jacobians_), plan_.rows);
    return set_scales_of_multipliers(mechanism_, configurations_, jacobians_, plan_, diagnostics_);
  }

  void keep_all() {
    plan_.treatment = LoopTreatment::kMultipliers;
    plan_.independent.clear();
    plan_.blocks.clear();
    plan_.conditioning = 0;
  }

  /// False where there is no closed form.
  bool close_explicitly() {
    std::variant<ClosedForm, std::string> found = solve_positions();
    if (ClosedForm* form = std::get_if<ClosedForm>(&found)) {
      plan_.treatment = LoopTreatment::kExplicit;
      take_orders(*form);
      plan_.closed_form = std::move(*form);
      return true;
    }
    if (explicit_failure_.empty()) explicit_failure_ = std::get<std::string>(found);
    plan_.reason = "no closed form: " + explicit_failure_;
    return false;
  }

  bool refuse_explicit() { return refuse("the loops cannot be closed explicitly", explicit_failure_); }

  bool refuse(const char* what, const std::string& why) {
    diagnostics_.error(mechanism_.loop_options.where, what, why);
    return false;
  }

  std::variant<ClosedForm, std::string> solve_positions() const {
    if (std::string why = why_undefined(mechanism_, true); !why.empty()) return why;
    auto request = position_request(mechanism_, constraints_, plan_);
    if (auto* failure = std::get_if<std::string>(&request)) return std::move(*failure);
    auto& positions = std::get<ClosedFormRequest>(request);
    for (const Block& block : plan_.blocks) positions.eliminations.push_back(elimination_of(block));
    return closed_form(positions);
  }

  /// Complete pivoting at the start, where cofactors are dearer; none where a pivot is nearly lost at a
  /// configuration seen.
  Elimination elimination_of(const Block& block) const {
    if (block.rows.size() < 3) return {};
    return elimination_order(jacobians_, block.rows, block.dependents);
  }

  void take_orders(const ClosedForm& form) {
    for (std::size_t b = 0; b < plan_.blocks.size(); ++b) {
      const Elimination order = elimination_of(plan_.blocks[b]);
      if (!order.rows.empty() && form.has_pivots[b]) {
        plan_.blocks[b].rows = order.rows;
        plan_.blocks[b].dependents = order.columns;
        plan_.blocks[b].in_order = true;
      }
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
  Vector start_z_;
  std::vector<Configuration> configurations_;  ///< closed ones; the first is the start
  std::vector<Matrix> jacobians_;              ///< there
  std::vector<model::JointIndex> massless_;    ///< where the tree's mass matrix is singular
  std::string explicit_failure_;               ///< of the choice that is tried first
  LoopPlan plan_;
};

}  // namespace

std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                   support::Diagnostics& diagnostics) {
  if (mechanism.states.empty()) return Planner(mechanism, constraints, diagnostics).plan();
  const model::Mechanism held = without_states(mechanism);
  const bool led = model::motions_follow_states(mechanism);
  std::optional<LoopPlan> plan =
      Planner(held, led ? closure_programs(held) : constraints, diagnostics).plan();
  if (plan) add_states(mechanism, *plan);
  return plan;
}

std::optional<LoopPlan> plan_loops(const model::Mechanism& mechanism, support::Diagnostics& diagnostics) {
  if (mechanism.loops.empty()) return {};
  return plan_loops(mechanism, closure_programs(mechanism), diagnostics);
}

}  // namespace jourdain::loops
