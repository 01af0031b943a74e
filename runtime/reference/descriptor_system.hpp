// Implementation of DescriptorReference: the index-1 system at one state. For descriptor.cpp only.
#pragma once

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
/// coordinates.
template <class Scalar>
struct DescriptorReference<Scalar>::System {
  std::vector<AbsoluteBody<Scalar>> motions;
  std::vector<JointRows<Scalar>> joints;
  std::vector<Eigen::Index> first_row;               ///< of each joint's constraints in G
  Eigen::MatrixX<Scalar> G;                          ///< rows × 6 nb
  Eigen::VectorX<Scalar> g, g_rate, gamma;           ///< g, G x + g_t, γ
  Eigen::MatrixX<Scalar> M;                          ///< 6 nb × 6 nb, with rotors
  Eigen::VectorX<Scalar> forces;                     ///< right-hand side of M ẋ + Gᵀ λ, 6 nb
  std::vector<Eigen::VectorX<Scalar>> joint_forces;  ///< by joint, its share Cᵀ Q of `forces`, 6 nb
};

}  // namespace jourdain::reference
