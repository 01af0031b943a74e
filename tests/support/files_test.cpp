#include <gtest/gtest.h>

#include <filesystem>

#include "support/check.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::support {
namespace {

class Files : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("jourdain_files_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const char* name) const { return (folder_ / name).string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path folder_;
};

TEST_F(Files, AreReadAsTheyWereWritten) {
  const std::string bytes("a\r\n\0\xff", 5);
  write_file(path("f"), bytes);
  EXPECT_EQ(read_file(path("f")), bytes);
  write_file(path("f"), "shorter");
  EXPECT_EQ(read_file(path("f")), "shorter");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, NameThePathWhenTheyAreMissing) {
  try {
    read_file(path("missing"));
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_EQ(std::string(error.what()), path("missing") + ": cannot be read: No such file or directory");
  }
}

TEST_F(Files, AreNotFolders) {
  std::filesystem::create_directory(path("folder"));
  EXPECT_THROW(read_file(path("folder")), EnvironmentError);
  EXPECT_THROW(write_file(path("folder"), "text"), EnvironmentError);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, CannotBeWrittenIntoAMissingFolder) {
  EXPECT_THROW(write_file(path("missing/f"), "text"), EnvironmentError);
  EXPECT_EQ(entries(), 0u);
}

}  // namespace
}  // namespace jourdain::support
