// Where something round touches ground that has a height over a plane.
#pragma once

#include <array>
#include <functional>

#include "dynamics/closure.hpp"

namespace jourdain::dynamics {

/// Something convex in the axes a₁, a₂, n of a plane: its farthest point against a direction m is −l E m/sqrt(m·E m)
/// from its centre. Of a ball l is the radius and E = 1, of a disc about w E = 1 − w wᵀ, of an ellipsoid l = 1 and
/// E = Σ rᵢ² eᵢ eᵢᵀ.
struct RoundShape {
  Ex size;
  kinematics::Matrix3 shape;
};

/// Of what rolls; `seen` gives the axes of the plane's components of a direction in `to`.
RoundShape round_shape(const Scene& scene, const model::Loop& loop,
                       const std::function<Vector3(const Vector3&)>& seen);

/// In the axes of the plane, but for numbers: the point that touches counts from the centre.
struct GroundTouch {
  Ex height;  ///< m, of the lowest point over the plane that touches the ground there
  Vector3 normal, lever;
  std::array<Vector3, 2> along;  ///< at right angles in that plane, the first over a₁
  Search search;                 ///< of the plane's point under it
};

/// For the height h(p) over the plane's point p = (p₁, p₂), m = (−h₁, −h₂, 1), q = l E m/sqrt(m·E m) and the centre c,
/// the ground is touched where p = (c₁ − q₁, c₂ − q₂). Newton's steps for that begin under the centre, `approaches` of
/// them:
///   (1 − P H) δ = c − q − p,  H the second derivatives of h, P = l (E − q qᵀ/l²)/sqrt(m·E m), all in the plane
/// They converge where the shape is more curved than the ground. The plane's `axes` are components in its frame.
GroundTouch touch_ground(const Scene& scene, const model::Loop& loop, const std::array<Vector3, 2>& axes,
                         const Vector3& centre, const RoundShape& round);

}  // namespace jourdain::dynamics
