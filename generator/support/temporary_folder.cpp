#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

#include "support/check.hpp"

namespace jourdain::support {

namespace {

constexpr char kPrefix[] = "jourdain-temporary-";
constexpr std::size_t kRandomLetters = 6;  // what mkdtemp replaces
constexpr std::time_t kSurelyLocked = 60;  // s from the making of a folder to its lock

int open_folder(const std::string& path) {
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// Of this user, old enough to be locked if anybody uses it, and not locked.
bool is_abandoned(int folder) {
  struct stat status {};
  return fstat(folder, &status) == 0 && status.st_uid == geteuid() &&
         std::time(nullptr) - status.st_mtime > kSurelyLocked && flock(folder, LOCK_EX | LOCK_NB) == 0;
}

void remove_abandoned(const std::filesystem::path& parent) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(parent, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix) || name.size() != sizeof kPrefix - 1 + kRandomLetters) continue;
    const int folder = open_folder(entry.path().string());
    if (folder < 0) continue;
    if (is_abandoned(folder)) std::filesystem::remove_all(entry.path(), ignored);
    close(folder);
  }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  const Uninterrupted until_known;
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  if (error) throw EnvironmentError("no folder for temporary files (TMPDIR): " + error.message());
  remove_abandoned(parent);
  std::string pattern = (parent / kPrefix).string() + std::string(kRandomLetters, 'X');
  if (!mkdtemp(pattern.data()))
    throw EnvironmentError("cannot make a folder like '" + pattern + "': " + std::strerror(errno));
  path_ = pattern;
  lock_ = open_folder(path_);
  if (lock_ >= 0) flock(lock_, LOCK_EX);
  removed_ = std::make_unique<RemovedOnInterruption>(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
}

}  // namespace jourdain::support
