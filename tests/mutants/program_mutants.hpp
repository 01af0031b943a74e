// Faults planted in programs: one operation, operand, leaf, number or output is another one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::tests {

enum class ProgramFault {
  kFlipSum,         ///< a + b for a − b, and the other way
  kSwapOperands,    ///< of a difference, quotient or arctangent
  kOtherOperand,    ///< another earlier value in the place of an operand
  kOtherLeaf,       ///< the next entry of the same kind (modulo their number)
  kOtherOperation,  ///< a product for a sum, a quotient for a product, a product for a quotient, no root
  kSwapFunction,    ///< cosine for sine, and the other way
  kBypass,          ///< the first operand in the place of an operation: a term or a factor is dropped
  kNumberByUlps,    ///< a literal moved by 2^20 units in its last place
  kNumberByPart,    ///< a literal times 1 + 1e-9
  kNumberSign,      ///< a literal's sign
  kOtherOutput,     ///< an output takes the value of another one
  kOutputIndex      ///< an output under the subscripts of the next one of its array, and that one under its
};
inline constexpr std::size_t kProgramFaults = 12;
const char* name_of(ProgramFault fault);

struct ProgramSite {
  ProgramFault fault{};
  std::size_t at = 0;  ///< node, or output
  std::size_t operand = 0;
};

/// Every place where the fault can be planted: what no output depends on is none.
std::vector<ProgramSite> sites(const ir::Program& program, ProgramFault fault);

/// The program with it. `seed` chooses what else there is to choose. Operands come first, as ever.
ir::Program planted(const ir::Program& program, const ProgramSite& site, std::uint64_t seed);

}  // namespace jourdain::tests
