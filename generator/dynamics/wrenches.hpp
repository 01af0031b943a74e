// Forces with moments and velocity fields of rigid motions, and their way inward.
#pragma once

#include <string>
#include <vector>

#include "kinematics/inward_sums.hpp"

namespace jourdain::dynamics {

using kinematics::Ex;
using kinematics::Vector3;

/// A force with a moment about a point, or a linear with an angular momentum.
struct Wrench {
  Vector3 force = kinematics::zero_vector();
  Vector3 moment = kinematics::zero_vector();
};

/// Velocity field `linear` + `angular` × x of a rigid motion, x from the link's origin.
struct Twist {
  Vector3 angular = kinematics::zero_vector();
  Vector3 linear = kinematics::zero_vector();
};

/// Power of a wrench on a twist, both in the same axes and about the same point.
Ex power(const Wrench& wrench, const Twist& twist);

/// What the two vectors of a wrench are bound as.
struct WrenchNames {
  std::string force, moment;
};

using WrenchSums = kinematics::InwardSums<Wrench>;

/// All that was handed to `link`, in W: `parts` names what was in L, turned to W, `names` the total.
Wrench gather(const kinematics::WorkingFrames& frames, std::size_t link, const WrenchSums& sums,
              const WrenchNames& names, const WrenchNames& parts, kinematics::Statements& statements);

/// Adds a wrench about the origin of `link`, in W, to the sum of its parent: `turned` names it in C, `names` the sum.
void hand_inward(const kinematics::WorkingFrames& frames, std::size_t link, const Wrench& wrench,
                 const WrenchNames& names, const WrenchNames& turned, WrenchSums& sums,
                 kinematics::Statements& statements);

/// Sums of wrenches over subtrees: W_i of the result is that of `own[i]` and of all links outward, about the
/// origin of link i, in its working frame.
std::vector<Wrench> accumulate_wrenches(const kinematics::WorkingFrames& frames,
                                        const std::vector<Wrench>& own, const std::string& name,
                                        kinematics::Statements& statements);

/// A wrench about the origin of `link`, in its working frame, moved to the parent's origin and working frame.
Wrench to_parent(const kinematics::WorkingFrames& frames, std::size_t link, const Wrench& wrench,
                 const std::string& name, kinematics::Statements& statements);

}  // namespace jourdain::dynamics
