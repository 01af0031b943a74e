// The mechanism as the derivation wants it: one link per moving joint, fixed joints merged, link frames on joint
// axes, inertial parameters regrouped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/statements.hpp"
#include "model/mechanism.hpp"

namespace jourdain::kinematics {

/// Mass distribution about the origin of a frame, in that frame's axes: mass m = ∫dm (kg), first moment h = ∫x dm
/// (kg m), second moment S = ∫x xᵀ dm (kg m²). The inertia tensor is J = tr(S) 1 − S.
struct MassMoments {
  Ex mass = 0;
  Vector3 first = zero_vector();
  Matrix3 second = zero_matrix();
};

MassMoments operator+(const MassMoments& a, const MassMoments& b);

/// The same mass distribution seen from another frame, in which this frame has origin `r` and orientation `R`.
/// Intermediates are bound.
MassMoments moved(const MassMoments& moments, const Matrix3& R, const Vector3& r, Statements& statements);

inline constexpr std::size_t kGround = static_cast<std::size_t>(-1);

/// What one link adds to the motion of its parent; every joint is a chain of these (`joint_steps`).
enum class LinkKind {
  kTurn,   ///< rotates by sign·y about z
  kSlide,  ///< moves by sign·y along z
  kScrew,  ///< both: rotates by sign·y about z and moves by pitch·sign·y along it
  kCurve,  ///< its origin moves on a space curve, without turning
  kBall,   ///< rotates by a quaternion
  kFree    ///< moves and rotates freely in the inertial frame
};

/// A moving body. Its frame L has z on the joint axis (reversed where `sign` is −1) of a turn, slide or screw.
struct Link {
  std::string name;
  LinkKind kind = LinkKind::kTurn;
  model::JointIndex joint;
  std::size_t coordinate = 0;    ///< scalar coordinate of the joint (turn, slide, screw, curve)
  std::size_t parent = kGround;  ///< link, or kGround
  int sign = 1;
  bool parallel = false;  ///< z is parallel to the parent's z, and R_PL the identity
  Matrix3 R_PL;           ///< orientation in the parent's link frame P at y = 0
  Matrix3 R_LJ;           ///< orientation of the joint's frame in L at y = 0
  Vector3 r_PL;  ///< origin in P at y = 0; turn: foot of the perpendicular; slide: zero; far: the joint's
  Ex along = 0;  ///< turn, screw: how far along z the joint's origin is from that of L, m
  Ex pitch = 0;  ///< screw, m/rad
  Matrix3 R_PJ;  ///< curve: joint frame, in which the curve is given, in P
  /// Free: origin of L from the child's origin, child axes. A lone body's is its centre of mass, others' zero.
  Vector3 shift = zero_vector();
  MassMoments moments;

  bool turns_about_z() const { return kind == LinkKind::kTurn || kind == LinkKind::kScrew; }
  bool moves_along_z() const { return kind == LinkKind::kSlide || kind == LinkKind::kScrew; }
  bool has_quaternion() const { return kind == LinkKind::kBall || kind == LinkKind::kFree; }
};

/// Where a body's frame B sits: rigidly in link frame L of `link` (or in the inertial frame).
struct BodyPose {
  std::size_t link = kGround;
  Matrix3 R_LB = identity_matrix();
  Vector3 r_LB = zero_vector();
};

struct LinkTree {
  std::vector<Link> links;  ///< in the order of the coordinates; parents first
  MassMoments ground;       ///< what is fixed to the inertial frame
  Vector3 gravity;
  std::vector<BodyPose> bodies;  ///< by BodyIndex
  std::vector<MassMoments>
      body_moments;  ///< by BodyIndex, about the origin of the body's link, before regrouping

  std::size_t link_of(std::optional<model::BodyIndex> body) const {
    return body ? bodies[body->value].link : kGround;
  }
  /// Does a link turn about an axis parallel to that of its parent? Its rate is then that of the link itself.
  bool turns_beside_parent(std::size_t link) const;
};

struct LinkTreeOptions {
  bool regroup = true;  ///< move to the parent what a joint's motion does not feel (base inertial parameters)
  bool share_parallel = true;  ///< parallel consecutive revolute joints share one non-rotating frame
};

/// `parameters` are the symbols of the mechanism's parameters, in order. Values that depend on parameters are bound.
LinkTree build_link_tree(const model::Mechanism& mechanism, std::span<const Ex> parameters,
                         Statements& statements, const LinkTreeOptions& options);

}  // namespace jourdain::kinematics
