// NAME.json: options that are not those of the command line are refused.
#include <gtest/gtest.h>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

TEST(Manifest, HoldsTheOptionsThatWereGiven) {
  const CompiledText text = compiled_text("pendulum", {"mass_matrix", "q_bar"});
  const std::string options = "  \"options\": [\"--functions=mass_matrix,q_bar\"],\n";
  ASSERT_NE(text.compiled.files.back().text.find(options), std::string::npos);
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  for (const char* wrong : {"", "  \"options\": [],\n", "  \"options\": [\"--functions=mass_matrix\"],\n",
                            "  \"options\": \"--functions=mass_matrix,q_bar\",\n"}) {
    std::vector<emit::File> files = text.compiled.files;
    std::string& manifest = files.back().text;
    manifest.replace(manifest.find(options), options.size(), wrong);
    EXPECT_FALSE(text.differences(files).empty()) << wrong;
  }
}

TEST(Manifest, HoldsNoneWhereNoneWasGiven) {
  const CompiledText text = compiled_text("pendulum");
  std::vector<emit::File> files = text.compiled.files;
  std::string& manifest = files.back().text;
  ASSERT_EQ(manifest.find("options"), std::string::npos);
  manifest.replace(manifest.find("{\n"), 2, "{\n  \"options\": [\"--clock\"],\n");
  EXPECT_FALSE(text.differences(files).empty());
}

}  // namespace
}  // namespace jourdain::tests
