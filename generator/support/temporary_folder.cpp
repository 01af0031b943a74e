#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string_view>

#include "support/check.hpp"

namespace jourdain::support {

namespace {

constexpr std::string_view kPrefix = "jourdain-temporary-";
constexpr std::string_view kSuffix = "-XXXXXX";  // which mkdtemp replaces
constexpr std::time_t kSurelyLocked = 60;        // s from the making of a folder to its lock

int open_folder(const std::string& path) {
  return open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

/// jourdain-temporary-PROCESS-RANDOM
bool is_ours(std::string_view name) {
  if (!name.starts_with(kPrefix) || name.size() <= kPrefix.size() + kSuffix.size()) return false;
  name.remove_prefix(kPrefix.size());
  return name.find_first_not_of("0123456789") == name.size() - kSuffix.size() &&
         name[name.size() - kSuffix.size()] == '-';
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
    if (!is_ours(entry.path().filename().string())) continue;
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
  std::string pattern = (parent / fmt::format("{}{}{}", kPrefix, getpid(), kSuffix)).string();
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
