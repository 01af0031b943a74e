// Emitted files that somebody keeps, for example in a repository, beside what the command would emit now.
#pragma once

#include <string>
#include <vector>

#include "support/files.hpp"

namespace jourdain::commands {

/// What a manifest says of how its files were made.
struct RecordedModel {
  std::string name;                ///< of namespace and files
  std::vector<std::string> words;  ///< options that were given (commands/emission.hpp)
};

/// The manifests of `folder` that were made from a description of this file name, by name; those of `name` alone where
/// it is not empty. What is no manifest is passed over.
std::vector<RecordedModel> recorded_models(const std::string& folder, const std::string& description,
                                           const std::string& name);

/// A text for each of `files` that is missing in `folder` or differs there: the place of the first difference and both
/// lines, cut to what is around it. Empty where all are there and the same, byte for byte.
std::vector<std::string> differences(const std::string& folder, const std::vector<support::FileText>& files);

}  // namespace jourdain::commands
