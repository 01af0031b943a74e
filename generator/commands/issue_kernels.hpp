// Floating-point instructions of x86-64: kinds that share units of a processor, and loops that issue them as fast as it
// can.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace jourdain::commands {

/// Kinds of arithmetic that a processor has units of its own for.
enum class Arithmetic {
  kSum,      ///< and difference
  kProduct,  ///< and product with a sum
  kExtreme,  ///< minimum, maximum
  kQuotient,
  kRoot,  ///< square root
};

/// Bits of the registers; one number is as fast as 128 bits, but for quotients and roots.
enum class Width { kOne, k128, k256, k512 };

struct ArithmeticInstruction {
  Arithmetic arithmetic;
  Width width;
  friend auto operator<=>(const ArithmeticInstruction&,
                          const ArithmeticInstruction&) = default;  // NOLINT(modernize-use-nullptr)
};

/// By kind, of a call.
using ArithmeticCounts = std::map<ArithmeticInstruction, double>;

/// From a mnemonic and its operands, "vmulpd %ymm1,%ymm2,%ymm3", as objdump writes them. Nothing for instructions
/// without arithmetic in float or double: moves, comparisons, conversions, roundings.
std::optional<ArithmeticInstruction> read_instruction(const std::string& mnemonic,
                                                      const std::string& operands);

/// Does the instruction compute in the registers of x87, whose rates are not measured?
bool is_x87_arithmetic(const std::string& mnemonic);

/// Loops whose rates are measured, "sum0" to "root3" with the number of Width; "both" has sums and products by turns.
struct IssueKernels {
  std::string numbers;    ///< that registers are filled with, 64 bytes each: a start, a factor, zeros
  std::string functions;  ///< C++, of inline assembly
  std::string table;      ///< rows of name, instructions of a round, function
};
IssueKernels issue_kernels(bool is_float);

/// Names of the loops that tell the least time of the counts.
std::vector<std::string> issue_names(const ArithmeticCounts& counts);

/// Least time of the counted instructions, s, where the loops issue so many a second: that of the unit which takes
/// longest, were all else free.
double least_time(const ArithmeticCounts& counts, const std::map<std::string, double>& rates);

}  // namespace jourdain::commands
