// Finding the text of a file that another one imports.
#pragma once

#include <string>

#include "model/read/read.hpp"

namespace jourdain::model {

/// A file, or why it is not read.
struct FoundFile {
  std::string path;  ///< as messages show it
  std::string text;
  ImportChain chain;  ///< of files that it imports
  std::string problem = {}, hint = {};
};

/// The file `name`, relative to the folder of the one at `importing`. A file that is being read already, that stands
/// too deep, is no regular file, or exceeds the budget of `chain` is a problem.
FoundFile find_import(const std::string& name, const std::string& importing, const ImportChain& chain);

/// Without "." and "..", links followed; as it is where that fails.
std::string canonical_path(const std::string& path);

}  // namespace jourdain::model
