// Where a mechanism with loops starts: the initial values of the description, closed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"
#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::loops {

/// A closed configuration at t = 0 and velocities of the tree that keep it closed.
struct Start {
  Configuration configuration;
  Vector z;
  std::vector<Moved> moved;
  std::vector<bool> kept_y, kept_z;  ///< entries that start as the description says
  bool is_beside = false;            ///< found from beside a dead point
};

/// Closes the loops from the initial values; the velocities `independent` of the tree and their coordinates
/// stay as they are.
///
/// Positions that the description gives stay where the others can close the loops alone; otherwise all move from as
/// near as those come. Where that closes nothing, as at a dead point, or leaves ranges, the loops are closed from
/// positions beside, after a warning. Velocities that it gives stay, to the bit, where they agree with the loops;
/// given zeros yield to other given ones, and ones that agree to 1e-6 of the largest count as rounded and move to
/// the nearest that agree. Nothing after diagnostics: loops that stay open or close with axes against each other,
/// given velocities that conflict.
std::optional<Start> find_start(const model::Mechanism& mechanism, const NumericClosure& closure,
                                const std::vector<std::size_t>& independent,
                                support::Diagnostics& diagnostics);

/// The same at other values of the parameters than those at which `plan` starts: given numbers yield to initial values
/// that follow parameters, and these to closing. The way of closing is that of the plan where the way from its start to
/// the given positions is closed.
std::optional<Start> find_start_again(const model::Mechanism& mechanism, const NumericClosure& closure,
                                      const std::vector<std::size_t>& independent, const LoopPlan& plan,
                                      support::Diagnostics& diagnostics);

/// What a plan says of its start.
void take_start(const Start& start, LoopPlan& plan);

}  // namespace jourdain::loops
