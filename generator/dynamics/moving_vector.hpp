// Vectors fixed to a link, and how they change as seen from a link further in.
#pragma once

#include "dynamics/points.hpp"

namespace jourdain::dynamics {

/// A vector in W of the link that sees it, with its derivatives by time in those axes. The second one is that at ż = 0.
struct MovingVector {
  Vector3 value = kinematics::zero_vector(), first = kinematics::zero_vector(),
          second = kinematics::zero_vector();
};

/// The point at the end of a path, in W of the ancestor.
MovingVector moving_point(const Scene& scene, const PointPath& path, const std::string& name);
/// A direction given in W of the outermost link of a path, in W of the ancestor.
MovingVector moving_direction(const Scene& scene, const PointPath& path, const Vector3& v_W,
                              const std::string& name);

MovingVector operator-(const MovingVector& a, const MovingVector& b);

/// u · w with its derivatives, the second at ż = 0.
kinematics::Taylor product(const MovingVector& u, const MovingVector& w);

}  // namespace jourdain::dynamics
