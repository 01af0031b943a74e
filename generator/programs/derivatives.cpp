#include "programs/derivatives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "ir/compose.hpp"
#include "ir/fingerprints.hpp"
#include "ir/symmetric_factors.hpp"
#include "passes/cheapest_elimination.hpp"
#include "passes/pipeline.hpp"
#include "passes/rewrite.hpp"
#include "programs/held_values.hpp"

namespace jourdain::programs {

using ir::Builder;
using ir::FunctionId;
using ir::JacobianEntries;
using ir::LeafKind;
using ir::name_of;
using ir::Program;
using ir::Signed;

namespace {

/// What the columns of a Jacobian stand for: displacements (one for each velocity, those of states displace nothing;
/// then of what is carried along), velocities, inputs, time.
struct Columns {
  std::size_t velocities = 0, states = 0, carried = 0, inputs = 0;
  bool time = false;  ///< something depends on it

  std::size_t moving() const { return velocities - states; }
  std::size_t displacements() const { return moving() + carried; }
  std::size_t velocity(std::size_t i) const { return velocities + carried + i; }
  std::size_t input(std::size_t i) const { return velocity(velocities) + i; }
  std::size_t time_column() const { return input(inputs); }
  /// Of a column of displacements or velocities its number in a linearisation, which leaves out what displaces nothing.
  std::size_t linear(std::size_t column) const { return column < velocities ? column : column - states; }
};

using ir::Column;
using Matrix = std::vector<Column>;  // by row

/// How accelerations are differentiated.
enum class Way {
  kEquations,  ///< the equations of motion, then solved with the factors of M; with multipliers those that these solve
  kAccelerations  ///< what solves them: −M⁻¹ r with constant factors; with multipliers what they are computed by
};

/// One program under construction.
class Assembly {
 public:
  Assembly(const DerivativeSources& sources, DerivativeTerms terms, Way way, std::optional<double> forward)
      : sources_(sources),
        constrained_(way == Way::kEquations && sources.constrained ? &*sources.constrained : nullptr),
        way_(way),
        terms_(terms),
        forward_(forward),
        columns_{sources.facts.velocities.size(), sources.facts.states.size(), sources.facts.carried.size(),
                 sources.facts.inputs.size(), sources.facts.time.any()} {}

  /// M and the derivatives of the residual.
  Program residual_derivatives() {
    write_matrix("M", mass_matrix());
    const bool all = terms_ == DerivativeTerms::kAll;
    write_residual_derivatives(differentiated(all ? sources_.residual : sources_.load));
    return finish(FunctionId::kResidualDerivatives);
  }

  Program forward_dynamics_derivatives() {
    const JacobianEntries J = acceleration_derivatives();
    write_vector("zdot", zdot_);
    for (const auto& [at, value] : J)
      if (at.second < columns_.input(0)) {
        const bool by_velocity = at.second >= columns_.velocity(0);
        write(by_velocity ? "zdot_z" : "zdot_y", at.first,
              at.second - (by_velocity ? columns_.velocity(0) : 0), value);
      }
    return finish(FunctionId::kForwardDynamicsDerivatives);
  }

  Program linearize() {
    const JacobianEntries J = acceleration_derivatives();
    write_kinematics();
    write_rates(J, columns_.displacements());
    write_outputs(J);
    return finish(FunctionId::kLinearize);
  }

 private:
  void write(const char* name, std::size_t row, std::size_t column, Signed value) {
    builder_.output(name, static_cast<int>(row), static_cast<int>(column), value);
  }

  void write_vector(const char* name, const Column& values) {
    for (std::size_t i = 0; i < values.size(); ++i) builder_.output(name, static_cast<int>(i), -1, values[i]);
  }

  void write_matrix(const char* name, const Matrix& M) {
    for (std::size_t i = 0; i < M.size(); ++i)
      for (std::size_t j = 0; j < M.size(); ++j)
        if (!is_zero(M[i][j])) write(name, i, j, M[i][j]);
  }

  bool is_zero(Signed value) const { return builder_.is_literal(value, 0); }

  /// Copies a program into this builder; accelerations are those of `zdot_` where that is not empty.
  Column insert(const Program& program) { return ir::insert(builder_, program, leaf_values()); }

  ir::LeafValue leaf_values() const {
    return [this](LeafKind kind, std::size_t i) -> std::optional<Signed> {
      if (kind == LeafKind::kHeld && i >= first_factor()) return factors_[i - first_factor()];
      if (kind == LeafKind::kAcceleration && !zdot_.empty()) return zdot_[i];
      return std::nullopt;
    };
  }

  Matrix mass_matrix() {
    Matrix M;
    for (const Program& row : sources_.mass_rows) M.push_back(insert(row));
    return M;
  }

  /// Where the columns enter: the derivatives of the leaves.
  std::vector<ir::Seed> seeds(Builder& builder) const {
    std::vector<ir::Seed> list = sources_.position_seeds(builder, columns_.time_column());
    const Signed one = builder.literal(1);
    for (std::size_t i = 0; i < columns_.velocities; ++i)
      list.push_back({builder.leaf(LeafKind::kVelocity, i), columns_.velocity(i), one});
    for (std::size_t i = 0; i < columns_.inputs; ++i)
      list.push_back({builder.leaf(LeafKind::kInput, i), columns_.input(i), one});
    if (columns_.time) list.push_back({builder.leaf(LeafKind::kTime, 0), columns_.time_column(), one});
    return list;
  }

  /// How accelerations and multipliers change with the columns: by velocity, then row.
  JacobianEntries changes_of_motion(Builder& builder, const Column& motion) const {
    Builder apart;  // where accelerations and multipliers are leaves
    const std::vector<ir::Seed> list = seeds(apart);
    const Column equations = ir::insert(apart, constrained_->equations);
    const JacobianEntries slopes =
        held_points(apart, sources_.searches, list, alone()).differentiated(apart, equations, list, alone());
    const std::size_t n = columns_.velocities;
    const auto instead = [n](const Column& of) {
      return [&of, n](LeafKind kind, std::size_t i) -> std::optional<Signed> {
        if (kind == LeafKind::kAcceleration) return of[i];
        return kind == LeafKind::kMultiplier ? std::optional(of[n + i]) : std::nullopt;
      };
    };
    const Column values = ir::insert(builder, jacobian_program(apart, slopes), instead(motion));
    std::vector<Column> right(columns_.time_column() + 1, Column(motion.size(), builder.literal(0)));
    std::size_t k = 0;
    for (const auto& [at, value] : slopes) right[at.second][at.first] = values[k++];
    JacobianEntries changes;
    for (std::size_t c = 0; c < right.size(); ++c) {
      const Column x = ir::insert(builder, constrained_->change, instead(right[c]));
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!builder.is_literal(x[i], 0)) changes[{i, c}] = x[i];
    }
    return changes;
  }

  /// Derivatives of `values` at constant accelerations, as values of this builder.
  JacobianEntries differentiated(const Program& values, bool by_acceleration = false) {
    // In a builder of its own, where ż is a leaf: accelerations inserted before would be followed to their own leaves.
    Builder builder;
    const Column outputs = ir::insert(builder, values);
    std::vector<ir::Seed> list = seeds(builder);
    const std::size_t first = columns_.time_column() + 1;
    for (std::size_t i = 0; by_acceleration && i < columns_.velocities; ++i)
      list.push_back({builder.leaf(LeafKind::kAcceleration, i), first + i, builder.literal(1)});
    HeldValues held = held_points(builder, sources_.searches, list, alone());
    if (constrained_) {
      const Column motion = ir::insert(builder, constrained_->motion);
      JacobianEntries changes;
      for (const auto& [at, change] : changes_of_motion(builder, motion))
        if (at.first >= columns_.velocities) changes[{at.first - columns_.velocities, at.second}] = change;
      held.add(builder,
               Column(motion.begin() + static_cast<std::ptrdiff_t>(columns_.velocities), motion.end()),
               changes);
    }
    return moved(builder, held.differentiated(builder, outputs, std::move(list), surroundings()));
  }

  /// Nothing but how an order is chosen.
  ir::Surroundings alone() const { return chosen({}); }

  /// What is here already, and what stands for accelerations and factors.
  ir::Surroundings surroundings() const { return chosen(ir::within(builder_.program(), leaf_values())); }

  ir::Surroundings chosen(ir::Surroundings result) const {
    result.is_thorough = true;
    result.forward = forward_;
    return result;
  }

  /// Values of `builder` as values of this builder.
  JacobianEntries moved(Builder& builder, const JacobianEntries& entries) {
    const Column values = insert(jacobian_program(builder, entries));
    JacobianEntries result;
    std::size_t k = 0;
    for (const auto& [at, value] : entries) result[at] = values[k++];
    return result;
  }

  /// Rows of A, B and ∂/∂t of what changes so, from a row on.
  void write_rates(const JacobianEntries& J, std::size_t first) {
    for (const auto& [at, value] : J) {
      const std::size_t row = first + at.first;
      if (at.second == columns_.time_column())
        builder_.output("rate_t", static_cast<int>(row), -1, value);
      else if (at.second >= columns_.input(0))
        write("B", row, at.second - columns_.input(0), value);
      else
        write("A", row, columns_.linear(at.second), value);
    }
  }

  void write_residual_derivatives(const JacobianEntries& J) {
    for (const auto& [at, value] : J) {
      const auto [row, column] = at;
      if (column == columns_.time_column())
        builder_.output("r_t", static_cast<int>(row), -1, value);
      else if (column >= columns_.input(0))
        write("r_u", row, column - columns_.input(0), value);
      else if (column >= columns_.velocity(0))
        write("r_z", row, column - columns_.velocity(0), value);
      else
        write("r_y", row, column, value);
    }
  }

  /// ∂ż by all columns.
  JacobianEntries acceleration_derivatives() {
    zdot_ = insert(sources_.zdot);
    if (constrained_) {
      Builder builder;
      JacobianEntries changes = changes_of_motion(builder, ir::insert(builder, constrained_->motion));
      changes.erase(changes.lower_bound({columns_.velocities, 0}), changes.end());
      return moved(builder, changes);
    }
    const ir::SymmetricFactors M(builder_, mass_matrix());
    return way_ == Way::kAccelerations ? solved_and_differentiated(M) : differentiated_and_solved(M);
  }

  /// ∂r/∂column by column, solved.
  JacobianEntries differentiated_and_solved(const ir::SymmetricFactors& M) {
    const JacobianEntries r = differentiated(sources_.residual);
    JacobianEntries J;
    for (std::size_t c = 0; c <= columns_.time_column(); ++c) {
      Column b(columns_.velocities, builder_.literal(0));
      for (std::size_t i = 0; i < b.size(); ++i)
        if (const auto entry = r.find({i, c}); entry != r.end()) b[i] = -entry->second;
      const Column x = M.solved(b);
      for (std::size_t i = 0; i < x.size(); ++i)
        if (!is_zero(x[i])) J[{i, c}] = x[i];
    }
    return J;
  }

  /// −M⁻¹ r with constant factors of M, by all columns: elimination may go through the solution in any order.
  JacobianEntries solved_and_differentiated(const ir::SymmetricFactors& M) {
    Builder apart;  // where the factors are leaves
    const ir::SymmetricFactors given = M.as_leaves(apart, first_factor(), factors_);
    Column forces;
    for (const Signed r : ir::insert(apart, sources_.residual)) forces.push_back(-r);
    const Column change = given.solved(forces);
    for (std::size_t i = 0; i < change.size(); ++i) apart.output("v", static_cast<int>(i), -1, change[i]);
    return differentiated(passes::remove_dead_code(apart.finish("changes")));
  }

  /// Leaves before it are found by searches.
  std::size_t first_factor() const { return sources_.searches.found.outputs.size(); }

  /// The upper half of A: displacements follow velocities; those of a quaternion turn with the body, δθ̇ = δω − ω × δθ.
  /// What is carried along has the velocity that it has.
  void write_kinematics() {
    const Signed one = builder_.literal(1);
    if (columns_.carried > 0) write_rates(differentiated(sources_.carried_rates), columns_.moving());
    for (std::size_t i = 0; i < columns_.moving(); ++i)
      write("A", i, columns_.linear(columns_.velocity(i)), one);
    for (const model::Tangent::Scalar& s : sources_.facts.tangent.quaternions)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t j = (k + 1) % 3, l = (k + 2) % 3;
        write("A", s.velocity + j, s.velocity + l, builder_.leaf(LeafKind::kVelocity, s.velocity + k));
        write("A", s.velocity + l, s.velocity + j, -builder_.leaf(LeafKind::kVelocity, s.velocity + k));
      }
  }

  /// C, D and ∂/∂t of the outputs; those that take accelerations by the chain rule.
  void write_outputs(const JacobianEntries& acceleration) {
    if (sources_.outputs.outputs.empty()) return;
    const JacobianEntries J = differentiated(sources_.outputs, true);
    const std::size_t first = columns_.time_column() + 1;
    JacobianEntries total;
    const auto add = [&](std::size_t row, std::size_t column, Signed term) {
      const auto [it, is_new] = total.try_emplace({row, column}, term);
      if (!is_new) it->second = builder_.add(it->second, term);
    };
    for (const auto& [at, value] : J) {
      if (at.second < first) {
        add(at.first, at.second, value);
        continue;
      }
      const auto row = acceleration.lower_bound({at.second - first, 0});
      for (auto it = row; it != acceleration.end() && it->first.first == at.second - first; ++it)
        add(at.first, it->first.second, builder_.multiply(value, it->second));
    }
    for (const auto& [at, value] : total) {
      if (is_zero(value)) continue;
      if (at.second == columns_.time_column())
        builder_.output("output_t", static_cast<int>(at.first), -1, value);
      else if (at.second >= columns_.input(0))
        write("D", at.first, at.second - columns_.input(0), value);
      else
        write("C", at.first, columns_.linear(at.second), value);
    }
  }

  /// Without entries of matrices that are 0 for all arguments, however they were derived: what is not given is 0.
  Program finish(FunctionId function) {
    Program program = passes::remove_dead_code(builder_.finish(name_of(function)));
    const std::optional<std::vector<ir::Fingerprint>> values = ir::fingerprints(program);
    if (!values) return program;
    std::erase_if(program.outputs, [&](const ir::Output& output) {
      return output.column >= 0 && (*values)[output.value.value].is_zero();
    });
    return passes::remove_dead_code(program);
  }

  const DerivativeSources& sources_;
  const ConstrainedMotion* constrained_;
  Way way_;
  DerivativeTerms terms_;
  std::optional<double> forward_;
  Columns columns_;
  Builder builder_;
  Column zdot_, factors_;
};

}  // namespace

bool any_derivatives(const std::vector<FunctionInfo>& functions) {
  return std::any_of(functions.begin(), functions.end(),
                     [](const FunctionInfo& function) { return function.holds_derivatives; });
}

namespace {

Program derivative_program(const DerivativeSources& sources, FunctionId function, DerivativeTerms terms,
                           Way way) {
  return passes::cheapest([&](const ir::Surroundings& by) {
    Assembly assembly(sources, terms, way, by.forward);
    if (function == FunctionId::kResidualDerivatives) return assembly.residual_derivatives();
    if (function == FunctionId::kForwardDynamicsDerivatives) return assembly.forward_dynamics_derivatives();
    JD_CHECK(function == FunctionId::kLinearize, "no derivatives for '{}'", name_of(function));
    return assembly.linearize();
  });
}

/// Whichever way takes fewer operations.
Program cheapest_program(const DerivativeSources& sources, FunctionId function, DerivativeTerms terms) {
  constexpr std::size_t kLarge = 10000;  // operations from which on the equations take fewer
  const auto program = [&](Way way) { return derivative_program(sources, function, terms, way); };
  Program by_equations = program(Way::kEquations);
  if (!sources.constrained && function == FunctionId::kResidualDerivatives) return by_equations;
  if (passes::remaining_operations(by_equations) >= kLarge) return by_equations;
  Program by_accelerations = program(Way::kAccelerations);
  const bool is_fewer =
      passes::emitted_operations(by_equations) <= passes::emitted_operations(by_accelerations);
  return is_fewer ? by_equations : by_accelerations;
}

}  // namespace

std::vector<Program> derivative_programs(const DerivativeSources& sources,
                                         const std::vector<FunctionInfo>& functions, DerivativeTerms terms) {
  std::vector<Program> programs;
  for (const FunctionInfo& function : functions) {
    if (!function.id || !function.holds_derivatives) continue;
    if (*function.id == FunctionId::kResidual)
      programs.push_back(sources.residual);
    else
      programs.push_back(cheapest_program(sources, *function.id, terms));
  }
  return programs;
}

}  // namespace jourdain::programs
