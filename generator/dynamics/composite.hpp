// Composite bodies: a link with everything outward of it, seen as one rigid body at the current coordinates.
#pragma once

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

/// Mass moments of a link and all links outward of it, about the link's origin, in its working frame.
struct CompositeBody {
  kinematics::MassMoments moments;
  Ex polar;  ///< S_xx + S_yy = J_zz, the moment of inertia about the joint axis
};

/// One per link, inward by recursion.
std::vector<CompositeBody> derive_composites(const kinematics::LinkTree& tree,
                                             const kinematics::WorkingFrames& frames,
                                             kinematics::Statements& statements);

/// Momentum of the composite body per unit of the link's joint velocity, about the link's origin, in W.
Wrench unit_momentum(const kinematics::Link& link, const CompositeBody& body);

/// Sums of wrenches over subtrees: W_i of the result is that of `own[i]` and of all links outward, about the
/// origin of link i, in its working frame.
std::vector<Wrench> accumulate_wrenches(const kinematics::LinkTree& tree,
                                        const kinematics::WorkingFrames& frames,
                                        const std::vector<Wrench>& own, const std::string& name,
                                        kinematics::Statements& statements);

/// A wrench about the origin of `link`, in its working frame, moved to the parent's origin and working frame.
Wrench to_parent(const kinematics::LinkTree& tree, const kinematics::WorkingFrames& frames, std::size_t link,
                 const Wrench& wrench, const std::string& name, kinematics::Statements& statements);

}  // namespace jourdain::dynamics
