// In which order values are computed.
#pragma once

#include <cstddef>

#include "ir/program.hpp"

namespace jourdain::passes {

/// Exact. The same values in the order in which a processor takes fewest `estimated_cycles`: that of the program, or of
/// a walk from its outputs, first to last or last to first, into what they need, of two operands that first whose walk
/// keeps more numbers at a time (Sethi and Ullman, "The generation of optimal code for arithmetic expressions", J. ACM
/// 17, 1970). The program's stays where another saves less than 1 in 25, and where values are computed at once.
ir::Program order_values(const ir::Program& program);

/// Cycles from the first operation to the end of the last one in the program's order, by a model of processors that
/// begin what is ready while earlier operations wait: two operations on numbers a cycle, 160 in flight, products fused
/// into the one sum that needs them, sums and products after 4 cycles. Sines and cosines are there from the start, as
/// emitted code takes them. Registers and memory are left out.
std::size_t estimated_cycles(const ir::Program& program);

}  // namespace jourdain::passes
