#include "loops/multipliers.hpp"

#include <algorithm>
#include <set>

namespace jourdain::loops {

using ir::Signed;

namespace {

constexpr int kCorrections = 2;

/// Rows in an order in which elimination fills in little: the row with the fewest neighbours next (minimum degree).
std::vector<std::size_t> least_degree(std::vector<std::set<std::size_t>> neighbours) {
  std::vector<std::size_t> order;
  std::vector<bool> done(neighbours.size(), false);
  for (std::size_t step = 0; step < neighbours.size(); ++step) {
    std::size_t best = neighbours.size();
    for (std::size_t r = 0; r < neighbours.size(); ++r)
      if (!done[r] && (best == neighbours.size() || neighbours[r].size() < neighbours[best].size())) best = r;
    done[best] = true;
    order.push_back(best);
    for (const std::size_t a : neighbours[best]) {
      neighbours[a].erase(best);
      for (const std::size_t b : neighbours[best])
        if (a != b) neighbours[a].insert(b);
    }
  }
  return order;
}

}  // namespace

MultiplierSolver::MultiplierSolver(ir::Builder& builder, const LoopSystem& system,
                                   const std::vector<Column>& M, const ConstraintValues& constraints)
    : builder_(builder), mass_(builder, M) {
  for (std::size_t r = 0; r < system.constraints.value.outputs.size(); ++r) {
    Column row;
    for (std::size_t k = 0; k < M.size(); ++k) row.push_back(constraints.G(r, k));
    V_.push_back(lowered(row));
    const double length = system.plan.row_length[r];
    delta_.push_back(builder.literal(system.plan.regularisation / (length * length)));
  }
  factorise_schur();
}

void MultiplierSolver::factorise_schur() {
  const std::size_t m = V_.size(), n = mass_.inverse_D().size();
  std::vector<Column> S(m, Column(m, builder_.literal(0)));
  std::vector<std::set<std::size_t>> neighbours(m);
  for (std::size_t r = 0; r < m; ++r) {
    Column scaled;
    for (std::size_t k = 0; k < n; ++k) scaled.push_back(builder_.multiply(V_[r][k], mass_.inverse_D()[k]));
    for (std::size_t s = 0; s <= r; ++s) {
      for (std::size_t k = 0; k < n; ++k)
        S[r][s] = builder_.add(S[r][s], builder_.multiply(scaled[k], V_[s][k]));
      S[s][r] = S[r][s];
      if (s == r || builder_.is_literal(S[r][s], 0)) continue;
      neighbours[r].insert(s);
      neighbours[s].insert(r);
    }
    S[r][r] = builder_.add(S[r][r], delta_[r]);
  }
  order_ = least_degree(neighbours);
  S_.assign(m, Column(m, builder_.literal(0)));
  inverse_pivots_.resize(m);
  for (std::size_t p = 0; p < m; ++p) {
    const std::size_t k = order_[p];
    inverse_pivots_[k] = builder_.divide(builder_.literal(1), S[k][k]);
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t i = order_[q];
      if (builder_.is_literal(S[i][k], 0)) continue;
      S_[i][k] = builder_.multiply(S[i][k], inverse_pivots_[k]);
      for (std::size_t o = p + 1; o <= q; ++o) {
        const std::size_t j = order_[o];
        S[i][j] = S[j][i] = builder_.subtract(S[i][j], builder_.multiply(S_[i][k], S[j][k]));
      }
    }
  }
}

Column MultiplierSolver::schur_solved(Column c) const {
  const std::size_t m = c.size();
  for (std::size_t p = 0; p < m; ++p)
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t k = order_[p], i = order_[q];
      c[i] = builder_.subtract(c[i], builder_.multiply(S_[i][k], c[k]));
    }
  for (std::size_t k = 0; k < m; ++k) c[k] = builder_.multiply(c[k], inverse_pivots_[k]);
  for (std::size_t p = m; p-- > 0;)
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t k = order_[p], i = order_[q];
      c[k] = builder_.subtract(c[k], builder_.multiply(S_[i][k], c[i]));
    }
  return c;
}

/// After the first solution c − S λ is Δ λ, then Δ times the last correction.
Column MultiplierSolver::multipliers(const Column& c) const {
  Column lambda = schur_solved(c), correction = lambda;
  for (int i = 0; i < kCorrections; ++i) {
    for (std::size_t r = 0; r < c.size(); ++r) correction[r] = builder_.multiply(delta_[r], correction[r]);
    correction = schur_solved(correction);
    for (std::size_t r = 0; r < c.size(); ++r) lambda[r] = builder_.add(lambda[r], correction[r]);
  }
  return lambda;
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
