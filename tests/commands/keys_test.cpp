// What `keys` prints, and the page that is made of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "model/read/keys.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

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

/// What the page says: its examples, in order, are one model of that folder.
TEST(Keys, HaveExamplesThatAreAModel) {
  const support::TemporaryFolder folder;
  std::string text;
  for (const model::KeySection& section : model::key_sections()) text += std::string(section.example) + "\n";
  support::write_file(folder.path() + "/engine.toml", text);
  support::write_file(folder.path() + "/flyball_governor.toml",
                      support::read_file(JOURDAIN_SOURCE_DIR "/models/flyball_governor.toml"));
  const support::ProcessResult checked =
      support::run_process({JOURDAIN_BINARY, "check", folder.path() + "/engine.toml"});
  EXPECT_EQ(checked.status, 0) << checked.output;
  EXPECT_THAT(checked.output, testing::HasSubstr("ok: engine"));
}

TEST(Keys, MakeASchemaWithAllSections) {
  const std::string text = keys({"--schema"}).output;
  const auto schema = nlohmann::json::parse(text);
  for (const model::KeySection& section : model::key_sections())
    for (const model::Key& key : section.keys)
      EXPECT_TRUE(schema["definitions"][section.name]["properties"].contains(key.name))
          << section.name << "." << key.name;
  EXPECT_EQ(keys({"--schema", "--markdown"}).status, 2);
  const support::TemporaryFolder folder;
  ASSERT_EQ(support::run_process({JOURDAIN_BINARY, "pages", folder.path()}).status, 0);
  EXPECT_EQ(support::read_file(folder.path() + "/jourdain/model.schema.json"), text);
  EXPECT_EQ(support::read_file(folder.path() + "/jourdain/manifest.schema.json"),
            support::read_file(JOURDAIN_SOURCE_DIR "/templates/manifest.schema.json"));
}

TEST(Keys, OfOneSectionArePrintedAlone) {
  const std::string text = keys({"frame"}).output;
  EXPECT_THAT(text, testing::HasSubstr("[[frame]]"));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("[[joint]]")));
  EXPECT_EQ(keys({"hinge"}).status, 2);
}

TEST(Manual, SaysWhoRunsCompilersAndWhatAnInterruptionEndsWith) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(support::run_process({JOURDAIN_BINARY, "pages", folder.path()}).status, 0);
  const std::string page = support::read_file(folder.path() + "/man/man1/jourdain.1");
  const std::size_t three = page.find(".B 3\n"), seventy = page.find(".B 70\n"),
                    compiler = page.find(".B CXX\n");
  ASSERT_LT(compiler, page.size());
  EXPECT_THAT(page.substr(three, seventy - three), testing::HasSubstr("SIGTERM"));
  for (const char* command : {"simulate", "ensemble", "report", "cost", "bench", "python"})
    EXPECT_THAT(page.substr(compiler, page.find(".B CC\n") - compiler), testing::HasSubstr(command));
}

}  // namespace
}  // namespace jourdain::tests
