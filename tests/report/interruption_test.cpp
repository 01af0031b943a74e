// A report that is ended half-way leaves nothing behind.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include "support/files.hpp"
#include "support/temporary_folder.hpp"

extern char** environ;

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

/// Starts `report` with its temporary files below `temporary` and a further variable of its environment, ends it by a
/// signal `delay` after `is_reached`, and expects it to leave nothing.
void expect_nothing_left_by_a_killed_report(const std::string& temporary, const std::string& setting,
                                            const std::function<bool()>& is_reached,
                                            std::chrono::milliseconds delay, int signal = SIGTERM) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out", place = "TMPDIR=" + temporary,
                    path = JOURDAIN_SOURCE_DIR "/models/lagrange_top.toml";
  const char* arguments[] = {"env",        place.c_str(), setting.c_str(), JOURDAIN_BINARY, "report",
                             path.c_str(), "-o",          out.c_str(),     nullptr};
  pid_t child = 0;
  ASSERT_EQ(posix_spawnp(&child, "env", nullptr, nullptr, const_cast<char**>(arguments), environ), 0);
  for (int i = 0; i < 3000 && !is_reached(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(delay);
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_FALSE(fs::exists(out));
  for (const fs::path& left : fs::directory_iterator(temporary)) ADD_FAILURE() << left;
}

TEST(Interruption, LeavesNothing) {
  const support::TemporaryFolder temporary;
  for (const int delay : {0, 300, 1500}) {
    SCOPED_TRACE(delay);
    expect_nothing_left_by_a_killed_report(
        temporary.path(), "LANG=C", [&] { return !fs::is_empty(temporary.path()); },
        std::chrono::milliseconds(delay));
  }
}

/// A signal may end g++ after it made a temporary file and before it noted that it has to remove it.
TEST(Interruption, TakesAwayWhatACompilerForgets) {
  const support::TemporaryFolder temporary, folder;
  const std::string compiler = folder.path() + "/forgetful", reached = folder.path() + "/reached";
  support::write_file(compiler,
                      "#!/bin/sh\ntouch \"$TMPDIR/forgotten\" \"" + reached + "\"\nexec sleep 100\n");
  fs::permissions(compiler, fs::perms::owner_all);
  for (const int signal : {SIGTERM, SIGQUIT}) {
    SCOPED_TRACE(signal);
    expect_nothing_left_by_a_killed_report(
        temporary.path(), "CXX=" + compiler, [&] { return fs::exists(reached); },
        std::chrono::milliseconds(0), signal);
    EXPECT_TRUE(fs::remove(reached));
  }
}

}  // namespace
}  // namespace jourdain::tests
