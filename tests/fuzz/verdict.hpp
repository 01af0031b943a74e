// What came out of a case, and whether that may be.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "fuzz/cases.hpp"
#include "fuzz/child.hpp"

namespace jourdain::tests {

enum class Outcome {
  kDone,          ///< exit status 0, and where files were to be written they are there and were read back
  kRefused,       ///< 1, with a diagnostic that names file, line and column
  kRefusedWhole,  ///< 1, with a diagnostic of the file as a whole, which is empty or too long; or of an option
  kUsage,         ///< 2, 3: only where the command line is what was drawn
  kInternal,      ///< 70, or a status that there is not
  kSignal,        ///< ended by one, or by a sanitizer
  kTooSlow,
  kTooLarge,
  kUnplaced,      ///< 1, and no one knows where
  kValidRefused,  ///< valid by construction, and not taken
  kUntidy,        ///< files left behind or half-written, messages with control characters
  kNotCompiled,   ///< emitted, and a compiler refuses it or the two disagree
};
inline constexpr std::size_t kOutcomes = 12;
std::string_view outcome_name(Outcome outcome);
bool is_failure(Outcome outcome);

struct Verdict {
  Outcome outcome = Outcome::kDone;
  std::string
      why;  ///< of a failure: its first message, numbers and names left out, so that equal faults have equal texts
};

/// Of a case that was run in `folder` (see run_in_child).
Verdict judge(const Case& tried, const ChildResult& result, const std::string& folder);

}  // namespace jourdain::tests
