// Factors of a symmetric positive definite matrix as operations of a program.
#pragma once

#include <vector>

#include "ir/builder.hpp"

namespace jourdain::ir {

using Column = std::vector<Signed>;

/// M = Lᵀ D L from the last row on; rows visit only those before them that M couples them with (branch-induced
/// sparsity, Featherstone).
class SymmetricFactors {
 public:
  /// `M` full, by row.
  SymmetricFactors(Builder& builder, std::vector<Column> M);

  /// Factors of which each entry that is not zero is a leaf of `builder`, numbered from `first`; `values` gets them.
  SymmetricFactors as_leaves(Builder& builder, std::size_t first, Column& values) const;

  const Column& inverse_D() const { return inverse_D_; }

  /// L⁻ᵀ x.
  Column lowered(Column x) const;
  /// L⁻¹ D⁻¹ x.
  Column raised(Column x) const;
  /// M⁻¹ x.
  Column solved(const Column& x) const { return raised(lowered(x)); }

 private:
  SymmetricFactors(Builder& builder, std::vector<Column> L, Column inverse_D)
      : builder_(builder), L_(std::move(L)), inverse_D_(std::move(inverse_D)) {}

  Builder& builder_;
  std::vector<Column> L_;
  Column inverse_D_;
};

}  // namespace jourdain::ir
