// The schemas, by a validator that knows nothing of Jourdain: python3-jsonschema.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "model/read/keys.hpp"
#include "package/project.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kSource = JOURDAIN_SOURCE_DIR;

support::ProcessResult validate(const std::string& schema, const std::vector<std::string>& files) {
  std::vector<std::string> command = {"/usr/bin/python3", (kSource / "tests/package/validate.py").string(),
                                      installation() + "/share/jourdain/" + schema};
  command.insert(command.end(), files.begin(), files.end());
  return support::run_process(command);
}

std::vector<std::string> files_of(const fs::path& folder, const std::string& extension) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == extension) files.push_back(entry.path().string());
  return files;
}

TEST(ModelSchema, AcceptsEveryModelAndAllExamplesOfKeys) {
  const support::TemporaryFolder folder;
  std::string examples;
  for (const model::KeySection& section : model::key_sections())
    examples += std::string(section.example) + "\n";
  support::write_file(folder.path() + "/examples.toml", examples);
  std::vector<std::string> models{folder.path() + "/examples.toml"};
  for (const auto& entry : fs::directory_iterator(kSource / "models"))
    if (entry.path().extension() == ".toml") models.push_back(entry.path().string());
  ASSERT_GE(models.size(), 28u);
  const support::ProcessResult result = validate("model.schema.json", models);
  EXPECT_EQ(result.status, 0) << result.output;
}

TEST(ModelSchema, RefusesUnknownKeysTablesAndWords) {
  const fs::path cases = kSource / "tests/diagnostics/cases";
  const std::pair<const char*, const char*> wrong[] = {
      {"unknown_key", "centre_of_mass"},      {"unknown_section", "'parameter'"},
      {"coordinate_unknown_key", "stifness"}, {"coupler_unknown_key", "'follow'"},
      {"import_unknown_key", "postion"},      {"override_unknown_key", "'mas'"},
      {"repeat_unknown_key", "bodies"},       {"loop_unknown_key", "lengt"},
      {"shape_unknown_kind", "cylindre"},     {"kinematics_unknown_axes", "'local'"},
      {"vector_wrong_count", "too short"},    {"joint_without_name", "'name' is a required"}};
  for (const auto& [name, message] : wrong) {
    const support::ProcessResult result =
        validate("model.schema.json", {(cases / (std::string(name) + ".toml")).string()});
    EXPECT_EQ(result.status, 1) << name;
    EXPECT_THAT(result.output, HasSubstr(message)) << name;
  }
}

TEST(ManifestSchema, AcceptsTheManifestsOfAllModelsOptionsAndImports) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/cell.toml", "[model]\nname = \"cell\"\n[[import]]\nfile = \"" +
                                                        (kSource / "models/pendulum.toml").string() + "\"\n");
  const support::ProcessResult made = support::run_process(
      {JOURDAIN_BINARY, "compile", folder.path() + "/cell.toml", "-o", folder.path(), "--functions",
       "initial_state,rodas4_step", "--frame", "tip=bob:pose", "--no-snap"});
  ASSERT_EQ(made.status, 0) << made.output;
  const std::string cell = folder.path() + "/cell.json";
  const std::string text = support::read_file(cell);
  EXPECT_THAT(text, HasSubstr("\"imported\""));
  EXPECT_THAT(
      text,
      HasSubstr(
          R"("options": ["--no-snap", "--functions=initial_state,rodas4_step", "--frame=tip=bob:pose"])"));
  std::vector<std::string> manifests = files_of(kSource / "generated", ".json");
  ASSERT_GE(manifests.size(), 28u);
  manifests.push_back(cell);
  const support::ProcessResult result = validate("manifest.schema.json", manifests);
  EXPECT_EQ(result.status, 0) << result.output;

  std::string misspelt = text;
  misspelt.replace(misspelt.find("\"velocities\""), 12, "\"velocites\"");
  support::write_file(folder.path() + "/misspelt.json", misspelt);
  EXPECT_EQ(validate("manifest.schema.json", {folder.path() + "/misspelt.json"}).status, 1);
}

}  // namespace
}  // namespace jourdain::tests
