// Products of matrices as plain loops: those that Eigen makes of expressions take a compiler longer than all
// else in the references, and their matrices are small. Found where at least one of the operators below is in
// scope before Eigen's own.
#pragma once

#include <Eigen/Core>

#include <type_traits>

#include "reference/scaled_scalar.hpp"

namespace jourdain::reference {

template <class A>
concept DenseExpression = std::is_base_of_v<Eigen::MatrixBase<A>, A>;
template <class A>
concept ExactExpression = DenseExpression<A> && std::is_same_v<typename A::Scalar, support::ScaledReal>;

/// Entries where they are stored.
template <class Scalar>
struct StoredEntries {
  const Scalar* first;
  Eigen::Index down, across;
  const Scalar& operator()(Eigen::Index row, Eigen::Index column) const {
    return first[row * down + column * across];
  }
};

/// Added up in the order that Eigen takes: of three products the last two first.
template <int kInner, class Scalar>
Scalar row_times_column(const StoredEntries<Scalar>& a, const StoredEntries<Scalar>& b, Eigen::Index row,
                        Eigen::Index column, Eigen::Index inner) {
  if constexpr (kInner == 3)
    return a(row, 0) * b(0, column) + (a(row, 1) * b(1, column) + a(row, 2) * b(2, column));
  Scalar sum(0);
  for (Eigen::Index k = 0; k < inner; ++k) sum += a(row, k) * b(k, column);
  return sum;
}

/// Whether Eigen multiplies each sum by a factor, of one: that makes the sum a number of its own, which raises
/// the scale of a ScaledReal to its size. What emitted files say of errors shows it.
template <DenseExpression A, DenseExpression B>
bool counts_as_number(const A& a, const B& b) {
  constexpr Eigen::Index kLargestUnrolled = 20;  // EIGEN_GEMM_TO_COEFFBASED_THRESHOLD
  constexpr int kKind = Eigen::internal::product_type<A, B>::value;
  return kKind == Eigen::GemvProduct ||
         (kKind == Eigen::GemmProduct && a.rows() + a.cols() + b.cols() >= kLargestUnrolled);
}

template <DenseExpression A, DenseExpression B>
auto plain_product(const A& a, const B& b) {
  if constexpr (!(A::Flags & Eigen::DirectAccessBit)) {
    return plain_product(typename A::PlainObject(a), b);
  } else if constexpr (!(B::Flags & Eigen::DirectAccessBit)) {
    return plain_product(a, typename B::PlainObject(b));
  } else {
    using Scalar = typename A::Scalar;
    constexpr int kOfA = A::ColsAtCompileTime, kOfB = B::RowsAtCompileTime;
    constexpr int kInner = kOfA == Eigen::Dynamic ? kOfB : kOfA;
    const StoredEntries<Scalar> left{a.data(), a.rowStride(), a.colStride()};
    const StoredEntries<Scalar> right{b.data(), b.rowStride(), b.colStride()};
    Eigen::Matrix<Scalar, A::RowsAtCompileTime, B::ColsAtCompileTime> result(a.rows(), b.cols());
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (Eigen::Index j = 0; j < b.cols(); ++j)
        result(i, j) = row_times_column<kInner>(left, right, i, j, a.cols());
    if constexpr (ExactExpression<A>)
      if (counts_as_number(a, b)) result *= Scalar(1);
    return result;
  }
}

template <DenseExpression A, DenseExpression B>
requires(!ExactExpression<A>) auto operator*(const A& a, const B& b) { return plain_product(a, b); }

}  // namespace jourdain::reference

namespace jourdain::support {

template <reference::ExactExpression A, reference::ExactExpression B>
auto operator*(const A& a, const B& b) {
  return reference::plain_product(a, b);
}

}  // namespace jourdain::support
