#include "loops/plan/velocity_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/regular_rows.hpp"
#include "model/loop_kinds.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

bool is_velocity(const ir::Node& node) {
  return node.op == ir::Op::kLeaf && node.leaf == ir::LeafKind::kVelocity;
}

/// Whether that row of G depends on no velocity.
bool is_linear(const ConstraintPrograms& constraints, int row) {
  ir::Program G = constraints.jacobian;
  std::erase_if(G.outputs, [row](const ir::Output& entry) { return entry.row != row; });
  const ir::Program needed = passes::remove_dead_code(G);
  return std::none_of(needed.nodes.begin(), needed.nodes.end(), is_velocity);
}

}  // namespace

bool check_linear(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                  support::Diagnostics& diagnostics) {
  bool all_are = true;
  for (const ir::Output& output : constraints.velocities.outputs) {
    if (is_linear(constraints, output.row)) continue;
    const model::Loop& loop = model::loop_of_row(mechanism, support::subscript(output.row));
    diagnostics.error(loop.where, fmt::format("{} is not linear in velocities", in_words(loop)),
                      "rates may be multiplied by functions of t and positions, and added");
    all_are = false;
  }
  return all_are;
}

std::vector<std::size_t> kept_rows(const NumericClosure& closure,
                                   const std::vector<Configuration>& configurations) {
  const auto jacobians = [&](RowsOf rows) {
    std::vector<Matrix> list;
    for (const Configuration& c : configurations) list.push_back(closure.jacobian(c, rows));
    return closure.in_units(list);
  };
  const std::vector<std::size_t> of_positions =
      closure.binds_velocities() ? regular_rows(jacobians(RowsOf::kPositions)) : std::vector<std::size_t>();
  return regular_rows(jacobians(RowsOf::kAll), kRowTolerance, of_positions);
}

namespace {

/// What of redundant rows does not follow from the others; looked for where it is most.
class Redundancy {
 public:
  Redundancy(const model::Mechanism& mechanism, const NumericClosure& closure,
             const std::vector<std::size_t>& kept, support::Diagnostics& diagnostics)
      : mechanism_(mechanism),
        closure_(closure),
        kept_(kept),
        others_(all_but(kept, closure.row_count())),
        diagnostics_(diagnostics) {}

  bool check(const Configuration& c) const {
    for (const std::size_t row : others_)
      if (const long double rest = largest_rest(closure_.in_units(closure_.jacobian(c)), kept_, {row});
          rest > kFollows)
        return report(row, fmt::format("{} nearly follows from the others", in_words(loop_of(row))),
                      fmt::format("but for {:.1g} of them: strictly the mechanism loses a degree of freedom; "
                                  "write more digits, or leave it out",
                                  static_cast<double>(rest)));
    const Vector z = closure_.consistent(c, Vector::Zero(support::at(closure_.velocity_count())), {});
    Eigen::Index worst = 0;
    const long double rate = closure_.opening_rate(c, z).cwiseAbs().maxCoeff(&worst);
    if (rate <= kAgrees * (1 + z.lpNorm<Eigen::Infinity>())) return true;
    const auto row = static_cast<std::size_t>(worst);
    return report(
        row, fmt::format("no velocities agree with {} away from the start", in_words(loop_of(row))),
        fmt::format("constraints contradict each other, at t = {:.3g} s by {:.3g}/s in {}",
                    static_cast<double>(c.t), static_cast<double>(rate), row_names(mechanism_)[row]));
  }

 private:
  static constexpr long double kFollows = 1e-12L, kAgrees = 1e-9L;

  const model::Loop& loop_of(std::size_t row) const { return model::loop_of_row(mechanism_, row); }

  bool report(std::size_t row, const std::string& what, const std::string& hint) const {
    diagnostics_.error(loop_of(row).where, what, hint);
    return false;
  }

  const model::Mechanism& mechanism_;
  const NumericClosure& closure_;
  const std::vector<std::size_t>& kept_;
  std::vector<std::size_t> others_;
  support::Diagnostics& diagnostics_;
};

/// Whether the search for points finds them at the start; elsewhere it may miss them, with a warning.
bool check_searches(const model::Mechanism& mechanism, const NumericClosure& closure,
                    const std::vector<Configuration>& configurations, support::Diagnostics& diagnostics) {
  LoopPlan kept;
  kept.treatment = model::LoopTreatment::kMultipliers;
  const long double limit = std::sqrt(static_cast<long double>(kept.greatest_opening()));
  const auto finds = [&](const NumericClosure::Miss& miss) { return miss.length <= limit; };
  const auto tell = [&](const NumericClosure::Miss& miss, const char* where, auto say) {
    const model::Loop& loop = mechanism.loops[miss.loop];
    const std::string what =
        std::isinf(miss.length)
            ? fmt::format("the ground of {} is more curved {} than what rolls on it", in_words(loop), where)
            : fmt::format("where {} touches the ground is not found {}: the last approach is {:.1g} m",
                          in_words(loop), where, static_cast<double>(miss.length));
    (diagnostics.*say)(loop.where, what,
                       "ground must be less curved than what rolls on it; 'approaches' may be up to 20");
  };
  const NumericClosure::Miss first = closure.missed(configurations.front());
  if (!finds(first)) {
    tell(first, "at the start", &support::Diagnostics::error);
    return false;
  }
  for (const Configuration& c : configurations)
    if (const NumericClosure::Miss miss = closure.missed(c); !finds(miss)) {
      tell(miss, "at some states", &support::Diagnostics::warning);
      break;
    }
  return true;
}

}  // namespace

bool check_velocities(const model::Mechanism& mechanism, const NumericClosure& closure,
                      const std::vector<Configuration>& configurations, const std::vector<std::size_t>& kept,
                      support::Diagnostics& diagnostics) {
  const model::LoopOptions& options = mechanism.loop_options;
  if (options.treatment == model::LoopTreatment::kPartitioned) {
    diagnostics.error(options.where, "constraints of velocities are not met by iterations",
                      "treatment may be \"multipliers\" or, with independent velocities, \"explicit\"");
    return false;
  }
  if (!check_searches(mechanism, closure, configurations, diagnostics)) return false;
  const Redundancy redundancy(mechanism, closure, kept, diagnostics);
  return std::all_of(configurations.begin(), configurations.end(),
                     [&](const Configuration& c) { return redundancy.check(c); });
}

}  // namespace jourdain::loops
