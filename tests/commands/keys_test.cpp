// What `keys` prints, and the page that is made of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/files.hpp"
#include "support/process.hpp"

namespace jourdain::tests {
namespace {

support::ProcessResult keys(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {JOURDAIN_BINARY, "keys"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

TEST(Keys, MakeThePageOfTheModels) {
  const support::ProcessResult page = keys({"--markdown"});
  EXPECT_EQ(page.status, 0);
  EXPECT_EQ(page.output, support::read_file(JOURDAIN_SOURCE_DIR "/models/README.md"))
      << "jourdain keys --markdown > models/README.md";
}

TEST(Keys, OfOneSectionArePrintedAlone) {
  const std::string text = keys({"frame"}).output;
  EXPECT_THAT(text, testing::HasSubstr("[[frame]]"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("[[joint]]")));
  EXPECT_EQ(keys({"hinge"}).status, 2);
}

}  // namespace
}  // namespace jourdain::tests
