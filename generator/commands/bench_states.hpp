// Seeded random states for measurements: within the ranges of coordinates, all entries different.
#pragma once

#include <cstdint>
#include <vector>

#include "loops/record/loop_plan.hpp"
#include "model/mechanism.hpp"

namespace jourdain::commands {

/// Rows of time, y, z, inputs and accelerations, in SI units: positions in their ranges, angles without one in a whole
/// turn, other positions within half a metre of the start, quaternions of unit length. With loops positions lie within
/// 0.1 (rad, m) of the start, and whoever takes them has to close the loops. Times up to 2 s, velocities up to 1,
/// inputs and accelerations up to 5.
std::vector<std::vector<double>> draw_bench_states(const model::Mechanism& mechanism,
                                                   const loops::LoopPlan* plan, int count,
                                                   std::uint64_t seed);

}  // namespace jourdain::commands
