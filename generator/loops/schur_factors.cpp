#include "loops/schur_factors.hpp"

namespace jourdain::loops {

using ir::Signed;

namespace {

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

std::vector<std::set<std::size_t>> coupled_rows(const ir::Builder& builder, const std::vector<Column>& S) {
  std::vector<std::set<std::size_t>> neighbours(S.size());
  for (std::size_t r = 0; r < S.size(); ++r)
    for (std::size_t s = 0; s < S.size(); ++s)
      if (s != r && !builder.is_literal(S[r][s], 0)) neighbours[r].insert(s);
  return neighbours;
}

}  // namespace

SchurFactors::SchurFactors(ir::Builder& builder, std::vector<Column> S, Column delta)
    : builder_(builder),
      order_(least_degree(coupled_rows(builder, S))),
      L_(S.size(), Column(S.size(), builder.literal(0))),
      inverse_pivots_(S.size()),
      delta_(std::move(delta)) {
  const std::size_t m = S.size();
  for (std::size_t r = 0; r < m; ++r) S[r][r] = builder.add(S[r][r], delta_[r]);
  for (std::size_t p = 0; p < m; ++p) {
    const std::size_t k = order_[p];
    inverse_pivots_[k] = builder.divide(builder.literal(1), S[k][k]);
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t i = order_[q];
      if (builder.is_literal(S[i][k], 0)) continue;
      L_[i][k] = builder.multiply(S[i][k], inverse_pivots_[k]);
      for (std::size_t o = p + 1; o <= q; ++o) {
        const std::size_t j = order_[o];
        S[i][j] = S[j][i] = builder.subtract(S[i][j], builder.multiply(L_[i][k], S[j][k]));
      }
    }
  }
}

Column SchurFactors::solved(Column c) const {
  const std::size_t m = c.size();
  for (std::size_t p = 0; p < m; ++p)
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t k = order_[p], i = order_[q];
      c[i] = builder_.subtract(c[i], builder_.multiply(L_[i][k], c[k]));
    }
  for (std::size_t k = 0; k < m; ++k) c[k] = builder_.multiply(c[k], inverse_pivots_[k]);
  for (std::size_t p = m; p-- > 0;)
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t k = order_[p], i = order_[q];
      c[k] = builder_.subtract(c[k], builder_.multiply(L_[i][k], c[i]));
    }
  return c;
}

Column SchurFactors::corrected(const Column& c, int corrections) const {
  Column x = solved(c), last = x;
  for (int i = 0; i < corrections; ++i) {
    for (std::size_t r = 0; r < x.size(); ++r) last[r] = builder_.multiply(delta_[r], last[r]);
    last = solved(last);
    for (std::size_t r = 0; r < x.size(); ++r) x[r] = builder_.add(x[r], last[r]);
  }
  return x;
}

Signed SchurFactors::determinant() const {
  Signed inverse = builder_.literal(1);
  for (const Signed& pivot : inverse_pivots_) inverse = builder_.multiply(inverse, pivot);
  return builder_.divide(builder_.literal(1), inverse);
}

}  // namespace jourdain::loops
