// Functions of the kinematics as programs: of a tree, or with its loops closed.
#pragma once

#include <cstddef>

#include "dynamics/equations.hpp"
#include "ir/program.hpp"
#include "loops/rows/loop_system.hpp"
#include "model/kinematic_function.hpp"

namespace jourdain::programs {

/// The mechanism's k-th function for a tree. Entries that are zero are left out.
ir::Program tree_kinematics(const dynamics::Equations& equations, const model::Mechanism& mechanism,
                            std::size_t k);

/// With loops: Jacobians, biases and the operational inertia are of the independent velocities.
ir::Program loop_kinematics(const dynamics::Equations& equations, const loops::LoopSystem& system,
                            std::size_t k);

}  // namespace jourdain::programs
