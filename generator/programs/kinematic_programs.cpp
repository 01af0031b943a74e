#include "programs/kinematic_programs.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "dynamics/kinematic_functions.hpp"
#include "ir/compose.hpp"
#include "ir/symmetric_factors.hpp"
#include "loops/treatments/dependence.hpp"
#include "loops/treatments/multipliers.hpp"
#include "lowering/lower.hpp"
#include "model/kinematic_kinds.hpp"
#include "passes/rewrite.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain::programs {

using ir::Builder;
using ir::Column;
using ir::LeafKind;
using ir::Program;
using ir::Signed;
using model::KinematicQuantity;

namespace {

constexpr const char* kInverseInertia = "inverse_inertia";

Program lowered(const dynamics::Equations& equations, std::size_t k, const std::string& name) {
  std::vector<lowering::Target> targets;
  for (const dynamics::KinematicValues& array : equations.kinematics[k])
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      const int entry = static_cast<int>(i);
      if (array.values[i].is_zero()) continue;
      if (array.columns == 0)
        targets.push_back({array.name, entry, -1, array.values[i]});
      else
        targets.push_back({array.name, entry / array.columns, entry % array.columns, array.values[i]});
    }
  return lowering::lower(equations.statements, targets, name);
}

/// An array, full, by row; of a vector each row has one entry.
using Array = std::vector<Column>;
using Arrays = std::map<std::string, Array>;

Array zeros(Builder& builder, std::size_t rows, std::size_t columns) {
  return Array(rows, Column(columns, builder.literal(0)));
}

Signed product(Builder& builder, const Column& a, const Column& b) {
  Signed sum = builder.literal(0);
  for (std::size_t i = 0; i < a.size(); ++i) sum = builder.add(sum, builder.multiply(a[i], b[i]));
  return sum;
}

/// Declares the entries that are not zero.
void write(Builder& builder, const std::string& name, const Array& array, bool is_vector) {
  for (std::size_t i = 0; i < array.size(); ++i)
    for (std::size_t j = 0; j < array[i].size(); ++j)
      if (!builder.is_literal(array[i][j], 0))
        builder.output(name, static_cast<int>(i), is_vector ? -1 : static_cast<int>(j), array[i][j]);
}

/// Entries of the function's program, with values for its leaves.
Arrays inserted(Builder& builder, const dynamics::Equations& equations, std::size_t k, const Program& program,
                const ir::LeafValue& leaf) {
  Arrays arrays;
  for (const dynamics::KinematicValues& array : equations.kinematics[k])
    arrays[array.name] = zeros(builder, static_cast<std::size_t>(array.rows),
                               static_cast<std::size_t>(std::max(array.columns, 1)));
  const Column values = ir::insert(builder, program, leaf);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const ir::Output& output = program.outputs[i];
    arrays[output.name][static_cast<std::size_t>(output.row)]
          [static_cast<std::size_t>(std::max(output.column, 0))] = values[i];
  }
  return arrays;
}

/// J M⁻¹ Jᵀ with M = Lᵀ D L.
Array inverse_inertia(Builder& builder, const Array& J, const Array& M) {
  const ir::SymmetricFactors factors(builder, M);
  std::vector<Column> low, scaled;
  for (const Column& row : J) {
    low.push_back(factors.lowered(row));
    scaled.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i)
      scaled.back().push_back(builder.multiply(low.back()[i], factors.inverse_D()[i]));
  }
  Array result = zeros(builder, J.size(), J.size());
  for (std::size_t a = 0; a < J.size(); ++a)
    for (std::size_t b = a; b < J.size(); ++b)
      result[a][b] = result[b][a] = product(builder, low[a], scaled[b]);
  return result;
}

bool has_operational_inertia(const model::Mechanism& mechanism, std::size_t k) {
  const std::vector<KinematicQuantity>& list = mechanism.kinematics[k].quantities;
  return std::find(list.begin(), list.end(), KinematicQuantity::kInverseOperationalInertia) != list.end();
}

Array full(Builder& builder, const Program& M, std::size_t size) {
  Array rows = zeros(builder, size, size);
  const Column values = ir::insert(builder, M);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto row = static_cast<std::size_t>(M.outputs[i].row),
               column = static_cast<std::size_t>(M.outputs[i].column);
    rows[row][column] = rows[column][row] = values[i];
  }
  return rows;
}

/// One function of a mechanism with loops.
class ClosedKinematics {
 public:
  ClosedKinematics(const dynamics::Equations& equations, const loops::LoopSystem& system, std::size_t k)
      : equations_(equations),
        system_(system),
        k_(k),
        tree_(lowered(equations, k, system.mechanism.kinematics[k].name)),
        dependence_(builder_, system) {}

  Program program() {
    const Arrays given = at(given_accelerations()), free = at(dependence_.beta());
    for (const dynamics::KinematicValues& array : equations_.kinematics[k_]) {
      const std::string& name = array.name;
      if (name == dynamics::kOperationalJacobian)
        programs::write(builder_, kInverseInertia, operational(given.at(name)), false);
      else if (name.starts_with("drift"))
        programs::write(builder_, name, driven(given.at(name), given.at(matrix_of(name))), true);
      else if (is_matrix_per_velocity(name))
        programs::write(builder_, name, projected(given.at(name)), false);
      else if (name == "tau_gravity")
        write_forces(given.at(name));
      else
        programs::write(builder_, name, (name.starts_with("bias") ? free : given).at(name),
                        array.columns == 0);
    }
    return passes::remove_dead_code(builder_.finish(system_.mechanism.kinematics[k_].name));
  }

 private:
  Column given_accelerations() {
    Column leaves;
    for (std::size_t i = 0; i < dependence_.independent_count(); ++i)
      leaves.push_back(builder_.leaf(LeafKind::kAcceleration, i));
    return dependence_.accelerations(leaves);
  }

  Arrays at(const Column& zdot) {
    return inserted(builder_, equations_, k_, tree_,
                    [&](LeafKind kind, std::size_t i) -> std::optional<Signed> {
                      if (kind == LeafKind::kVelocity) return dependence_.z()[i];
                      if (kind == LeafKind::kAcceleration) return zdot[i];
                      return {};
                    });
  }

  static bool is_matrix_per_velocity(const std::string& name) {
    return name == "J" || name == "J_com" || name == "A";
  }
  static const char* matrix_of(const std::string& drift) {
    return drift == "drift" ? "J" : drift == "drift_com" ? "J_com" : "A";
  }

  Array projected(const Array& J) {
    Array rows;
    for (const Column& row : J) rows.push_back(dependence_.projected(row));
    return rows;
  }

  Array driven(Array drift, const Array& J) {
    for (std::size_t r = 0; r < drift.size(); ++r)
      drift[r][0] = builder_.add(drift[r][0], product(builder_, J[r], dependence_.b()));
    return drift;
  }

  void write_forces(const Array& tree) {
    Column rows;
    for (const Column& row : tree) rows.push_back(row[0]);
    Array forces;
    for (const Signed& entry : dependence_.projected(rows)) forces.push_back({entry});
    programs::write(builder_, "tau_gravity", forces, true);
  }

  Array operational(const Array& J) {
    const Array M = loops::tree_mass_matrix(builder_, system_);
    if (!system_.plan.is_reduced()) return constrained(J, M);
    Array reduced;
    for (const Column& column : dependence_.B()) {
      Column rows;
      for (const Column& row : M) rows.push_back(product(builder_, row, column));
      reduced.push_back(dependence_.projected(rows));
    }
    return inverse_inertia(builder_, projected(J), reduced);
  }

  /// What a unit force does where multipliers hold the loops.
  Array constrained(const Array& J, const Array& M) {
    const std::vector<std::size_t> rows = system_.plan.solved_rows();
    const loops::MultiplierSolver solver(builder_, system_, M, loops::ConstraintValues(builder_, system_),
                                         rows, {system_.plan.regularisation, system_.plan.corrections});
    Array result = zeros(builder_, J.size(), J.size());
    for (std::size_t a = 0; a < J.size(); ++a) {
      const Column pushed = solver.lowered(J[a]);
      const Column moved = solver.accelerations(pushed, solver.multipliers(solver.constrained(pushed)));
      for (std::size_t b = a; b < J.size(); ++b) result[a][b] = result[b][a] = product(builder_, J[b], moved);
    }
    return result;
  }

  const dynamics::Equations& equations_;
  const loops::LoopSystem& system_;
  std::size_t k_;
  Program tree_;
  Builder builder_;
  loops::Dependence dependence_;
};

}  // namespace

Program tree_kinematics(const dynamics::Equations& equations, const model::Mechanism& mechanism,
                        std::size_t k) {
  const Program program = lowered(equations, k, mechanism.kinematics[k].name);
  if (!has_operational_inertia(mechanism, k)) return program;
  Builder builder;
  const auto itself = [](LeafKind, std::size_t) { return std::optional<Signed>(); };
  const Arrays arrays = inserted(builder, equations, k, program, itself);
  for (const dynamics::KinematicValues& array : equations.kinematics[k]) {
    if (array.name != dynamics::kOperationalJacobian) {
      write(builder, array.name, arrays.at(array.name), array.columns == 0);
      continue;
    }
    const Array M = full(builder, lower_function(equations, ir::FunctionId::kMassMatrix), equations.M.size());
    write(builder, kInverseInertia, inverse_inertia(builder, arrays.at(array.name), M), false);
  }
  return passes::remove_dead_code(builder.finish(program.name));
}

Program loop_kinematics(const dynamics::Equations& equations, const loops::LoopSystem& system,
                        std::size_t k) {
  return ClosedKinematics(equations, system, k).program();
}

}  // namespace jourdain::programs
