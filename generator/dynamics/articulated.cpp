#include "dynamics/articulated.hpp"

#include <fmt/format.h>

#include <optional>

namespace jourdain::dynamics {

using kinematics::Statements;

namespace {

ArticulatedInertia bound(const std::string& name, const ArticulatedInertia& inertia, Statements& statements) {
  return {statements.bind_symmetric(name + "A", inertia.A), statements.bind(name + "H", inertia.H),
          statements.bind_symmetric(name + "J", inertia.J)};
}

/// a bᵀ
Matrix3 outer(const Vector3& a, const Vector3& b) {
  Matrix3 M;
  for (std::size_t i = 0; i < 3; ++i) M[i] = a[i] * b;
  return M;
}

Matrix3 difference(const Matrix3& A, const Matrix3& B) {
  Matrix3 M;
  for (std::size_t i = 0; i < 3; ++i) M[i] = A[i] - B[i];
  return M;
}

/// [r], so that [r] x = r × x.
Matrix3 cross_matrix(const Vector3& r) { return {{{0, -r[2], r[1]}, {r[2], 0, -r[0]}, {-r[1], r[0], 0}}}; }

/// Position of the only entry of a vector that is not the number 0, if that is ±1.
std::optional<std::size_t> unit_axis(const Vector3& v) {
  std::optional<std::size_t> axis;
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k].is_zero()) continue;
    if (axis || !kinematics::is_trivial(v[k])) return {};
    axis = k;
  }
  return axis;
}

/// R M Rᵀ
Matrix3 rotated(const Matrix3& R, const Matrix3& M, const std::string& name, Statements& statements) {
  return R * statements.bind(name, M * transpose(R));
}

/// Rz M Rzᵀ. With t = s (M_xx − M_yy) + c (M_xy + M_yx): M'_xx = M_xx − s t, M'_xy = c t − M_yx, M'_yx = c t − M_xy.
Matrix3 turned(const Matrix3& M, const Ex& c, const Ex& s, const std::string& name, Statements& statements) {
  const Ex e = statements.bind(name + "e", M[0][1] + M[1][0]);
  const Ex d = statements.bind(name + "d", M[0][0] - M[1][1]);
  const Ex t = statements.bind(name + "t", s * d + c * e);
  const Ex trace = statements.bind(name + "p", M[0][0] + M[1][1]);
  const Ex ct = statements.bind(name + "ct", c * t);
  Matrix3 T;
  T[0][0] = statements.bind(name + "_xx", M[0][0] - s * t);
  T[1][1] = trace - T[0][0];
  T[0][1] = ct - M[1][0];
  T[1][0] = ct - M[0][1];
  T[0][2] = c * M[0][2] - s * M[1][2];
  T[1][2] = s * M[0][2] + c * M[1][2];
  T[2][0] = c * M[2][0] - s * M[2][1];
  T[2][1] = s * M[2][0] + c * M[2][1];
  T[2][2] = M[2][2];
  return T;
}

}  // namespace

ArticulatedInertia rigid_inertia(const CompositeBody& body) {
  const Vector3& h = body.moments.first;
  const Matrix3& S = body.moments.second;
  ArticulatedInertia inertia;
  for (std::size_t k = 0; k < 3; ++k) inertia.A[k][k] = body.moments.mass;
  inertia.H = cross_matrix(Ex(-1) * h);
  inertia.J = {
      {{body.J_xx, -S[0][1], -S[0][2]}, {-S[0][1], body.J_yy, -S[1][2]}, {-S[0][2], -S[1][2], body.J_zz}}};
  return inertia;
}

ArticulatedInertia sum(const ArticulatedInertia& a, const ArticulatedInertia& b, const std::string& name,
                       Statements& statements) {
  return bound(name, {a.A + b.A, a.H + b.H, a.J + b.J}, statements);
}

Wrench product(const ArticulatedInertia& inertia, const Twist& twist) {
  return {inertia.A * twist.linear + inertia.H * twist.angular,
          transpose(inertia.H) * twist.linear + inertia.J * twist.angular};
}

ArticulatedInertia reduced(const ArticulatedInertia& inertia, const Wrench& G, const Wrench& share,
                           const std::string& name, Statements& statements) {
  return bound(name,
               {difference(inertia.A, outer(share.force, G.force)),
                difference(inertia.H, outer(share.force, G.moment)),
                difference(inertia.J, outer(share.moment, G.moment))},
               statements);
}

ArticulatedInertia give_way(const ArticulatedInertia& inertia, const Wrench& U, const Wrench& share,
                            const Twist& twist, const std::string& name, Statements& statements) {
  ArticulatedInertia rest = inertia;
  const auto angular = unit_axis(twist.angular), linear = unit_axis(twist.linear);
  const bool turns = angular && is_zero(twist.linear), moves = linear && is_zero(twist.angular);
  ArticulatedInertia result;
  result.A = difference(rest.A, outer(share.force, U.force));
  result.H = difference(rest.H, outer(share.force, U.moment));
  result.J = difference(rest.J, outer(share.moment, U.moment));
  for (std::size_t k = 0; k < 3; ++k) {
    if (turns) result.H[k][*angular] = result.J[k][*angular] = result.J[*angular][k] = 0;
    if (moves) result.H[*linear][k] = result.A[k][*linear] = result.A[*linear][k] = 0;
  }
  return bound(name, result, statements);
}

ArticulatedInertia moved_to_parent(const kinematics::WorkingFrames& frames, std::size_t i,
                                   const ArticulatedInertia& inertia, const std::string& name,
                                   Statements& statements) {
  const Matrix3& R = frames.R_CW(i);
  const ArticulatedInertia moved =
      bound(name + "R",
            {rotated(R, inertia.A, name + "RA", statements), rotated(R, inertia.H, name + "RH", statements),
             rotated(R, inertia.J, name + "RJ", statements)},
            statements);
  // Force = A (a − r × α) + H α; the moment gains r × force.
  const Matrix3 r = cross_matrix(frames.r_CW(i));
  const Matrix3 H = statements.bind(name + "H", difference(moved.H, moved.A * r));
  const Matrix3 lever = r * moved.H;
  const Matrix3 J = moved.J + (transpose(lever) + r * H);
  return {moved.A, H, statements.bind_symmetric(name + "J", J)};
}

ArticulatedInertia turned_to_working(const ArticulatedInertia& inertia, const Ex& c, const Ex& s,
                                     const std::string& name, Statements& statements) {
  if (s.is_zero()) return inertia;
  return bound(
      name,
      {turned(inertia.A, c, s, name + "A", statements), turned(inertia.H, c, s, name + "H", statements),
       turned(inertia.J, c, s, name + "J", statements)},
      statements);
}

}  // namespace jourdain::dynamics
