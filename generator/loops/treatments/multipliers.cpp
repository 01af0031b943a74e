#include "loops/treatments/multipliers.hpp"

#include <algorithm>

#include "loops/plan/sharing_rows.hpp"

namespace jourdain::loops {

using ir::Signed;

namespace {

Column diagonal(ir::Builder& builder, const LoopPlan& plan, const std::vector<std::size_t>& rows,
                double size) {
  Column delta;
  for (const std::size_t r : rows) {
    const bool shares = std::find(plan.sharing.begin(), plan.sharing.end(), r) != plan.sharing.end();
    const double part = plan.sharing.empty() || shares ? 1 : kBesideSharing;
    delta.push_back(builder.literal(part * size / (plan.row_length[r] * plan.row_length[r])));
  }
  return delta;
}

/// Those of `rows` that share.
SharingRows sharing(const LoopPlan& plan, const std::vector<std::size_t>& rows, double size) {
  SharingRows list{{}, {}, size};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::find(plan.sharing.begin(), plan.sharing.end(), rows[k]) == plan.sharing.end()) continue;
    list.rows.push_back(k);
    list.weights.push_back(plan.row_length[rows[k]] * plan.row_length[rows[k]]);
  }
  return list;
}

}  // namespace

MultiplierSolver::MultiplierSolver(ir::Builder& builder, const LoopSystem& system,
                                   const std::vector<Column>& M, const ConstraintValues& constraints,
                                   const std::vector<std::size_t>& rows, const Regularisation& regularisation)
    : builder_(builder),
      corrections_(regularisation.corrections),
      mass_(builder, M),
      V_(lowered_rows(constraints, rows)),
      schur_([&] {
        const Column weights = diagonal(builder, system.plan, rows, regularisation.size);
        return SchurFactors(builder, products(), weights, sharing(system.plan, rows, regularisation.size));
      }()) {}

std::vector<Column> MultiplierSolver::lowered_rows(const ConstraintValues& constraints,
                                                   const std::vector<std::size_t>& rows) const {
  std::vector<Column> V;
  for (const std::size_t r : rows) {
    Column row;
    for (std::size_t k = 0; k < mass_.inverse_D().size(); ++k) row.push_back(constraints.G(r, k));
    V.push_back(lowered(row));
  }
  return V;
}

/// S = V D⁻¹ Vᵀ.
std::vector<Column> MultiplierSolver::products() const {
  std::vector<Column> S(V_.size(), Column(V_.size(), builder_.literal(0)));
  for (std::size_t r = 0; r < V_.size(); ++r) {
    Column scaled;
    for (std::size_t k = 0; k < V_[r].size(); ++k)
      scaled.push_back(builder_.multiply(V_[r][k], mass_.inverse_D()[k]));
    for (std::size_t s = 0; s <= r; ++s) {
      for (std::size_t k = 0; k < scaled.size(); ++k)
        S[r][s] = builder_.add(S[r][s], builder_.multiply(scaled[k], V_[s][k]));
      S[s][r] = S[r][s];
    }
  }
  return S;
}

Column MultiplierSolver::constrained(const Column& lowered) const {
  Column scaled, result;
  for (std::size_t k = 0; k < lowered.size(); ++k)
    scaled.push_back(builder_.multiply(mass_.inverse_D()[k], lowered[k]));
  for (const Column& v : V_) {
    Signed sum = builder_.literal(0);
    for (std::size_t k = 0; k < v.size(); ++k) sum = builder_.add(sum, builder_.multiply(v[k], scaled[k]));
    result.push_back(sum);
  }
  return result;
}

Column MultiplierSolver::accelerations(const Column& lowered, const Column& lambda) const {
  Column x = lowered;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t r = 0; r < V_.size(); ++r)
      x[k] = builder_.subtract(x[k], builder_.multiply(V_[r][k], lambda[r]));
  return mass_.raised(x);
}

}  // namespace jourdain::loops
