#include "loops/treatments/dependence.hpp"

#include <numeric>

namespace jourdain::loops {

using ir::LeafKind;
using ir::Signed;

Dependence::Dependence(ir::Builder& builder, const LoopSystem& system)
    : builder_(builder), system_(system), independent_(system.plan.independent), values_(builder, system) {
  const std::size_t n = system.layout.velocity_count(), rows = system.constraints.value.outputs.size();
  if (!system.plan.is_reduced()) {
    independent_.resize(n);
    std::iota(independent_.begin(), independent_.end(), 0);
  }
  for (const Block& block : system.plan.blocks) {
    std::vector<Column> A;
    for (const std::size_t r : block.rows) {
      A.emplace_back();
      for (const std::size_t k : block.dependents) A.back().push_back(values_.G(r, k));
    }
    solvers_.emplace_back(builder, std::move(A), block.in_order);
  }
  const Column nothing(rows, builder.literal(0));
  z_.assign(n, builder.literal(0));
  b_ = beta_ = z_;
  for (std::size_t j = 0; j < independent_.size(); ++j) {
    Column known(n, builder.literal(0));
    known[independent_[j]] = builder.literal(1);
    B_.push_back(dependents(nothing, known));
    const Signed z = builder.leaf(LeafKind::kVelocity, j);
    for (std::size_t k = 0; k < n; ++k) z_[k] = builder.add(z_[k], builder.multiply(B_[j][k], z));
  }
  if (!system.plan.is_reduced()) return;
  Column opening;
  for (std::size_t r = 0; r < rows; ++r) opening.push_back(values_.g_t(r));
  b_ = dependents(opening, b_);
  for (std::size_t k = 0; k < n; ++k) z_[k] = builder.add(z_[k], b_[k]);
  beta_ = dependents(constraint_rates(builder, system, z_).gamma, beta_);
}

/// Solves G x + rows = 0 for the dependent entries of x, or for those that are closed.
Column Dependence::dependents(const Column& rows, const Column& known, bool positions_alone) const {
  Column x = known;
  for (std::size_t b = 0; b < solvers_.size(); ++b) {
    const Block& block = system_.plan.blocks[b];
    if (positions_alone && !block.binds_positions) continue;
    Column right;
    for (const std::size_t r : block.rows) {
      Signed sum = rows[r];
      for (std::size_t k = 0; k < x.size(); ++k)
        sum = builder_.add(sum, builder_.multiply(values_.G(r, k), x[k]));
      right.push_back(-sum);
    }
    const Column solution = solvers_[b].solve(right);
    for (std::size_t i = 0; i < solution.size(); ++i) x[block.dependents[i]] = solution[i];
  }
  return x;
}

std::vector<Column> Dependence::displacements() const {
  const std::vector<std::size_t> carried = system_.plan.carried();
  if (carried.empty()) return B_;
  const std::size_t n = z_.size();
  const Column nothing(system_.constraints.value.outputs.size(), builder_.literal(0));
  std::vector<Column> columns;
  for (const std::vector<std::size_t>& moved : {independent_, carried})
    for (const std::size_t k : moved) {
      Column known(n, builder_.literal(0));
      known[k] = builder_.literal(1);
      columns.push_back(dependents(nothing, known, true));
    }
  return columns;
}

Column Dependence::drift() const {
  if (system_.plan.carried().empty()) return b_;
  Column opening;
  for (std::size_t r = 0; r < system_.constraints.value.outputs.size(); ++r)
    opening.push_back(values_.g_t(r));
  return dependents(opening, Column(z_.size(), builder_.literal(0)), true);
}

Column Dependence::accelerations(const Column& zdot) const {
  Column a = beta_;
  for (std::size_t j = 0; j < B_.size(); ++j)
    for (std::size_t k = 0; k < a.size(); ++k)
      a[k] = builder_.add(a[k], builder_.multiply(B_[j][k], zdot[j]));
  return a;
}

Column Dependence::projected(const Column& rows) const {
  Column result;
  for (const Column& column : B_) {
    Signed sum = builder_.literal(0);
    for (std::size_t k = 0; k < rows.size(); ++k)
      sum = builder_.add(sum, builder_.multiply(column[k], rows[k]));
    result.push_back(sum);
  }
  return result;
}

Column Dependence::multipliers(Column forces) const {
  Column lambda(system_.constraints.value.outputs.size(), builder_.literal(0));
  for (std::size_t b = solvers_.size(); b-- > 0;) {
    const Block& block = system_.plan.blocks[b];
    Column right;
    for (const std::size_t k : block.dependents) right.push_back(forces[k]);
    const Column part = solvers_[b].solve_transposed(right);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::size_t r = block.rows[i];
      lambda[r] = part[i];
      for (std::size_t k = 0; k < forces.size(); ++k)
        forces[k] = builder_.subtract(forces[k], builder_.multiply(values_.G(r, k), part[i]));
    }
  }
  return lambda;
}

}  // namespace jourdain::loops
