// Faults planted in finished files: a character, a name or a line is another one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "support/files.hpp"

namespace jourdain::tests {

enum class TextFault {
  kSum,          ///< + for a binary −, and the other way
  kProduct,      ///< / for *, and the other way
  kParentheses,  ///< a pair around an operand is dropped
  kNegative,     ///< a minus in front of what is assigned
  kIndex,        ///< a subscript plus one
  kDigit,        ///< one digit of a number
  kName,         ///< another name of the same file in the place of one
  kSineCosine,   ///< one called for the other
  kDropLine,     ///< a line is lost
  kSwapLines,    ///< a value and a line that needs it change places
  kQuoted        ///< a letter within quotation marks
};
inline constexpr std::size_t kTextFaults = 11;
const char* name_of(TextFault fault);

struct TextSite {
  TextFault fault{};
  std::size_t file = 0, offset = 0;
};

/// Every place where the fault can be planted: comments, include guards and blank lines are none.
std::vector<TextSite> sites(const std::vector<support::FileText>& files, TextFault fault);

/// The files with it. `seed` chooses what else there is to choose.
std::vector<support::FileText> planted(const std::vector<support::FileText>& files, const TextSite& site,
                                       std::uint64_t seed);

/// Why the changed text says the same, where that is seen from it: a rule of C++, not of ours. Empty where it is not.
std::string same_because(const std::vector<support::FileText>& files, const TextSite& site);

/// The line that a place is on, for a person.
std::string line_of(const std::vector<support::FileText>& files, const TextSite& site);

}  // namespace jourdain::tests
