// The commands of runtime/fmu.md, as they stand there.
#include <gtest/gtest.h>

#include <cstdio>

#include "agreement/exact_pendulum.hpp"
#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

TEST(FmuPage, MakesAProgramThatSwingsThePendulum) {
  const std::string source = JOURDAIN_SOURCE_DIR, fence = "```sh\n";
  const std::string page = support::read_file(source + "/runtime/fmu.md");
  const std::size_t first = page.find(fence) + fence.size();
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(source, page.substr(first, page.find("\n```", first) - first),
                 {"BUILD=" + command_folder(), "PROJECT=" + folder.path() + "/swing"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string last_line = result.output.substr(result.output.rfind('\n', result.output.size() - 2) + 1);
  double angle = 0;
  ASSERT_EQ(std::sscanf(last_line.c_str(), "%lf rad after 1 s", &angle), 1) << result.output;
  EXPECT_NEAR(angle, double(exact_pendulum_angle(1.0)), 1e-9);
}

}  // namespace
}  // namespace jourdain::tests
