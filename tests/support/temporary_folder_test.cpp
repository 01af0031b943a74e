#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

namespace jourdain::support {
namespace {

namespace fs = std::filesystem;

/// TMPDIR is a fresh folder of its own, so that other programs' folders stay out of it.
class TemporaryFolders : public testing::Test {
 protected:
  TemporaryFolders() {
    parent_ = outer_.path() + "/parent";
    fs::create_directory(parent_);
    const char* before = std::getenv("TMPDIR");
    before_ = before ? before : "";
    setenv("TMPDIR", parent_.c_str(), 1);
  }
  ~TemporaryFolders() override {
    if (before_.empty())
      unsetenv("TMPDIR");
    else
      setenv("TMPDIR", before_.c_str(), 1);
  }

  /// A folder with a file, last changed two minutes ago or now.
  std::string left(const std::string& name, bool is_old = true) const {
    const std::string path = parent_ + "/" + name;
    fs::create_directories(path + "/inner");
    if (is_old) fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(2));
    return path;
  }

 private:
  TemporaryFolder outer_;
  std::string before_;

 protected:
  std::string parent_;
};

TEST_F(TemporaryFolders, GoWithTheirContents) {
  std::string path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    fs::create_directories(path + "/a/b");
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST_F(TemporaryFolders, WhatAKilledProgramLeftGoesWithTheNextOne) {
  const std::string old = left("jourdain-temporary-17-abc123");
  const TemporaryFolder folder;
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(folder.path()));
}

TEST_F(TemporaryFolders, OthersStay) {
  const std::string young = left("jourdain-temporary-17-abc123", false),
                    users = left("jourdain-temporary-output"), other = left("jourdain-temporary-one-output"),
                    locked = left("jourdain-temporary-17-def456");
  const int lock = open(locked.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(lock, LOCK_EX), 0);
  fs::create_directory_symlink(other, parent_ + "/jourdain-temporary-17-ghi789");
  const TemporaryFolder folder;
  for (const std::string& path : {young, users, other, locked})
    EXPECT_TRUE(fs::exists(path + "/inner")) << path;
  close(lock);
}

TEST_F(TemporaryFolders, OneInUseIsLocked) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() + "/inner");
  fs::last_write_time(folder.path(), fs::file_time_type::clock::now() - std::chrono::minutes(2));
  const TemporaryFolder second;
  EXPECT_TRUE(fs::exists(folder.path() + "/inner"));
}

}  // namespace
}  // namespace jourdain::support
