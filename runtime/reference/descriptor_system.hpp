// Implementation of DescriptorReference: the index-1 system at one state. For descriptor.cpp only.
#pragma once

#include <optional>

#include "reference/descriptor.hpp"

namespace jourdain::reference {

using descriptor::JointRows;

template <class Scalar>
Eigen::Index coordinate_count(const JointRows<Scalar>& rows) {
  return rows.jacobian.rows() - rows.constraint_count;
}

/// Gradient c of a scalar coordinate: θ̇ = c x. Shape 6 nb.
template <class Scalar>
Eigen::VectorX<Scalar> gradient(const JointRows<Scalar>& rows, Eigen::Index coordinate) {
  return rows.jacobian.row(rows.constraint_count + coordinate).transpose();
}

/// The index-1 system at one state. Constraint rows are ordered joint by joint, constraints before prescribed
/// coordinates; then loop by loop.
template <class Scalar>
struct DescriptorReference<Scalar>::System {
  std::vector<AbsoluteBody<Scalar>> motions;
  std::vector<JointRows<Scalar>> joints;
  std::vector<Eigen::Index> first_row;           ///< of each joint's constraints in G
  Eigen::Index loop_row_count = 0;               ///< the last ones of G
  std::optional<Eigen::MatrixX<Scalar>> solved;  ///< combinations of all rows that are solved; none: the rows
  Eigen::MatrixX<Scalar> G;                      ///< rows × 6 nb
  Eigen::VectorX<Scalar> g, g_rate, gamma;       ///< g, G x + g_t, γ
  Eigen::MatrixX<Scalar> M;                      ///< 6 nb × 6 nb, with rotors
  Eigen::VectorX<Scalar> forces;                 ///< right-hand side of M ẋ + Gᵀ λ, 6 nb
  Eigen::VectorX<Scalar> state_rates;
  std::vector<Eigen::VectorX<Scalar>> joint_forces;  ///< by joint, its share Cᵀ Q of `forces`, 6 nb

  Eigen::Index joint_row_count() const { return G.rows() - loop_row_count; }
  /// Rows, or entries of a column over them, as they are solved.
  Eigen::MatrixX<Scalar> as_solved(const Eigen::MatrixX<Scalar>& rows) const {
    return solved ? Eigen::MatrixX<Scalar>(*solved * rows) : rows;
  }
};

}  // namespace jourdain::reference
