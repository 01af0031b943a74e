// Constants of the header that name entries: each wrong one is refused.
#include <gtest/gtest.h>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {
namespace {

/// Whether the header with `to` in the place of `from` is refused.
bool is_refused(const CompiledText& text, const std::string& from, const std::string& to) {
  std::vector<emit::File> files = text.compiled.files;
  const std::size_t at = files[0].text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at == std::string::npos) return false;
  files[0].text.replace(at, from.size(), to);
  return !text.differences(files).empty();
}

TEST(Indices, AreRefusedWhereOneIsWrong) {
  const CompiledText text = compiled_text("quadrotor", {"mass_matrix", "q_bar"});
  ASSERT_EQ(text.differences(text.compiled.files), std::vector<std::string>());
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"y_root_z = 2;", "y_root_z = 1;"},
      {"y_root_z = 2;", "y_root_z = -2;"},
      {"y_root_z = 2;", "y_root_z = 1 + 1;"},
      {"z_root_wx = 3;", "z_root_wy = 3;"},
      {"z_root_wx = 3;", "z_root_wx_2 = 3;"},
      {"u_thrust4 = 3;", "u_thrust4 = 4;"},
      {"inline constexpr int u_thrust2 = 1;\n", ""},
      {"inline constexpr int y_root_z = 2;", "inline constexpr long y_root_z = 2;"},
      {"inline constexpr int y_root_z = 2;", "constexpr int y_root_z = 2;"},
      {"namespace index {", "namespace indices {"},
      {"namespace index {\n", "namespace index {\ninline constexpr int y_more = 0;\n"},
      {"}  // namespace index", "inline constexpr int u_thrust5 = 4;\n}  // namespace index"},
      {"}  // namespace index", "template <class Real>\nstruct More { Real x; };\n}  // namespace index"}};
  for (const auto& [from, to] : faults) EXPECT_TRUE(is_refused(text, from, to)) << from << " -> " << to;
}

TEST(Indices, OfVelocitiesAreThoseOfTheIndependentOnes) {
  const CompiledText text = compiled_text("four_bar", {"mass_matrix", "q_bar"});
  EXPECT_NE(text.compiled.files[0].text.find("int y_rocker = 2;"), std::string::npos);
  EXPECT_EQ(text.compiled.files[0].text.find("z_rocker"), std::string::npos);
  EXPECT_TRUE(is_refused(text, "int z_crank = 0;", "int z_coupler = 0;"));
}

}  // namespace
}  // namespace jourdain::tests
