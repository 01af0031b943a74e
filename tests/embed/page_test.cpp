// The pages that take emitted code into a program: their commands as they stand there, and what the program prints.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "agreement/exact_pendulum.hpp"
#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// A page whose program steps the pendulum of models/, with a bar of some length, through one second.
struct WayOut {
  const char* page;
  double length;  ///< m
};

class Pages : public testing::TestWithParam<WayOut> {};

TEST_P(Pages, MakeAProgramThatSwingsThePendulum) {
  const std::string source = JOURDAIN_SOURCE_DIR, fence = "```sh\n";
  const std::string text = support::read_file(source + "/" + GetParam().page);
  const std::size_t begin = text.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t first = begin + fence.size();
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      run_script(source, text.substr(first, text.find("\n```", first) - first),
                 {"BUILD=" + build_folder(), "PROJECT=" + folder.path() + "/swing"});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string last_line = result.output.substr(result.output.rfind('\n', result.output.size() - 2) + 1);
  double angle = 0;
  ASSERT_EQ(std::sscanf(last_line.c_str(), "%lf rad after 1 s", &angle), 1) << result.output;
  // Time runs with the square root of the length; nine digits are printed, the step errs by less.
  EXPECT_NEAR(angle, double(exact_pendulum_angle(1 / std::sqrt(GetParam().length))), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Ways, Pages,
                         testing::Values(WayOut{"runtime/embedding.md", 0.8},
                                         WayOut{"runtime/c_interface.md", 1.0}),
                         [](const auto& way) { return way.index == 0 ? "Cpp" : "C"; });

}  // namespace
}  // namespace jourdain::tests
