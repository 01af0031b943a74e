// Composite bodies: a link with everything outward of it, seen as one rigid body at the current coordinates.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kinematics/working_frames.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;
using kinematics::Vector3;

/// A force with a moment about a point, or a linear with an angular momentum.
struct Wrench {
  Vector3 force = kinematics::zero_vector();
  Vector3 moment = kinematics::zero_vector();
};

inline Wrench operator+(const Wrench& a, const Wrench& b) { return {a.force + b.force, a.moment + b.moment}; }
inline Wrench operator*(const Ex& a, const Wrench& b) { return {a * b.force, a * b.moment}; }

/// Velocity field `linear` + `angular` × x of a rigid motion, x from the link's origin.
struct Twist {
  Vector3 angular = kinematics::zero_vector();
  Vector3 linear = kinematics::zero_vector();
};

/// Mass moments of a link and all links outward of it, about the link's origin, in its working frame.
struct CompositeBody {
  kinematics::MassMoments moments;
  Ex J_xx, J_yy, J_zz;  ///< moments of inertia; J_zz = S_xx + S_yy is that about the axis of a turn
};

/// How a link counts with its parent.
enum class Joins {
  kRigid,  ///< as part of one rigid body
  kMass,   ///< its mass alone, at its origin: the parent carries it without turning it
  kNot     ///< not at all, nor what is outward of it
};

/// One per link, inward by recursion.
std::vector<CompositeBody> derive_composites(const kinematics::LinkTree& tree,
                                             const kinematics::WorkingFrames& frames,
                                             kinematics::Statements& statements,
                                             const std::function<Joins(std::size_t link)>& joins);

/// Motion of a link relative to its parent per unit of one velocity, in W.
struct Column {
  Twist twist;
  std::optional<std::size_t> entry;  ///< in z; none where the coordinate is prescribed
};

/// By link: one per scalar coordinate, three for a ball, six (translations along W, then rotations) for a free link.
std::vector<std::vector<Column>> derive_columns(const kinematics::LinkTree& tree,
                                                const std::vector<kinematics::LinkState>& states,
                                                const kinematics::WorkingFrames& frames);

/// Momentum of the composite body moving as `twist`, about the link's origin, in W.
Wrench momentum(const CompositeBody& body, const Twist& twist);

/// Power of a wrench on a twist, both in the same axes and about the same point.
Ex power(const Wrench& wrench, const Twist& twist);

}  // namespace jourdain::dynamics
