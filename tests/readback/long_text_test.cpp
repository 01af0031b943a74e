// Text of large mechanisms: matrices that a loop mirrors and functions in parts are read back as if written out.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A planar chain of so many rods.
std::string chain(int count) {
  std::string text = "[model]\nname = \"chain\"\ngravity = [0, -9.81, 0]\n";
  for (int k = 1; k <= count; ++k)
    text += fmt::format(
        "[[body]]\nname = \"rod{0}\"\nmass = 1.0\ncenter_of_mass = [0.5, 0, 0]\n"
        "shape = {{ kind = \"rod\", length = 1.0, axis = \"x\" }}\n"
        "[[joint]]\nname = \"hinge{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"rod{0}\"\n"
        "axis = [0, 0, 1]\n{2}",
        k, k == 1 ? "world" : fmt::format("rod{}", k - 1), k == 1 ? "" : "position = [1.0, 0, 0]\n");
  return text;
}

constexpr const char* kLoop = "M[i][j] = M[j][i]";

TEST(MassMatrix, OfFewCoordinatesIsWrittenOut) {
  const CompiledText text = compiled_scene("chain", chain(24), {"mass_matrix"});
  EXPECT_THAT(text.compiled.files[1].text, Not(HasSubstr(kLoop)));
  EXPECT_THAT(text.compiled.files[1].text, HasSubstr("M[0][1] = M[1][0] = "));
  EXPECT_THAT(text.differences(text.compiled.files), ::testing::IsEmpty());
}

TEST(MassMatrix, OfManyCoordinatesIsMirroredByALoop) {
  const CompiledText text = compiled_scene("chain", chain(25), {"mass_matrix"});
  EXPECT_THAT(text.compiled.files[1].text, HasSubstr(kLoop));
  EXPECT_THAT(text.compiled.files[1].text, Not(HasSubstr("= M[1][0]")));
  EXPECT_THAT(text.differences(text.compiled.files), ::testing::IsEmpty());
  const std::vector<std::pair<std::string, std::string>> faults = {
      {kLoop, "M[i][j] = M[i][j]"},           {kLoop, "M[j][i] = M[i][j]"}, {kLoop, "M[i][j] = M[j][j]"},
      {"j < i; ++j) M", "j < i - 1; ++j) M"}, {"int i = 1;", "int i = 2;"}, {"i < 25; ++i)", "i < 24; ++i)"},
      {"i < 25; ++i)", "i < 26; ++i)"}};
  for (const auto& [right, wrong] : faults) {
    std::vector<emit::File> files = text.compiled.files;
    const std::size_t at = files[1].text.rfind(right);
    ASSERT_NE(at, std::string::npos) << right;
    files[1].text.replace(at, right.size(), wrong);
    EXPECT_THAT(text.differences(files), Not(::testing::IsEmpty())) << wrong;
  }
}

TEST(Parts, PassValuesThroughAnArrayWhoseEntriesAreUsedAgain) {
  const CompiledText text = compiled_scene("chain", chain(20), {"forward_dynamics_derivatives"});
  const std::string& kernels = text.compiled.files[1].text;
  std::smatch size;
  ASSERT_TRUE(std::regex_search(kernels, size, std::regex(R"(Real w\[(\d+)\];)")));
  const std::regex store(R"(\n  w\[(\d+)\] = )");
  const std::vector<std::smatch> stores{std::sregex_iterator(kernels.begin(), kernels.end(), store), {}};
  EXPECT_GT(stores.size(), std::stoul(size[1]));
  EXPECT_THAT(text.differences(text.compiled.files), ::testing::IsEmpty());
  for (std::size_t k = 0; k < stores.size(); k += stores.size() / 5) {
    std::vector<emit::File> files = text.compiled.files;
    const unsigned long entry = std::stoul(stores[k][1]), other = (entry + 1) % std::stoul(size[1]);
    files[1].text.replace(std::size_t(stores[k].position(1)), std::size_t(stores[k].length(1)),
                          std::to_string(other));
    EXPECT_THAT(text.differences(files), Not(::testing::IsEmpty())) << entry;
  }
}

}  // namespace
}  // namespace jourdain::tests
