// What is done with the equations of motion at one state, apart from writing them down.
#include <limits>

#include "reference/decompositions.hpp"
#include "reference/minimal.hpp"

namespace jourdain::reference {

template <class Scalar>
void widen_scales(Terms<Scalar>& terms) {
  const auto share = Scalar(kNaturalShare);
  const Eigen::Index n = terms.M.rows() - terms.state_count;
  if (n == 0) return;
  const VectorX<Scalar> size = terms.M_scale.diagonal().head(n).cwiseSqrt();
  for (VectorX<Scalar>* scale : {&terms.k_scale, &terms.q_scale}) {
    const Scalar relative = (scale->head(n).array() / size.array()).maxCoeff();
    scale->head(n) += share * relative * size;
  }
  terms.M_scale.topLeftCorner(n, n) += share * size * size.transpose();
}

template <class Scalar>
VectorX<Scalar> forward_dynamics(const Terms<Scalar>& terms) {
  const VectorX<Scalar> forces = terms.k_bar - terms.q_bar;
  return solved_by_ldlt<Scalar>(terms.M, forces);
}

template <class Scalar>
Scalar backward_error(const Terms<Scalar>& terms, const VectorX<Scalar>& zdot) {
  const VectorX<Scalar> residual = (terms.M * zdot - terms.k_bar + terms.q_bar).cwiseAbs();
  const VectorX<Scalar> scale = terms.M_scale * zdot.cwiseAbs() + terms.k_scale + terms.q_scale;
  Scalar worst = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (residual[i] == 0) continue;
    const Scalar ratio = residual[i] / scale[i];
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

template <class Scalar>
Scalar condition(const MatrixX<Scalar>& M) {
  if (M.size() == 0) return 1;
  // The smallest eigenvalue is the largest one of the inverse: where sizes differ by many orders, rounding of
  // the largest entries would hide it. Entries of the inverse are as exact as those of M scaled to a unit
  // diagonal allow.
  const VectorX<Scalar> d = M.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixX<Scalar> factor = positive_inverse<Scalar>(d.asDiagonal() * M * d.asDiagonal());
  if (!d.allFinite() || factor.size() == 0) return std::numeric_limits<Scalar>::infinity();
  return largest_eigenvalue<Scalar>(M) * largest_eigenvalue<Scalar>(d.asDiagonal() * factor * d.asDiagonal());
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                  \
  template VectorX<S> forward_dynamics(const Terms<S>&);         \
  template void widen_scales(Terms<S>&);                         \
  template S backward_error(const Terms<S>&, const VectorX<S>&); \
  template S condition(const MatrixX<S>&);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference
