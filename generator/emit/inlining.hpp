// Short functions that steps compute in themselves.
#pragma once

#include "emit/model_code.hpp"

namespace jourdain::emit {

/// Additions, products, quotients and square roots of a function that a step holds once a stage: four times in rk4,
/// six in rk5.
inline constexpr std::size_t kShortFunction = 200;

/// Marks forward_dynamics, position_rate and close_loops where they are short and steps call them. A compiler then
/// keeps from stage to stage in registers what a called function would write number by number and the next stage read
/// as vectors, which waits. RK4 steps take 0.64 to 1.0 of the time (clang), 0.76 to 1.02 (g++, an Intel Xeon).
/// The steps are marked too: in these g++ is kept from packing what their stages exchange, which takes RK4 0.27 to 1.09
/// of the time.
void inline_short_functions(const std::vector<programs::FunctionInfo>& functions, const ir::Module& module,
                            ModelCode& code);

}  // namespace jourdain::emit
