// The way of wrenches inward.
#pragma once

#include "dynamics/scene.hpp"
#include "kinematics/inward_sums.hpp"

namespace jourdain::dynamics {

/// Bound as `name`f and `name`n.
Wrench bound(const Scene& scene, const std::string& name, const Wrench& wrench);

/// What the two vectors of a wrench are bound as.
struct WrenchNames {
  std::string force, moment;
};

using WrenchSums = kinematics::InwardSums<Wrench>;

/// All that was handed to `link`, in W: `parts` names what was in L, turned to W, `names` the total.
Wrench gather(const Scene& scene, std::size_t link, const WrenchSums& sums, const WrenchNames& names,
              const WrenchNames& parts);

/// Adds a wrench about the origin of `link`, in W, to the sum of its parent: `turned` names it in C, `names` the sum.
void hand_inward(const Scene& scene, std::size_t link, const Wrench& wrench, const WrenchNames& names,
                 const WrenchNames& turned, WrenchSums& sums);

/// Sums of wrenches over subtrees: W_i of the result is that of `own[i]` and of all links outward, about the
/// origin of link i, in its working frame.
std::vector<Wrench> accumulate_wrenches(const Scene& scene, const std::vector<Wrench>& own,
                                        const std::string& name);

/// A wrench about the origin of `link`, in its working frame, moved to the parent's origin and working frame.
Wrench to_parent(const Scene& scene, std::size_t link, const Wrench& wrench, const std::string& name);

}  // namespace jourdain::dynamics
