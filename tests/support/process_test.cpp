#include "support/process.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace jourdain::support {
namespace {

TEST(Processes, HaveATemporaryFolderOfTheirOwnThatGoesWithThem) {
  setenv("JOURDAIN_TEST_VARIABLE", "kept", 1);
  const ProcessResult result = run_process(
      {"sh", "-c", "touch \"$TMPDIR/left\" && printf %s \"$TMPDIR\" && test $JOURDAIN_TEST_VARIABLE = kept"});
  unsetenv("JOURDAIN_TEST_VARIABLE");
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(std::filesystem::path(result.output).parent_path(), std::filesystem::temp_directory_path());
  EXPECT_FALSE(std::filesystem::exists(result.output));
}

}  // namespace
}  // namespace jourdain::support
