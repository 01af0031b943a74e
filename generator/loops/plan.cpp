#include "loops/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "loops/partition.hpp"
#include "loops/regular_rows.hpp"
#include "loops/scales.hpp"
#include "model/angles.hpp"
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
    if (!assemble()) return {};
    configurations_ = walk(closure_, start_, mechanism_, kConfigurations);
    for (const Configuration& c : configurations_) jacobians_.push_back(closure_.jacobian(c));
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
    set_scales(mechanism_, start_, jacobians_.front(), plan_);
    if (!treat()) return {};
    set_determinant(mechanism_, configurations_, jacobians_, plan_);
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
    const std::vector<std::size_t> named = named_independent();
    plan_.is_named = options.treatment || !named.empty();
    if (options.treatment == LoopTreatment::kMultipliers) return true;
    std::vector<Matrix> regular;
    for (const Matrix& G : jacobians_) {
      Matrix part(at(plan_.rows.size()), G.cols());
      for (std::size_t k = 0; k < plan_.rows.size(); ++k) part.row(at(k)) = G.row(at(plan_.rows[k]));
      regular.push_back(part);
    }
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

  /// A choice that is not proven is taken only where it is asked for.
  bool close_by_newton() {
    if (plan_.is_named)
      diagnostics_.warning(mechanism_.loop_options.where,
                           "it is not proven that the other coordinates follow from the independent ones "
                           "wherever the mechanism goes",
                           "watch 'regularity' of State, or use treatment = \"multipliers\"");
    else
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
    ClosedFormRequest request;
    request.g = constraints_.value;
    const model::Tangent tangent = model::tangent_of(mechanism_, layout_);
    for (const Block& block : plan_.blocks) {
      PositionBlock& positions = request.blocks.emplace_back();
      positions.rows = block.rows;
      for (const std::size_t velocity : block.dependents) {
        const auto scalar = std::find_if(tangent.scalars.begin(), tangent.scalars.end(),
                                         [&](const auto& s) { return s.velocity == velocity; });
        if (scalar == tangent.scalars.end()) return "a rotation in space depends on other coordinates";
        positions.dependents.push_back(scalar->position);
      }
    }
    request.initial_y = plan_.y;
    request.parameters = model::default_values(mechanism_);
    request.angular = model::angular_positions(mechanism_);
    request.range.resize(layout_.position_count());
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c)
        if (const auto entry = layout_.joints[j].position[c])
          request.range[*entry] = mechanism_.joints[j].coordinates[c].range;
    request.names = layout_.position_names;
    return closed_form(request);
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
