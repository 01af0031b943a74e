// One frame per link in which the recursions work: it sits at the link's origin and is parallel to the frame that the
// first of a run of parallel joints turns in, so that nothing is rotated between the links of such a run.
#pragma once

#include <vector>

#include "kinematics/link_tree.hpp"

namespace jourdain::kinematics {

/// Working frame W_i of link i: origin of L_i, axes such that R_WL = Rz(angle_i) with angle_i the sum of the
/// coordinates of the parallel joints up to i (0 for a prismatic joint that starts a run).
class WorkingFrames {
 public:
  /// Binds sin and cos of each angle that is not zero: at most one pair per joint.
  WorkingFrames(const LinkTree& tree, const std::vector<Ex>& y, Statements& statements);

  const Ex& cosine(std::size_t link) const { return cosine_[link]; }
  const Ex& sine(std::size_t link) const { return sine_[link]; }

  /// Components in W of a vector given in L, and back. Bound as `name`.
  Vector3 to_working(std::size_t link, const Vector3& v_L, const std::string& name) const;
  Vector3 to_link(std::size_t link, const Vector3& v_W, const std::string& name) const;

  /// Components in W of `link` of a vector given in W of its parent (or in the inertial frame). Bound as `name`.
  Vector3 from_parent(std::size_t link, const Vector3& v, const std::string& name) const;

  /// Origin of `link` from its parent's origin: in W of the parent where the link is parallel to it, otherwise in L of
  /// the parent.
  const Vector3& offset(std::size_t link) const { return offset_[link]; }

 private:
  const LinkTree& tree_;
  Statements& statements_;
  std::vector<Ex> angle_, cosine_, sine_;
  std::vector<Vector3> offset_;
};

}  // namespace jourdain::kinematics
