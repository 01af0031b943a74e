#include "programs/loop_functions.hpp"

#include <map>

#include "ir/compose.hpp"
#include "loops/rows/regular_rows.hpp"
#include "loops/treatments/dependence.hpp"
#include "loops/treatments/projection.hpp"
#include "lowering/displacements.hpp"
#include "passes/rewrite.hpp"
#include "programs/closed_system.hpp"
#include "programs/constrained_equations.hpp"
#include "programs/loop_outputs.hpp"
#include "support/check.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::programs {

using ir::Builder;
using ir::FunctionId;
using ir::LeafKind;
using ir::name_of;
using ir::Program;
using ir::Signed;

namespace {

using support::subscript;

/// One program under construction.
class LoopProgram {
 public:
  explicit LoopProgram(const loops::LoopSystem& system) : system_(system), dependence_(builder_, system) {}

  Program finish(const std::string& name) { return passes::remove_dead_code(builder_.finish(name)); }

  void write_function(FunctionId function) {
    switch (function) {
      case FunctionId::kInitialState:
        return write_initial_state();
      case FunctionId::kPositionRate:
        return write("ydot", loops::position_rates(builder_, system_, dependence_.z()));
      case FunctionId::kMassMatrix:
        return write_mass_matrix();
      case FunctionId::kKBar:
        return write("k", k_bar());
      case FunctionId::kQBar:
        return write("q", dependence_.projected(vector(FunctionId::kQBar)));
      case FunctionId::kForwardDynamics:
        return write("zdot", zdot());
      case FunctionId::kInverseDynamics:
        return write("tau", dependence_.projected(vector(FunctionId::kInverseDynamics,
                                                         dependence_.accelerations(acceleration_leaves()))));
      case FunctionId::kKineticEnergy:
      case FunctionId::kPotentialEnergy:
        return write_energy(function);
      case FunctionId::kOutputs:
        return write_outputs(zdot());
      case FunctionId::kConstraintResidual:
        return write_constraint_residual();
      case FunctionId::kConstraintForces:
        return write("lambda", constraint_forces(zdot()));
      case FunctionId::kResidual:
        return write("r", residual(acceleration_leaves()));
      case FunctionId::kSample:
        return write_samples(builder_, system_, dependence_, insert(system_.tree(FunctionId::kSample), {}));
      case FunctionId::kCloseLoops:
      case FunctionId::kProject:
      case FunctionId::kResidualDerivatives:
      case FunctionId::kForwardDynamicsDerivatives:
      case FunctionId::kLinearize:
        break;
    }
    JD_CHECK(false, "'{}' is no function of velocities and forces", name_of(function));
  }

  /// With the accelerations as leaves.
  void write_outputs_at_accelerations() { write_outputs(acceleration_leaves()); }

  ir::Column zdot() {
    if (!system_.plan.is_reduced()) return solved_equations().motion().zdot;
    if (dependence_.independent_count() == 0) return {};
    return ir::SymmetricFactors(builder_, mass_matrix()).solved(forces());
  }

 private:
  void write(const char* name, const ir::Column& values) {
    for (std::size_t i = 0; i < values.size(); ++i) builder_.output(name, static_cast<int>(i), -1, values[i]);
  }

  /// A program of the tree with the velocities of this state, the accelerations `a` of the tree and multipliers.
  ir::Column insert(const Program& tree, const ir::Column& a, const ir::Column& lambda = {}) {
    return ir::insert(builder_, tree, [&](LeafKind kind, std::size_t i) -> std::optional<Signed> {
      if (kind == LeafKind::kVelocity) return dependence_.z()[i];
      if (kind == LeafKind::kAcceleration && !a.empty()) return a[i];
      if (kind == LeafKind::kMultiplier) return lambda[i];
      return {};
    });
  }

  ir::Column vector(FunctionId function, const ir::Column& a = {}) {
    return insert(system_.tree(function), a);
  }

  ir::Column acceleration_leaves() {
    ir::Column leaves;
    for (std::size_t i = 0; i < dependence_.independent_count(); ++i)
      leaves.push_back(builder_.leaf(LeafKind::kAcceleration, i));
    return leaves;
  }

  ir::Column times(const std::vector<ir::Column>& M, const ir::Column& x) {
    ir::Column y;
    for (const ir::Column& row : M) {
      Signed sum = builder_.literal(0);
      for (std::size_t k = 0; k < x.size(); ++k) sum = builder_.add(sum, builder_.multiply(row[k], x[k]));
      y.push_back(sum);
    }
    return y;
  }

  /// Bᵀ M B. With one degree of freedom twice the kinetic energy at z = B, where nothing else moves: that
  /// costs less than M. States have rows of a unit matrix.
  std::vector<ir::Column> mass_matrix() {
    const std::vector<ir::Column>& B = dependence_.B();
    const std::size_t states = system_.layout.state_count;
    if (B.size() == 1 + states && !model::time_dependence(system_.mechanism).positions) {
      const Signed T =
          ir::insert(builder_, system_.tree(FunctionId::kKineticEnergy), [&](LeafKind kind, std::size_t i) {
            return kind == LeafKind::kVelocity ? std::optional(B[0][i]) : std::nullopt;
          })[0];
      std::vector<ir::Column> M(B.size(), ir::Column(B.size(), builder_.literal(0)));
      M[0][0] = builder_.multiply(builder_.literal(2), T);
      for (std::size_t i = 1; i < B.size(); ++i) M[i][i] = builder_.literal(1);
      return M;
    }
    std::vector<ir::Column> M = loops::tree_mass_matrix(builder_, system_);
    if (!system_.plan.is_reduced()) return M;
    std::vector<ir::Column> reduced;
    for (const ir::Column& column : B) reduced.push_back(dependence_.projected(times(M, column)));
    return reduced;
  }

  /// k̄ − q̄ of the independent coordinates: minus the residual of the tree at ż = β.
  ir::Column forces() {
    ir::Column list = dependence_.projected(vector(FunctionId::kResidual, dependence_.beta()));
    for (Signed& entry : list) entry = -entry;
    return list;
  }

  ir::Column k_bar() {
    ir::Column tree = vector(FunctionId::kKBar);
    if (!system_.plan.is_reduced()) return tree;
    const ir::Column bias = times(loops::tree_mass_matrix(builder_, system_), dependence_.beta());
    ir::Column rows;
    for (std::size_t k = 0; k < tree.size(); ++k) rows.push_back(builder_.subtract(tree[k], bias[k]));
    return dependence_.projected(rows);
  }

  ir::Column residual(const ir::Column& zdot) {
    if (system_.plan.is_reduced())
      return dependence_.projected(vector(FunctionId::kResidual, dependence_.accelerations(zdot)));
    const ConstrainedEquations equations = solved_equations();
    return equations.residual(zdot, equations.motion().lambda);
  }

  ConstrainedEquations solved_equations() { return {builder_, system_, system_.plan.solved_rows()}; }

  /// All rows that agree with each other; where some share, those that are solved for.
  std::vector<std::size_t> rows_with_forces() const {
    if (!system_.plan.sharing.empty()) return system_.plan.solved_rows();
    return loops::all_but(system_.plan.disagreeing, system_.constraints.value.outputs.size());
  }

  /// λ over those rows, zero for the others.
  ir::Column least_multipliers() {
    const std::vector<std::size_t> rows = rows_with_forces();
    ir::Column lambda(system_.constraints.value.outputs.size(), builder_.literal(0));
    const ir::Column found = ConstrainedEquations(builder_, system_, rows).motion().lambda;
    for (std::size_t k = 0; k < rows.size(); ++k) lambda[rows[k]] = found[k];
    return lambda;
  }

  /// With reduced treatments what the dependent coordinates lack at the accelerations given; otherwise those
  /// of the state, over all rows: of redundant ones those of least norm.
  ir::Column constraint_forces(const ir::Column& zdot) {
    if (!system_.plan.is_reduced()) return least_multipliers();
    ir::Column missing = vector(FunctionId::kResidual, dependence_.accelerations(zdot));
    for (Signed& entry : missing) entry = -entry;
    return dependence_.multipliers(missing);
  }

  void write_energy(FunctionId function) {
    const Program tree = system_.tree(function);
    builder_.output(tree.outputs[0].name, -1, -1, insert(tree, {})[0]);
  }

  void write_mass_matrix() {
    const std::vector<ir::Column> M = mass_matrix();
    for (std::size_t i = 0; i < M.size(); ++i)
      for (std::size_t j = i; j < M.size(); ++j)
        builder_.output("M", static_cast<int>(i), static_cast<int>(j), M[i][j]);
  }

  void write_constraint_residual() {
    const loops::ConstraintValues constraints(builder_, system_);
    const ir::Column rate = loops::constraint_rates(builder_, system_, dependence_.z()).rate;
    for (std::size_t r = 0; r < rate.size(); ++r)
      builder_.output("g", static_cast<int>(r), -1, constraints.g(r));
    write("g_rate", rate);
  }

  /// Closed at the parameters' default values; what parameters give follows them where closing leaves it.
  void write_initial_state() {
    const loops::LoopPlan& plan = system_.plan;
    const Program tree = system_.tree(FunctionId::kInitialState);  // y, then z
    const ir::Column given = insert(tree, {});
    const auto put = [&](const char* name, std::size_t row, std::size_t entry, bool kept, double closed) {
      const bool follows = kept && tree[tree.outputs[entry].value].op != ir::Op::kLiteral;
      builder_.output(name, static_cast<int>(row), -1, follows ? given[entry] : builder_.literal(closed));
    };
    for (std::size_t i = 0; i < plan.y.size(); ++i) put("y", i, i, plan.kept_y[i], plan.y[i]);
    for (std::size_t j = 0; j < (plan.is_reduced() ? plan.independent.size() : plan.z.size()); ++j) {
      const std::size_t k = plan.is_reduced() ? plan.independent[j] : j;
      put("z", j, plan.y.size() + k, plan.kept_z[k], plan.z[k]);
    }
  }

  void write_outputs(const ir::Column& zdot) {
    const Program tree = system_.tree(FunctionId::kOutputs);
    const ir::Column forces = takes_multipliers(tree) ? constraint_forces(zdot) : ir::Column();
    const ir::Column values = insert(tree, dependence_.accelerations(zdot), forces);
    programs::write_outputs(builder_, system_, dependence_, tree, values);
  }

  const loops::LoopSystem& system_;
  Builder builder_;
  loops::Dependence dependence_;
};

/// Newton iterations block by block: each block is closed before the next one starts. Beside the dependent
/// positions "regularity", the determinants of the last iteration over LoopPlan::determinant, and "opening",
/// the square of what the first one changed.
Program closing_program(const loops::LoopSystem& system) {
  Builder builder;
  ir::Column y = loops::position_leaves(builder, system);
  std::vector<bool> dependent(system.layout.velocity_count(), false);
  Signed determinant = builder.literal(1 / system.plan.determinant), opening = builder.literal(0);
  for (const loops::Block& block : system.plan.blocks) {
    JD_CHECK(block.binds_positions, "what is carried along is not closed");
    for (const std::size_t k : block.dependents) dependent[k] = true;
    for (int i = 0; i < system.plan.iterations; ++i) {
      const loops::ConstraintValues values(builder, system, y);
      std::vector<ir::Column> A;
      ir::Column open;
      for (const std::size_t r : block.rows) {
        A.emplace_back();
        for (const std::size_t k : block.dependents) A.back().push_back(values.G(r, k));
        open.push_back(-values.g(r));
      }
      const loops::DenseSolver solver(builder, std::move(A));
      const ir::Column change = solver.solve(open);
      ir::Column displacement(dependent.size(), builder.literal(0));
      for (std::size_t k = 0; k < change.size(); ++k) displacement[block.dependents[k]] = change[k];
      y = loops::displaced(builder, system.layout.tangent, y, displacement);
      for (const Signed& entry : change)
        if (i == 0) opening = builder.add(opening, builder.multiply(entry, entry));
      if (i + 1 == system.plan.iterations) determinant = builder.multiply(determinant, solver.determinant());
    }
  }
  builder.output("regularity", -1, -1, determinant);
  builder.output("opening", -1, -1, opening);
  const auto write = [&](std::size_t entry) { builder.output("y", static_cast<int>(entry), -1, y[entry]); };
  for (const model::Tangent::Scalar& s : system.layout.tangent.scalars)
    if (dependent[s.velocity]) write(s.position);
  for (const model::Tangent::Scalar& s : system.layout.tangent.quaternions)
    for (std::size_t k = 0; dependent[s.velocity] && k < 4; ++k) write(s.position + k);
  return passes::remove_dead_code(builder.finish("close_loops"));
}

/// Adds ("beyond", i) to `close`: (y − low) (y − high) of the position with the i-th range.
Program with_ranges(const Program& close, const std::vector<loops::ProvenRange>& ranges) {
  Builder builder;
  std::map<std::size_t, Signed> found;
  const ir::Column values = ir::insert(builder, close);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ir::Output& output = close.outputs[i];
    builder.output(output.name, output.row, output.column, values[i]);
    if (output.name == "y") found[subscript(output.row)] = values[i];
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto moved = found.find(ranges[i].index);
    const Signed y =
        moved == found.end() ? builder.leaf(LeafKind::kPosition, ranges[i].index) : moved->second;
    const Signed above = builder.subtract(y, builder.literal(ranges[i].low)),
                 below = builder.subtract(y, builder.literal(ranges[i].high));
    builder.output("beyond", static_cast<int>(i), -1, builder.multiply(above, below));
  }
  return builder.finish(close.name);
}

}  // namespace

Program loop_program(const loops::LoopSystem& system, FunctionId function) {
  if (function == FunctionId::kProject) return loops::projection_program(system);
  if (function == FunctionId::kCloseLoops) {
    const Program close = system.plan.closed_form ? system.plan.closed_form->close : closing_program(system);
    const loops::ProvenBox* box = system.plan.proven();
    return box && !box->positions.empty() ? with_ranges(close, box->positions) : close;
  }
  LoopProgram program(system);
  program.write_function(function);
  return program.finish(name_of(function));
}

namespace {

/// Row `i` of a symmetric matrix whose upper triangle is a program's outputs.
Program row_of(const Program& M, std::size_t i, std::size_t size) {
  Program row = M;
  row.outputs.clear();
  for (std::size_t j = 0; j < size; ++j)
    for (const ir::Output& output : M.outputs)
      if (subscript(output.row) == std::min(i, j) && subscript(output.column) == std::max(i, j))
        row.outputs.push_back(output);
  return row;
}

Program outputs_at_accelerations(const loops::LoopSystem& system) {
  LoopProgram program(system);
  program.write_outputs_at_accelerations();
  return program.finish("outputs at accelerations");
}

Program carried_rates(const loops::LoopSystem& system) {
  Builder builder;
  const loops::Dependence dependence(builder, system);
  int row = 0;
  for (const std::size_t k : system.plan.carried()) builder.output("v", row++, -1, dependence.z()[k]);
  return passes::remove_dead_code(builder.finish("rates of what is carried along"));
}

/// Displacements of the independent coordinates, and of those carried along, move the dependent ones; so does time.
std::vector<ir::Seed> independent_seeds(const loops::LoopSystem& system, Builder& builder,
                                        std::size_t time_column) {
  const loops::Dependence dependence(builder, system);
  const std::vector<ir::Column> displacements = dependence.displacements();
  const ir::Column drift = dependence.drift();
  std::vector<ir::Seed> seeds;
  const auto add = [&](const ir::Seed& seed, std::size_t column, Signed share) {
    if (!builder.is_literal(share, 0))
      seeds.push_back({seed.leaf, column, builder.multiply(seed.partial, share)});
  };
  for (const ir::Seed& seed : lowering::displacement_seeds(builder, system.layout.tangent)) {
    for (std::size_t j = 0; j < displacements.size(); ++j) add(seed, j, displacements[j][seed.column]);
    add(seed, time_column, drift[seed.column]);
  }
  return seeds;
}

}  // namespace

DerivativeSources derivative_sources(const loops::LoopSystem& system) {
  DerivativeSources sources;
  sources.facts = scene_facts(system.mechanism, &system.plan);
  const std::size_t velocities = sources.facts.velocities.size();
  sources.residual = loop_program(system, FunctionId::kResidual);
  sources.load = sources.residual;
  sources.zdot = loop_program(system, FunctionId::kForwardDynamics);
  if (!system.mechanism.outputs.empty()) sources.outputs = outputs_at_accelerations(system);
  const Program M = loop_program(system, FunctionId::kMassMatrix);
  for (std::size_t i = 0; i < velocities; ++i) sources.mass_rows.push_back(row_of(M, i, velocities));
  if (!sources.facts.carried.empty()) sources.carried_rates = carried_rates(system);
  sources.position_seeds = [&system](Builder& builder, std::size_t time_column) {
    return independent_seeds(system, builder, time_column);
  };
  sources.searches = system.constraints.searches;
  if (!system.plan.is_reduced() && system.plan.sharing.empty())
    sources.constrained = constrained_motion(system);
  return sources;
}

}  // namespace jourdain::programs
