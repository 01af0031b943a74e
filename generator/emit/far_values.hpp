// Values of long functions that are read again long after they were computed, in memory that short instructions reach.
#pragma once

#include <cstddef>
#include <optional>

#include "emit/tree.hpp"

namespace jourdain::emit {

/// Statements of a function whose code is longer than what a first-level cache of instructions holds (32 KB). In
/// shorter ones windows cost up to 1.1 of the time (Romeo's mass matrix, 1646 statements, 28 KB).
inline constexpr std::size_t kLongFunction = 1700;

/// The same values, with those that are read more than 30 statements after they were computed, or last read, in windows
/// of 256 bytes (`nearby`), each addressed anew where it is needed. Compilers keep such values on the stack, at
/// distances that take four bytes each. Nothing where there are none. Forward dynamics of humanoids take 0.79 (iCub) to
/// 0.89 (Romeo) of the time, their code 0.85 (g++ and clang, an Intel Xeon).
std::optional<Statements> with_far_values(const Statements& body);

}  // namespace jourdain::emit
