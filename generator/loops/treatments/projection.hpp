// The closing of loops that keep all coordinates: positions and velocities brought back by the smallest change,
// weighted by mass: along it kinetic energy changes to second order only.
#pragma once

#include "loops/rows/loop_system.hpp"

namespace jourdain::loops {

/// The program `project`. With M and S = G M⁻¹ Gᵀ over the independent rows at the y given:
///
///   ("y", entry)   y moved by d = −M⁻¹ Gᵀ S⁻¹ g, one Gauss-Newton step
///   ("z", entry)   z − M⁻¹ Gᵀ S⁻¹ (G₁ z + g_t), G₁ and g_t at the new y, the rest at the old one (the difference
///                  is of second order)
///   "regularity"   det S / LoopPlan::determinant
///   "opening"      dᵀ d, and what points that are looked for may be missed by: squares of m and rad; more than 1 where
///                  those found are not the nearest
ir::Program projection_program(const LoopSystem& system);

}  // namespace jourdain::loops
