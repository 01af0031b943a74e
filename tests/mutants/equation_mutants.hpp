// Faults planted in the symbolic statements that everything else is made from.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/equations.hpp"

namespace jourdain::tests {

enum class StatementFault {
  kSign,         ///< of the whole value
  kScale,        ///< times 1 + 1e-9
  kDropTerm,     ///< of a sum
  kDropFactor,   ///< of a product
  kOtherSymbol,  ///< an earlier name or a leaf in the place of one
  kNumber        ///< a number in it times 1 + 1e-9
};
inline constexpr std::size_t kStatementFaults = 6;
const char* name_of(StatementFault fault);

/// All that the equations are asked for, in lists of like quantities.
std::vector<std::vector<kinematics::Ex>> asked_for(const dynamics::Equations& equations);

/// Statements that something asked for depends on.
std::vector<std::size_t> live_statements(const dynamics::Equations& equations);

/// The equations with that fault in their statement `at`; none where it has no place for it. Terms and symbols
/// are chosen by their text: the order in memory changes from run to run.
std::optional<dynamics::Equations> planted(const dynamics::Equations& equations, StatementFault fault,
                                           std::size_t at, std::uint64_t seed);

}  // namespace jourdain::tests
