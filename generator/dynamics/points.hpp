// Points of links: where they are and how fast they move, seen from a link further in or from the inertial frame.
#pragma once

#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// A point fixed to a link, seen from an ancestor A of that link (kGround: the inertial frame).
struct PointPath {
  std::vector<std::size_t> links;  ///< from the point's link inward, A excluded
  std::vector<Vector3> levers;     ///< of the point from the origin of each of `links`, in its W
  Vector3 position;                ///< from the origin of A, in W of A
  Vector3 velocity;                ///< relative to A, in W of A
};

/// `x_L` in link axes from the link's origin.
PointPath follow_point(const Scene& scene, std::size_t link, const Vector3& x_L, std::size_t ancestor,
                       const std::string& name);

/// A vector of W of the ancestor in the working frames of each of `path.links`.
std::vector<Vector3> carry_outward(const Scene& scene, const PointPath& path, const Vector3& v,
                                   const std::string& name);

/// The last link that both are on or outward of; kGround where there is none.
std::size_t common_ancestor(const kinematics::LinkTree& tree, std::size_t a, std::size_t b);

/// Where a frame of the model sits in its link.
kinematics::BodyPose frame_pose(const Scene& scene, const model::Frame& frame);

}  // namespace jourdain::dynamics
