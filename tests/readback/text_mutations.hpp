// Small faults planted in finished text, for tests of whatever reads it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace jourdain::tests {

/// One change of a text.
struct TextMutant {
  std::string operation;           ///< which operator made it
  std::size_t at = 0, length = 0;  ///< what is replaced
  std::string replacement;
  int line = 0;

  std::string applied_to(const std::string& text) const;
  /// "flip_sum in line 12: '+' became '-'".
  std::string describe(const std::string& text) const;
};

/// Names of all operators, in order.
std::vector<std::string> text_operators();

/// Mutants of C++, C or JSON, at sites drawn by `seed`; at most that many per operator, none that leaves the text
/// as it is. Operators know tokens and brackets alone: many mutants do not compile, some mean the same.
std::vector<TextMutant> text_mutants(const std::string& text, std::uint64_t seed,
                                     std::size_t count_per_operator);

/// Does the change leave all tokens beside comments as they are?
bool changes_only_space_or_comments(const std::string& text, const std::string& mutant);

}  // namespace jourdain::tests
