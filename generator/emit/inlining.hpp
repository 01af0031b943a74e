// Short functions that steps compute in themselves.
#pragma once

#include "emit/model_code.hpp"

namespace jourdain::emit {

/// Additions, products, quotients and square roots of a function that a step of four stages holds four times in less
/// than the code of a middling robot (UR5: 400).
inline constexpr std::size_t kShortFunction = 200;

/// Marks forward_dynamics, position_rate and close_loops where they are short and steps call them. A compiler then
/// keeps from stage to stage in registers what a called function would write number by number and the next stage read
/// as vectors, which waits. RK4 steps take 0.65 to 1.0 of the time (clang), 0.75 to 1.0 (g++, an Intel Xeon).
void inline_short_functions(const ir::Module& module, ModelCode& code);

}  // namespace jourdain::emit
