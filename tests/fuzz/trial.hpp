// One case, from its files to its verdict.
#pragma once

#include <string>

#include "fuzz/verdict.hpp"

namespace jourdain::tests {

struct Trial {
  Verdict verdict;
  bool read = false, emitted = false, compiled = false;
  double seconds = 0;  ///< of processor time, without the compilers'
  std::string shown;   ///< the command line and what it printed to stderr
};

/// Writes the files of `tried` below `folder`, which is emptied before, and runs it. Of what is emitted one in fifty,
/// by the case's number, is compiled by both compilers and stepped.
Trial try_case(const Case& tried, std::uint64_t index, const std::string& folder);

/// The description with as many lines left out as possible while the verdict stays; some hundred trials.
Case minimised(Case tried, const Verdict& verdict, std::uint64_t index, const std::string& folder);

}  // namespace jourdain::tests
