// One frame per link in which the recursions work: it sits at the link's origin and is parallel to the frame that the
// first of a run of parallel joints turns in, so that nothing is rotated between the links of such a run.
#pragma once

#include <vector>

#include "kinematics/link_states.hpp"
#include "kinematics/link_tree.hpp"

namespace jourdain::kinematics {

/// Working frame W_i of link i: origin of L_i, axes such that R_WL = Rz(angle_i) with angle_i the sum of the angles of
/// the parallel joints up to i (0 for a slide that starts a run, for balls and free links).
class WorkingFrames {
 public:
  /// Binds sin and cos of each angle that is not zero: at most one pair per joint.
  WorkingFrames(const LinkTree& tree, const std::vector<LinkState>& states, Statements& statements);

  const Ex& cosine(std::size_t link) const { return cosine_[link]; }
  const Ex& sine(std::size_t link) const { return sine_[link]; }

  /// Components in W of a vector given in L, and back. Bound as `name`. Nothing changes for kGround.
  Vector3 to_working(std::size_t link, const Vector3& v_L, const std::string& name) const;
  Vector3 to_link(std::size_t link, const Vector3& v_W, const std::string& name) const;

  /// Components in W of `link` of a vector given in W of its parent (or in the inertial frame). Bound as `name`.
  Vector3 from_parent(std::size_t link, const Vector3& v, const std::string& name) const;
  /// The way back.
  Vector3 to_parent(std::size_t link, const Vector3& v, const std::string& name) const;

  /// Orientation of W of `link` in L of its parent (the inertial frame), where the two are not parallel.
  const Matrix3& rotation(std::size_t link) const { return rotation_[link]; }

  /// Origin of `link` from its parent's origin: in W of the parent where the link is parallel to it, otherwise in L of
  /// the parent.
  const Vector3& offset(std::size_t link) const { return offset_[link]; }

  /// Translation of the link relative to its parent per unit of its rate, in W: z of a slide, pitch·z of a screw, the
  /// derivative of a curve, zero otherwise; and the change of it per unit of the squared rate.
  const Vector3& direction(std::size_t link) const { return direction_[link]; }
  const Vector3& curvature(std::size_t link) const { return curvature_[link]; }

 private:
  void set_angle(std::size_t link, const LinkState& state);
  void set_translation(std::size_t link, const LinkState& state);

  const LinkTree& tree_;
  Statements& statements_;
  std::vector<Ex> angle_, cosine_, sine_;
  std::vector<Matrix3> rotation_;
  std::vector<Vector3> offset_, direction_, curvature_;
};

}  // namespace jourdain::kinematics
