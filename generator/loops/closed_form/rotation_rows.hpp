// The rows of a rotation in space taken apart: which vectors their coefficients are products of.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "loops/closed_form/near_states.hpp"
#include "loops/closed_form/polynomial.hpp"

namespace jourdain::loops {

/// Factors of a row's coefficients of R.
using RotationCoefficients = std::array<std::array<Scalar, 3>, 3>;

RotationCoefficients transposed(const RotationCoefficients& m);

/// b_k of matrices b_k vᵀ, and v.
struct Factors {
  std::vector<Vector3> left;
  Vector3 right;
};

/// Questions about polynomials of a rotation and one scalar unknown at most.
class RotationRows {
 public:
  RotationRows(ir::Builder& builder, const Samples& samples) : builder_(builder), samples_(samples) {}

 protected:
  Scalar number(double value) const { return {&builder_, builder_.literal(value)}; }
  double at_start(Scalar value) const { return initial(value, samples_); }

  Scalar coefficient(const Polynomial& row, const Monomial& powers) const;
  /// Of three rows.
  Vector3 column(const std::vector<Polynomial>& rows, const Monomial& powers) const;
  /// Of the entries of R times a factor.
  RotationCoefficients coefficients(const Polynomial& row, const Monomial& factor = kConstant) const;
  std::vector<RotationCoefficients> coefficients(const std::vector<Polynomial>& rows,
                                                 const Monomial& factor) const;

  /// Does the row have no terms but entries of R times some factors, and others?
  static bool only(const Polynomial& row, const std::vector<Monomial>& factors_of_rotation,
                   const std::vector<Monomial>& others);

  /// a / b, without a division where b is a number or a is a number times b.
  Scalar ratio(Scalar a, Scalar b) const;
  /// b_k vᵀ = W_k, with v along a row of one of them.
  std::optional<Factors> factored(const std::vector<RotationCoefficients>& list) const;
  /// The value, exactly as a number where it depends on nothing.
  Scalar folded(Scalar value) const;
  /// The value as a number: exact where it depends on nothing, otherwise that at the start.
  Scalar constant(Scalar value) const;
  /// Scaled so that the first of the left vectors has length 1, if it has `length` at the start and no
  /// parameter changes that.
  Factors scaled(Factors factors, Scalar length) const;
  bool is_orthonormal(const std::vector<Vector3>& B) const;

 private:
  /// A number times a value.
  struct Multiple {
    Scalar number, of;
  };
  Multiple multiple(Scalar a) const;
  /// As numbers, where they are multiples of one value.
  Vector3 without_common_factor(const Vector3& v) const;

  ir::Builder& builder_;
  const Samples& samples_;
};

}  // namespace jourdain::loops
