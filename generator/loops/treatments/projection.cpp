#include "loops/treatments/projection.hpp"

#include "ir/compose.hpp"
#include "loops/treatments/multipliers.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::loops {

using ir::Builder;
using ir::LeafKind;
using ir::Signed;

namespace {

/// G z + g_t of the rows used, at the positions `y`.
Column opening_rate(Builder& builder, const LoopSystem& system, const Column& y) {
  const ConstraintValues there(builder, system, y);
  Column rate;
  for (const std::size_t r : system.plan.solved_rows()) {
    Signed sum = there.g_t(r);
    for (std::size_t k = 0; k < system.layout.velocity_count(); ++k)
      sum = builder.add(sum, builder.multiply(there.G(r, k), builder.leaf(LeafKind::kVelocity, k)));
    rate.push_back(sum);
  }
  return rate;
}

}  // namespace

ir::Program projection_program(const LoopSystem& system) {
  Builder builder;
  const ConstraintValues here(builder, system);
  const std::size_t n = system.layout.velocity_count();
  const std::vector<std::size_t> rows = system.plan.solved_rows();
  const MultiplierSolver solver(builder, system, tree_mass_matrix(builder, system), here, rows,
                                {system.plan.closing_regularisation, 0});
  const auto correction = [&](const Column& c) {
    const Column forces = solver.corrections(c);
    return solver.accelerations(Column(n, builder.literal(0)), forces);
  };
  Column g;
  for (const std::size_t r : rows) g.push_back(here.g(r));
  const Column d = correction(g);
  const Column y = displaced(builder, system.layout.tangent, position_leaves(builder, system), d);
  for (std::size_t i = 0; i < y.size(); ++i) builder.output("y", static_cast<int>(i), -1, y[i]);
  const Column change = correction(opening_rate(builder, system, y));
  Signed opening = builder.literal(0);
  for (std::size_t k = 0; k < n; ++k) {
    builder.output("z", static_cast<int>(k), -1,
                   builder.add(builder.leaf(LeafKind::kVelocity, k), change[k]));
    opening = builder.add(opening, builder.multiply(d[k], d[k]));
  }
  const ir::Program& misses = system.constraints.misses;
  const Column found = ir::insert(builder, misses);
  for (std::size_t k = 0; k < found.size(); ++k)
    opening = builder.add(
        opening, misses.outputs[k].name == "miss"
                     ? found[k]
                     : builder.function(support::Function::kWhereNegative, found[k], builder.literal(1)));
  const Signed share = builder.literal(1 / system.plan.determinant);
  builder.output("regularity", -1, -1, builder.multiply(share, solver.determinant()));
  builder.output("opening", -1, -1, opening);
  return passes::remove_dead_code(builder.finish("project"));
}

}  // namespace jourdain::loops
