// The mechanism as the derivation wants it: one link per moving joint, fixed joints merged, link frames on joint
// axes, inertial parameters regrouped.
#pragma once

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

/// A moving body. Its frame L has z on the joint axis (reversed where `sign` is −1), so that the link rotates by
/// sign·y about z or moves by sign·y along z.
struct Link {
  std::string name;
  bool revolute = true;
  std::size_t parent = kGround;  ///< link, or kGround
  int sign = 1;
  bool parallel = false;  ///< z is parallel to the parent's z, and R_PL the identity
  Matrix3 R_PL;           ///< orientation in the parent's link frame P at y = 0
  Vector3 r_PL;           ///< origin in P at y = 0; orthogonal to z (revolute) or zero (prismatic)
  MassMoments moments;
};

struct LinkTree {
  std::vector<Link> links;  ///< link i belongs to y[i], z[i]; parents first
  MassMoments ground;       ///< what is fixed to the inertial frame
  Vector3 gravity;
};

struct LinkTreeOptions {
  bool regroup = true;  ///< move to the parent what a joint's motion does not feel (base inertial parameters)
  bool share_parallel = true;  ///< parallel consecutive revolute joints share one non-rotating frame
};

/// `parameters` are the symbols of the mechanism's parameters, in order. Values that depend on parameters are bound.
LinkTree build_link_tree(const model::Mechanism& mechanism, std::span<const Ex> parameters,
                         Statements& statements, const LinkTreeOptions& options);

}  // namespace jourdain::kinematics
