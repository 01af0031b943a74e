// The programs of the emitted functions of a mechanism with loops.
#pragma once

#include "ir/function_id.hpp"
#include "loops/rows/loop_system.hpp"
#include "programs/derivatives.hpp"

namespace jourdain::programs {

/// The program of a function that holds no derivatives: those of a tree (the residual is M ż − k̄ + q̄, with
/// multipliers + Gᵀ λ), and
///
///   close_loops             ("y", entry): dependent positions from independent ones by Newton iterations, or
///                           in closed form;
///                           ("beyond", i): negative while the position of the i-th proven range is within it
///   project                 ("y", entry), ("z", entry): nearest positions and velocities (weighted by
///                           mass), one Gauss-Newton step
///   constraint_residual     ("g", row), ("g_rate", row): g and G z + g_t
///   constraint_forces       ("lambda", row): multipliers of the rows; M ż = k̄ − q̄ − Gᵀ λ
///
/// Velocities, M, k̄ and q̄ are those of the independent coordinates, with multipliers of all. Leaves of
/// velocities, accelerations count accordingly; leaves of positions are those of the tree.
ir::Program loop_program(const loops::LoopSystem& system, ir::FunctionId function);

/// The same equations to be differentiated; positions that depend on others follow them.
DerivativeSources derivative_sources(const loops::LoopSystem& system);

}  // namespace jourdain::programs
