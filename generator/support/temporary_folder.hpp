// A folder for what nobody shall see.
#pragma once

#include <memory>
#include <string>

#include "support/interruption.hpp"

namespace jourdain::support {

/// A fresh folder under the system's temporary one, removed with its contents at the end of its life or when
/// the program is interrupted. It is locked while it lives; a new one removes those that a killed program of
/// the same user left.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int lock_ = -1;  ///< file descriptor of the folder
  std::unique_ptr<RemovedOnInterruption> removed_;
};

}  // namespace jourdain::support
