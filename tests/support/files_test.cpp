#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>

#include "support/check.hpp"
#include "support/diagnostics.hpp"
#include "support/files.hpp"

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

TEST_F(Files, AreWrittenTogether) {
  write_files(path("new/folder"), {{"a", "1"}, {"b", "2"}});
  EXPECT_EQ(read_file(path("new/folder/a")) + read_file(path("new/folder/b")), "12");
  write_files(path("new/folder"), {{"a", "3"}});
  EXPECT_EQ(read_file(path("new/folder/a")) + read_file(path("new/folder/b")), "32");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, ThatAreStaleAreRemovedOnceTheOthersAreWritten) {
  write_files(path("new"), {{"a", "1"}, {"b", "2"}, {"c", "3"}});
  std::filesystem::create_directory(path("new/folder"));
  EXPECT_THROW(write_files(path("new"), {{"folder", "4"}}, {"b"}), EnvironmentError);
  EXPECT_EQ(read_file(path("new/b")), "2");
  write_files(path("new"), {{"a", "4"}}, {"b", "folder", "missing"});
  EXPECT_FALSE(std::filesystem::exists(path("new/b")));
  EXPECT_EQ(read_file(path("new/a")) + read_file(path("new/c")), "43");
  EXPECT_TRUE(std::filesystem::is_directory(path("new/folder")));
}

TEST_F(Files, LeaveNothingWhereTheLastOneCannotBeWritten) {
  std::filesystem::create_directories(path("folder/b"));
  EXPECT_THROW(write_files(path("folder"), {{"a", "1"}, {"b", "2"}}), EnvironmentError);
  EXPECT_FALSE(std::filesystem::exists(path("folder/a")));
  write_file(path("file"), "x");
  EXPECT_THROW(check_writable(path("file/folder")), EnvironmentError);
  check_writable(path("other/folder"));
  EXPECT_FALSE(std::filesystem::exists(path("other")));
}

/// A limit on the size of files stands for a full disk: writing fails half-way.
TEST_F(Files, LeaveNothingOnAFullDisk) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_files(path("new"), {{"small", "text"}, {"large", std::string(200000, 'x')}});
      _exit(1);
    } catch (const EnvironmentError& error) {
      _exit(std::string(error.what()).find("large: cannot be written") != std::string::npos ? 0 : 2);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(entries(), 0u);
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

TEST_F(Files, ThatAlreadyHaveTheirTextKeepTheirTime) {
  const auto old = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  write_files(path(""), {{"a", "same"}, {"b", "before"}});
  for (const char* name : {"a", "b"}) std::filesystem::last_write_time(path(name), old);
  write_files(path(""), {{"a", "same"}, {"b", "after!"}});
  EXPECT_EQ(std::filesystem::last_write_time(path("a")), old);
  EXPECT_GT(std::filesystem::last_write_time(path("b")), old);
  EXPECT_EQ(read_file(path("b")), "after!");
  write_file(path("a"), "same");
  EXPECT_EQ(std::filesystem::last_write_time(path("a")), old);
  EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, DevicesAreRefusedAndPipesWithoutWritersAreEmpty) {
  EXPECT_THROW(read_file("/dev/zero"), EnvironmentError);
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(read_file(path("pipe")), "");
}

TEST_F(Files, ThatLinksLeadToAreWritten) {
  write_file(path("there"), "before");
  std::filesystem::create_symlink("there", path("link"));
  write_file(path("link"), "after");
  EXPECT_EQ(read_file(path("there")), "after");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, DevicesAndPipesAreWrittenToAndStayWhatTheyAre) {
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_THROW(write_file(path("pipe"), "nobody reads"), EnvironmentError);
  const int reader = open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  write_file(path("pipe"), "text");
  char text[8] = {};
  EXPECT_EQ(read(reader, text, sizeof text), 4);
  EXPECT_STREQ(text, "text");
  close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(path("pipe")));
  EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace jourdain::support
