#include "loops/treatments/schur_factors.hpp"

#include <algorithm>
#include <utility>

namespace jourdain::loops {

using ir::Signed;

namespace {

/// Rows in an order in which elimination fills in little: the row with the fewest neighbours next (minimum
/// degree), `last` at the end.
std::vector<std::size_t> least_degree(std::vector<std::set<std::size_t>> neighbours,
                                      const std::vector<std::size_t>& last) {
  std::vector<std::size_t> order;
  std::vector<bool> done(neighbours.size(), false);
  for (const std::size_t r : last) done[r] = true;
  for (std::size_t step = last.size(); step < neighbours.size(); ++step) {
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
  order.insert(order.end(), last.begin(), last.end());
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

SchurFactors::SchurFactors(ir::Builder& builder, std::vector<Column> S, Column delta, SharingRows sharing)
    : builder_(builder),
      order_(least_degree(coupled_rows(builder, S), sharing.rows)),
      pivots_(S.size() - sharing.rows.size()),
      L_(S.size(), Column(S.size(), builder.literal(0))),
      inverse_pivots_(S.size()),
      delta_(std::move(delta)),
      sharing_(std::move(sharing)),
      trace_(builder.literal(1)) {
  for (std::size_t p = 0; p < pivots_; ++p) {
    const std::size_t k = order_[p];
    S[k][k] = builder.add(S[k][k], delta_[k]);
  }
  for (std::size_t p = 0; p < pivots_; ++p) eliminate(p, S);
  if (!sharing_.rows.empty()) invert_shared(S);
}

void SchurFactors::eliminate(std::size_t p, std::vector<Column>& S) {
  const std::size_t k = order_[p];
  inverse_pivots_[k] = builder_.divide(builder_.literal(1), S[k][k]);
  for (std::size_t q = p + 1; q < S.size(); ++q) {
    const std::size_t i = order_[q];
    if (builder_.is_literal(S[i][k], 0)) continue;
    L_[i][k] = builder_.multiply(S[i][k], inverse_pivots_[k]);
    for (std::size_t o = p + 1; o <= q; ++o) {
      const std::size_t j = order_[o];
      S[i][j] = S[j][i] = builder_.subtract(S[i][j], builder_.multiply(L_[i][k], S[j][k]));
    }
  }
}

/// W R W / (t² + t δ + δ²), t the trace: a share δ/t is left out to first order, as elsewhere, and nothing is
/// divided by zero.
void SchurFactors::invert_shared(const std::vector<Column>& S) {
  const auto weight = [&](std::size_t i) { return builder_.literal(sharing_.weights[i]); };
  const Signed delta = builder_.literal(sharing_.size);
  Signed trace = builder_.literal(0);
  for (std::size_t i = 0; i < sharing_.rows.size(); ++i)
    trace = builder_.add(trace, builder_.multiply(weight(i), S[sharing_.rows[i]][sharing_.rows[i]]));
  trace_ = builder_.add(trace, delta);
  const Signed square = builder_.multiply(delta, delta),
               size = builder_.add(builder_.multiply(trace, trace_), square),
               inverse = builder_.divide(builder_.literal(1), size);
  for (std::size_t i = 0; i < sharing_.rows.size(); ++i) {
    inverse_.emplace_back();
    for (std::size_t j = 0; j < sharing_.rows.size(); ++j) {
      const Signed second = weight(j), weights = builder_.multiply(weight(i), second);
      inverse_[i].push_back(
          builder_.multiply(builder_.multiply(weights, S[sharing_.rows[i]][sharing_.rows[j]]), inverse));
    }
  }
}

Column SchurFactors::shared(const Column& c) const {
  Column x;
  for (const Column& row : inverse_) {
    Signed sum = builder_.literal(0);
    for (std::size_t j = 0; j < row.size(); ++j)
      sum = builder_.add(sum, builder_.multiply(row[j], c[sharing_.rows[j]]));
    x.push_back(sum);
  }
  return x;
}

Column SchurFactors::solved(Column c) const {
  const std::size_t m = c.size();
  for (std::size_t p = 0; p < pivots_; ++p)
    for (std::size_t q = p + 1; q < m; ++q) {
      const std::size_t k = order_[p], i = order_[q];
      c[i] = builder_.subtract(c[i], builder_.multiply(L_[i][k], c[k]));
    }
  const Column last = shared(c);
  for (std::size_t i = 0; i < last.size(); ++i) c[sharing_.rows[i]] = last[i];
  for (std::size_t p = 0; p < pivots_; ++p)
    c[order_[p]] = builder_.multiply(c[order_[p]], inverse_pivots_[order_[p]]);
  for (std::size_t p = pivots_; p-- > 0;)
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
  for (std::size_t k = 0; k < inverse_pivots_.size(); ++k)
    if (std::find(sharing_.rows.begin(), sharing_.rows.end(), k) == sharing_.rows.end())
      inverse = builder_.multiply(inverse, inverse_pivots_[k]);
  return builder_.divide(trace_, inverse);
}

}  // namespace jourdain::loops
