#include "loops/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "loops/partition.hpp"
#include "loops/position_request.hpp"
#include "model/checks.hpp"
#include "model/loop_kinds.hpp"
#include "reference/minimal.hpp"

namespace jourdain::loops {

using model::LoopTreatment;
using support::shown;

namespace {

/// Configurations at which rows, freedom and conditioning are judged.
constexpr std::size_t kConfigurations = 48;
/// A dependent block that is conditioned worse at any of them goes to multipliers.
constexpr double kWorstConditioning = 2e-3;
/// Regularisation as a share of the largest entry of G M⁻¹ Gᵀ at the start, of rows with lengths.
constexpr double kRegularisation = 1e-7;

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
    if (!assemble()) return {};
    for (const Configuration& c : walk(closure_, start_, mechanism_, kConfigurations))
      jacobians_.push_back(closure_.jacobian(c));
    plan_.rows = regular_rows(jacobians_);
    for (std::size_t r = 0; r < names_.size(); ++r)
      if (std::find(plan_.rows.begin(), plan_.rows.end(), r) == plan_.rows.end())
        plan_.redundant.push_back(names_[r]);
    plan_.freedom = layout_.velocity_count() - plan_.rows.size();
    if (plan_.freedom == 0) {
      diagnostics_.error(mechanism_.loops.front().where, "the loops leave no degree of freedom",
                         fmt::format("{} coordinates, {} independent constraints", layout_.velocity_count(),
                                     plan_.rows.size()));
      return {};
    }
    set_lengths();
    if (!treat()) return {};
    return plan_;
  }

 private:
  std::vector<bool> moving() const {
    std::vector<bool> list(layout_.velocity_count(), true);
    for (const std::size_t k : named_independent()) list[k] = false;
    return list;
  }

  std::vector<std::size_t> named_independent() const {
    std::vector<std::size_t> list;
    for (const auto& name : mechanism_.loop_options.independent)
      list.push_back(*layout_.joints[name.joint.value].velocity[name.coordinate]);
    return list;
  }

  bool assemble() {
    const auto initial = reference::Reference<long double>(mechanism_).initial_state();
    start_ = closure_.assembled({0, initial.y}, moving());
    const Vector g = closure_.value(start_);
    Eigen::Index worst = 0;
    const long double residual = g.cwiseAbs().maxCoeff(&worst);
    if (!(residual <= kClosed)) {
      report_open(static_cast<std::size_t>(worst), static_cast<double>(residual));
      return false;
    }
    for (const std::size_t loop : closure_.reversed(start_))
      diagnostics_.error(mechanism_.loops[loop].where,
                         fmt::format("loop '{}' closes with its axes against each other",
                                     shown(mechanism_.loops[loop].name)),
                         "turn 'to_axis' round, or start nearer to the configuration that is meant");
    if (!closure_.reversed(start_).empty()) return false;
    const Vector z = closure_.consistent(start_, initial.z, moving());
    const Vector rate = closure_.jacobian(start_) * z + closure_.time_rate(start_);
    const long double opening = rate.cwiseAbs().maxCoeff(&worst);
    if (!(opening <= 1e-10L * (1 + z.lpNorm<Eigen::Infinity>()))) {
      const std::size_t row = static_cast<std::size_t>(worst);
      const model::Loop& loop = loop_of(row);
      diagnostics_.error(
          loop.where, fmt::format("no velocities agree with loop '{}' at the start", shown(loop.name)),
          fmt::format(
              "the best ones found open constraint {} at {:.3g}/s{}: start from another configuration",
              names_[row], static_cast<double>(opening), held()));
      return false;
    }
    record(initial.y, start_.y, layout_.position_names, false, plan_.y);
    record(initial.z, z, layout_.velocity_names, true, plan_.z);
    return true;
  }

  const model::Loop& loop_of(std::size_t row) const {
    std::size_t loop = 0, first = 0;
    while (row >= first + model::row_count(mechanism_.loops[loop].type))
      first += model::row_count(mechanism_.loops[loop++].type);
    return mechanism_.loops[loop];
  }

  /// What the assembly may not move, as the end of a phrase.
  std::string held() const {
    std::vector<std::string> names;
    for (const std::size_t k : named_independent()) names.push_back(shown(layout_.velocity_names[k]));
    return names.empty() ? "" : fmt::format(" with {} as given", fmt::join(names, ", "));
  }

  void report_open(std::size_t row, double residual) {
    const model::Loop& loop = loop_of(row);
    diagnostics_.error(loop.where,
                       fmt::format("loop '{}' cannot be closed from the initial values", shown(loop.name)),
                       fmt::format("the nearest configuration found leaves constraint {} open by {:.3g}{}",
                                   names_[row], residual, held()));
  }

  void record(const Vector& before, const Vector& after, const std::vector<std::string>& names, bool velocity,
              std::vector<double>& values) {
    constexpr long double kNoticeable = 1e-12L;
    for (std::size_t i = 0; i < names.size(); ++i) {
      values.push_back(static_cast<double>(after[at(i)]));
      if (std::abs(after[at(i)] - before[at(i)]) > kNoticeable)
        plan_.moved.push_back({names[i], static_cast<double>(before[at(i)]), values.back(), velocity});
    }
  }

  void set_lengths() {
    reference::State<long double> state{0, start_.y, Vector::Zero(at(layout_.velocity_count()))};
    const auto terms = reference::Reference<long double>(mechanism_)
                           .evaluate(state, Vector::Zero(at(layout_.input_count())));
    const Matrix& G = jacobians_.front();
    const Vector S = (G * terms.M.ldlt().solve(G.transpose())).diagonal();
    std::vector<bool> is_length;
    for (const model::Loop& loop : mechanism_.loops)
      for (const model::LoopRow& row : model::loop_kind(loop.type).rows) is_length.push_back(row.is_length);
    long double largest = 0;
    for (std::size_t r = 0; r < names_.size(); ++r)
      if (is_length[r]) largest = std::max(largest, S[at(r)]);
    if (!(largest > 0)) largest = S.maxCoeff();
    for (std::size_t r = 0; r < names_.size(); ++r) {
      const bool scaled = !is_length[r] && S[at(r)] > kRankTolerance * largest;
      plan_.row_length.push_back(scaled ? static_cast<double>(std::sqrt(largest / S[at(r)])) : 1);
    }
    plan_.regularisation = kRegularisation * static_cast<double>(largest);
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

  bool treat() {
    const model::LoopOptions& options = mechanism_.loop_options;
    if (options.treatment == LoopTreatment::kMultipliers) {
      plan_.treatment = LoopTreatment::kMultipliers;
      return true;
    }
    std::vector<Matrix> regular;
    for (const Matrix& G : jacobians_) {
      Matrix part(at(plan_.rows.size()), G.cols());
      for (std::size_t k = 0; k < plan_.rows.size(); ++k) part.row(at(k)) = G.row(at(plan_.rows[k]));
      regular.push_back(part);
    }
    const std::vector<std::size_t> named = named_independent();
    const std::optional<Partition> partition =
        named.empty() ? choose_partition(regular, velocity_groups(mechanism_), preferred())
                      : given_partition(regular, named);
    const bool good = partition && partition->conditioning >= kWorstConditioning;
    if (!good && (options.treatment || !named.empty())) return report_bad(partition);
    if (!good) {
      plan_.reason =
          partition ? fmt::format("no choice of independent coordinates stays regular (conditioning {:.1g})",
                                  partition->conditioning)
                    : "no choice of independent coordinates stays regular";
      return true;
    }
    plan_.independent = partition->independent;
    plan_.blocks = partition->blocks;
    plan_.conditioning = partition->conditioning;
    for (Block& block : plan_.blocks)
      for (std::size_t& row : block.rows) row = plan_.rows[row];
    plan_.treatment = LoopTreatment::kPartitioned;
    return options.treatment == LoopTreatment::kPartitioned || close_explicitly();
  }

  /// Takes closed forms where there are some.
  bool close_explicitly() {
    std::variant<ClosedForm, std::string> found = solve_positions();
    if (ClosedForm* form = std::get_if<ClosedForm>(&found)) {
      plan_.treatment = LoopTreatment::kExplicit;
      plan_.closed_form = std::move(*form);
      return true;
    }
    plan_.reason = "no closed form: " + std::get<std::string>(found);
    if (mechanism_.loop_options.treatment != LoopTreatment::kExplicit) return true;
    diagnostics_.error(mechanism_.loop_options.where, "the loops cannot be closed explicitly",
                       std::get<std::string>(found));
    return false;
  }

  std::variant<ClosedForm, std::string> solve_positions() const {
    auto request = position_request(mechanism_, constraints_, plan_);
    if (auto* failure = std::get_if<std::string>(&request)) return std::move(*failure);
    return closed_form(std::get<ClosedFormRequest>(request));
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
    else if (partition->blocks.empty())
      diagnostics_.error(where, "the other coordinates do not follow from the independent ones",
                         "name others, or leave 'independent' out");
    else
      diagnostics_.error(
          where, "the dependent coordinates do not follow from the independent ones everywhere",
          (partition->conditioning > 0
               ? fmt::format(
                     "what is solved for them has a singular value of {:.1g} of the constraints' largest: ",
                     partition->conditioning)
               : std::string("they pass configurations where nothing can be solved for them: ")) +
              "declare the range of coordinates, or use treatment = \"multipliers\"");
    return false;
  }

  const model::Mechanism& mechanism_;
  const ConstraintPrograms& constraints_;
  support::Diagnostics& diagnostics_;
  model::CoordinateLayout layout_;
  NumericClosure closure_;
  std::vector<std::string> names_;
  Configuration start_;
  std::vector<Matrix> jacobians_;
  LoopPlan plan_;
};

}  // namespace

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
