// Composite bodies: a link with everything outward of it, seen as one rigid body at the current coordinates.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "dynamics/wrenches.hpp"

namespace jourdain::dynamics {

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

/// One per scalar coordinate, three for a ball, six (translations along W, then rotations) for a free link.
std::vector<Column> derive_columns(const kinematics::Link& link, const kinematics::LinkState& state,
                                   const kinematics::WorkingFrames& frames, std::size_t index);

/// Momentum of the composite body moving as `twist`, about the link's origin, in W.
Wrench momentum(const CompositeBody& body, const Twist& twist);

}  // namespace jourdain::dynamics
