// Files that a command writes are none of those that it reads, and each is another one.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

/// False after a message where one of the files to write is one of those to read (`why` says that of it) or the same as
/// another one to write, by whatever paths and links. Empty paths, "-", devices and pipes are nobody's.
bool are_outputs_apart(const std::vector<std::string>& written, const std::vector<std::string>& read,
                       const std::string& why = "is read, and would be overwritten");

/// Paths of files in a folder.
template <class File>
std::vector<std::string> paths_in(const std::string& folder, const std::vector<File>& files) {
  std::vector<std::string> paths;
  for (const File& file : files) paths.push_back(folder + "/" + file.name);
  return paths;
}

}  // namespace jourdain::commands
