// Whether the motions that the loops allow move inertia: a body without mass is as good as any where loops tie
// it to others.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// Joints whose pivot in the tree's mass matrix vanishes, everywhere or at `start`: multipliers cannot be
/// solved for. In the order of the coordinates.
std::vector<model::JointIndex> massless_in_tree(const model::Mechanism& mechanism,
                                                const Configuration& start);

/// Errors at a joint where Nᵀ M N is singular, the columns of N the motions G N = 0: at the first
/// configuration, which is the start, or at all. `jacobians` are G at `configurations`. Whether there are none.
bool check_moved_inertia(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                         const std::vector<Matrix>& jacobians, support::Diagnostics& diagnostics);

/// An error at each joint of `massless` where `plan` is for multipliers. Whether there are none.
bool check_tree_inertia(const model::Mechanism& mechanism, const std::vector<model::JointIndex>& massless,
                        const LoopPlan& plan, support::Diagnostics& diagnostics);

}  // namespace jourdain::loops
