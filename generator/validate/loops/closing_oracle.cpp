#include "validate/loops/closing_oracle.hpp"

#include <algorithm>
#include <limits>

#include "loops/plan/schur_solution.hpp"
#include "loops/rows/dense_solver.hpp"
#include "support/matrix_index.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

using ir::LeafKind;

namespace {

using support::at;

using State = ir::LeafValues<ScaledReal>;

/// What the closing should make of a state.
struct Closed {
  std::vector<ScaledReal> y, z;
  ScaledReal regularity = 1, opening = 0;
  bool regularity_is_known = true;
  const char* oracle = "";
};

ExactMatrix mass_matrix(const LoopScene& scene, const State& state) {
  const dynamics::HighPrecision exact(scene.equations.statements, leaves_at(state));
  ExactMatrix M(at(scene.equations.M.size()), at(scene.equations.M.size()));
  for (std::size_t i = 0; i < scene.equations.M.size(); ++i)
    M.row(at(i)) = to_exact(exact.values(scene.equations.M[i])).transpose();
  return M;
}

/// M⁻¹-orthogonal projection, positions then velocities, both with the factors of the start.
Closed projected(const LoopScene& scene, const State& open) {
  const loops::LoopPlan& plan = scene.plan;
  const std::vector<std::size_t> rows = plan.solved_rows();
  const dynamics::ClosureJacobian jacobian = scene.closure.jacobian(open);
  const ExactMatrix G = to_exact(jacobian.G, scene.closure.velocity_count())(rows, Eigen::all);
  const ExactMatrix back = solved(mass_matrix(scene, open), G.transpose());
  const loops::SchurSolution schur(plan, rows, G * back, plan.closing_regularisation);
  const ExactVector g = to_exact(jacobian.g)(rows);
  const ExactVector change = -back * schur.solved(g);
  State moved = open;
  moved[LeafKind::kPosition] = scene.closure.displaced(open[LeafKind::kPosition], change);
  const std::vector<ScaledReal>& z = open[LeafKind::kVelocity];
  const ExactVector rate = to_exact(scene.closure.motion(moved, z).rate)(rows);
  Closed result;
  result.oracle = "the nearest closed state to first order";
  result.y = moved[LeafKind::kPosition];
  result.z = to_list(to_exact(z) - back * schur.solved(rate));
  result.regularity = schur.determinant() * ScaledReal(1 / plan.determinant);
  result.opening = change.squaredNorm() + scene.closure.missed(open);
  return result;
}

/// Newton's iterations, block by block.
Closed iterated(const LoopScene& scene, const State& open) {
  const loops::LoopPlan& plan = scene.plan;
  Closed result;
  result.oracle = "Newton's iterations";
  result.regularity = 1 / plan.determinant;
  State state = open;
  for (const loops::Block& block : plan.blocks)
    for (int i = 0; i < plan.iterations; ++i) {
      const dynamics::ClosureJacobian jacobian = scene.closure.jacobian(state);
      const ExactMatrix D =
          to_exact(jacobian.G, scene.closure.velocity_count())(block.rows, block.dependents);
      const ExactVector g = to_exact(jacobian.g)(block.rows);
      const ExactVector change = solved(D, -g);
      ExactVector d = ExactVector::Zero(at(scene.closure.velocity_count()));
      d(block.dependents) = change;
      state[LeafKind::kPosition] = scene.closure.displaced(state[LeafKind::kPosition], d);
      if (i == 0) result.opening += change.squaredNorm();
      if (i + 1 < plan.iterations) continue;
      const ScaledReal det = determinant(D);
      result.regularity *=
          block.dependents.size() <= loops::DenseSolver::kLargestByCofactors ? det : det * det;
    }
  result.y = state[LeafKind::kPosition];
  return result;
}

/// The closed state nearby.
Closed closed_by_form(const LoopScene& scene, const State& open) {
  Closed result;
  result.oracle = "the closed state nearby, by Newton's method to the end";
  result.y = scene.closure.closed(open)[LeafKind::kPosition];
  for (std::size_t i = 0; i < result.y.size(); ++i) {
    const ScaledReal moved = result.y[i] - open[LeafKind::kPosition][i];
    result.opening += moved * moved;
  }
  result.regularity_is_known = false;  // the discriminants are the closed form's own
  return result;
}

Closed closed(const LoopScene& scene, const State& open) {
  if (!scene.plan.is_reduced()) return projected(scene, open);
  return scene.plan.closed_form ? closed_by_form(scene, open) : iterated(scene, open);
}

ScaledReal beyond(const loops::LoopPlan& plan, const std::vector<ScaledReal>& y, int range) {
  const loops::ProvenRange& r = plan.proven()->positions[static_cast<std::size_t>(range)];
  return (y[r.index] - ScaledReal(r.low)) * (y[r.index] - ScaledReal(r.high));
}

}  // namespace

namespace {

/// The square of a change: where nothing changes it is the square of what rounding changes.
ScaledReal squared_change(const Closed& c) {
  long double scale = 1;
  for (const ScaledReal& entry : c.y) scale = std::max(scale, entry.scale());
  return c.opening.with_scale(std::numeric_limits<double>::epsilon() * scale * scale);
}

/// rad or m. A position that is zero but for what the numbers of the description disagree by is made of lengths and
/// directions that are larger than that.
constexpr long double kLeastScale = 1e-20L;

/// A closed form takes rotations of the description for orthonormal, and redundant rows for fulfilled: numbers that are
/// doubles are and do so but for their last digits.
constexpr long double kOfForms = 64 * std::numeric_limits<double>::epsilon();

Closed with_least_scales(Closed c) {
  for (ScaledReal& entry : c.y) entry = entry.with_scale(kLeastScale);
  return c;
}

}  // namespace

std::vector<Expected> closing_expected(const LoopScene& scene, const State& open,
                                       const ir::Program& program) {
  const Closed c = with_least_scales(closed(scene, open));
  Expected expected{c.oracle, {}, scene.plan.closed_form.has_value()};
  if (scene.plan.closed_form) expected.allowed = kOfForms;
  // Determinants of velocities are over those at the start, and may be larger elsewhere.
  if (!scene.closure.carried().empty()) expected.largest_share = std::numeric_limits<double>::max();
  for (const ir::Output& output : program.outputs) {
    const auto i = static_cast<std::size_t>(std::max(output.row, 0));
    if (output.name == "regularity" && !c.regularity_is_known)
      expected.shares.push_back(expected.values.size());
    expected.values.push_back(output.name == "y"            ? c.y[i]
                              : output.name == "z"          ? c.z[i]
                              : output.name == "regularity" ? c.regularity
                              : output.name == "opening"    ? squared_change(c)
                                                            : beyond(scene.plan, c.y, output.row));
  }
  return {expected};
}

ScaledReal opening(const LoopScene& scene, const State& state) {
  ScaledReal largest;
  const ExactVector g = scene.closure.g(state)(scene.plan.solved_rows());
  for (const ScaledReal& entry : g)
    if (abs(entry) > largest) largest = abs(entry);
  return largest;
}

}  // namespace jourdain::validate
