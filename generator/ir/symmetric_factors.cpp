#include "ir/symmetric_factors.hpp"

namespace jourdain::ir {

SymmetricFactors::SymmetricFactors(Builder& builder, std::vector<Column> M)
    : builder_(builder), L_(M.size(), Column(M.size(), builder.literal(0))), inverse_D_(M.size()) {
  for (std::size_t k = M.size(); k-- > 0;) {
    inverse_D_[k] = builder.divide(builder.literal(1), M[k][k]);
    for (std::size_t i = k; i-- > 0;) {
      if (builder.is_literal(M[k][i], 0)) continue;
      L_[k][i] = builder.multiply(M[k][i], inverse_D_[k]);
      for (std::size_t j = i + 1; j-- > 0;)
        M[i][j] = builder.subtract(M[i][j], builder.multiply(L_[k][i], M[k][j]));
    }
  }
}

SymmetricFactors SymmetricFactors::as_leaves(Builder& builder, std::size_t first, Column& values) const {
  const auto leaf = [&](Signed value) {
    values.push_back(value);
    return builder.leaf(LeafKind::kHeld, first + values.size() - 1);
  };
  std::vector<Column> L = L_;
  Column inverse_D = inverse_D_;
  for (std::size_t k = 0; k < L.size(); ++k) {
    inverse_D[k] = leaf(inverse_D[k]);
    for (std::size_t i = 0; i < k; ++i)
      L[k][i] = builder_.is_literal(L[k][i], 0) ? builder.literal(0) : leaf(L[k][i]);
  }
  return {builder, std::move(L), std::move(inverse_D)};
}

Column SymmetricFactors::lowered(Column x) const {
  for (std::size_t k = x.size(); k-- > 0;)
    for (std::size_t i = k; i-- > 0;) x[i] = builder_.subtract(x[i], builder_.multiply(L_[k][i], x[k]));
  return x;
}

Column SymmetricFactors::raised(Column x) const {
  for (std::size_t k = 0; k < x.size(); ++k) {
    x[k] = builder_.multiply(inverse_D_[k], x[k]);
    for (std::size_t i = 0; i < k; ++i) x[k] = builder_.subtract(x[k], builder_.multiply(L_[k][i], x[i]));
  }
  return x;
}

}  // namespace jourdain::ir
