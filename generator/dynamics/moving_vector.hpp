// Vectors fixed to a link, and how they change as seen from a link further in.
#pragma once

#include <string>
#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// A vector in W of the link that sees it, with its derivatives by time in those axes. The second one is that at ż = 0.
struct MovingVector {
  Vector3 value = kinematics::zero_vector(), first = kinematics::zero_vector(),
          second = kinematics::zero_vector();
};

/// From one link inward to an ancestor, which is left out.
class InwardPath {
 public:
  InwardPath(Scene& scene, std::size_t link, std::size_t ancestor);

  /// Derivatives of a point with those positions from the origins of the links on the way, each in W; in W of
  /// the ancestor.
  MovingVector point(const std::vector<Vector3>& levers, const Vector3& position,
                     const std::string& name) const;
  /// A direction given in W of the outermost link.
  MovingVector direction(Vector3 v, const std::string& name) const;

 private:
  /// Adds what the motion of link j relative to its parent does to a vector with that value.
  void add_turning(std::size_t j, const Vector3& value, MovingVector& moving, const std::string& name) const;
  void add_sliding(std::size_t j, MovingVector& moving, const std::string& name) const;

  Scene& scene_;
  std::vector<std::size_t> links_;  ///< outermost first
};

MovingVector operator-(const MovingVector& a, const MovingVector& b);

/// u · w with its derivatives, the second at ż = 0.
kinematics::Taylor product(const MovingVector& u, const MovingVector& w);

}  // namespace jourdain::dynamics
