// One frame per link in which the recursions work: it sits at the link's origin and is parallel to the frame that the
// first of a run of parallel joints turns in, so that nothing is rotated between the links of such a run. Who takes
// vectors from link to link asks here and need not know of runs.
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

  std::size_t link_count() const { return tree_.links.size(); }
  std::size_t parent(std::size_t link) const { return tree_.links[link].parent; }

  const Ex& cosine(std::size_t link) const { return cosine_[link]; }
  const Ex& sine(std::size_t link) const { return sine_[link]; }

  /// Components in W of a vector given in L, and back. Bound as `name`. Nothing changes for kGround.
  Vector3 to_working(std::size_t link, const Vector3& v_L, const std::string& name) const;
  Vector3 to_link(std::size_t link, const Vector3& v_W, const std::string& name) const;

  /// Components in W of `link` of a vector given in W of its parent (or in the inertial frame). Bound as `name`.
  Vector3 from_parent(std::size_t link, const Vector3& v_parent, const std::string& name) const {
    return from_C_to_W(link, from_parent_to_C(link, v_parent, name + "p"), name);
  }
  /// The way back.
  Vector3 to_parent(std::size_t link, const Vector3& v_W, const std::string& name) const {
    return from_C_to_parent(link, from_W_to_C(link, v_W, name + "p"), name);
  }
  /// The same of a point: from the link's origin, and from its parent's.
  Vector3 point_to_parent(std::size_t link, const Vector3& x_W, const std::string& name) const;

  /// Both ways lead through C, where a link and its parent meet: at the parent's origin, in the axes of W of the parent
  /// if the link is in its run, of L of the parent otherwise (the inertial frame of a root). Bound as `name`.
  Vector3 from_parent_to_C(std::size_t link, const Vector3& v_parent, const std::string& name) const {
    return meets_in_W(link) ? v_parent : to_link(parent(link), v_parent, name);
  }
  Vector3 from_C_to_parent(std::size_t link, const Vector3& v_C, const std::string& name) const {
    return meets_in_W(link) ? v_C : to_working(parent(link), v_C, name);
  }
  Vector3 from_W_to_C(std::size_t link, const Vector3& v_W, const std::string& name) const {
    return meets_in_W(link) ? v_W : statements_.bind(name, R_CW_[link] * v_W);
  }
  Vector3 from_C_to_W(std::size_t link, const Vector3& v_C, const std::string& name) const {
    return meets_in_W(link) ? v_C : statements_.bind(name, transpose(R_CW_[link]) * v_C);
  }
  /// v_C = R_CW v_W: the identity within a run.
  const Matrix3& R_CW(std::size_t link) const { return R_CW_[link]; }
  /// Origin of the link from that of its parent, in C.
  const Vector3& r_CW(std::size_t link) const { return r_CW_[link]; }
  /// Whether C is W of the parent.
  bool meets_in_W(std::size_t link) const { return tree_.links[link].parallel; }

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
  std::vector<Matrix3> R_CW_;
  std::vector<Vector3> r_CW_, direction_, curvature_;
};

}  // namespace jourdain::kinematics
