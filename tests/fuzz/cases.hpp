// The cases of the fuzzer: each is a command line with the files that it reads, and follows from a seed and an index
// alone.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "support/files.hpp"

namespace jourdain::tests {

enum class CaseKind { kToml, kUrdf, kMjcf, kBytes, kValid, kOptions };
inline constexpr CaseKind kCaseKinds[] = {CaseKind::kToml,  CaseKind::kUrdf,  CaseKind::kMjcf,
                                          CaseKind::kBytes, CaseKind::kValid, CaseKind::kOptions};
std::string_view kind_name(CaseKind kind);

struct Case {
  CaseKind kind = CaseKind::kToml;
  std::vector<std::string> arguments;  ///< after the program's name
  std::vector<support::FileText>
      files;               ///< in the folder that it is run in; the first one is the description
  bool must_pass = false;  ///< valid by construction
  std::string origin;      ///< what it was made of
};

Case make_case(std::uint64_t seed, std::uint64_t index);

}  // namespace jourdain::tests
