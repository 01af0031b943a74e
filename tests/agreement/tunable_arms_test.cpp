// Arms whose masses, centres of mass, inertias, lengths and twists are all parameters: inverse dynamics takes fewer
// operations than the recursions that others published for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "compile/compile.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

/// A row of modified Denavit–Hartenberg parameters: twist about x, length along it, offset along z; 0 is zero for good,
/// a right angle too, all else is a parameter.
struct Row {
  double twist = 0, length = 0, offset = 0;
  bool is_tunable = false;  ///< the twist
};

constexpr double kRight = 90;

std::string row_text(std::size_t j, const Row& row, std::string& parameters) {
  const auto parameter = [&](const char* name, double value) {
    if (value == 0) return std::string("0");
    parameters += fmt::format("{}{} = {}\n", name, j, value);
    return fmt::format("{}{}", name, j);
  };
  const std::string length = parameter("d", row.length), offset = parameter("r", row.offset);
  std::string sine = row.twist == 0 ? "0" : row.twist > 0 ? "1" : "(-1)", cosine = row.twist == 0 ? "1" : "0";
  std::string twist = fmt::format("{}*deg", row.twist);
  if (row.is_tunable) {
    parameters += fmt::format("al{} = {}\n", j, row.twist);
    twist = fmt::format("al{}", j);
    sine = "sin(" + twist + ")";
    cosine = "cos(" + twist + ")";
  }
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{{"m", 1 + 0.1 * double(j)},
                                                                               {"x", 0.1},
                                                                               {"y", 0.02 * double(j)},
                                                                               {"z", 0.03},
                                                                               {"xx", 0.31},
                                                                               {"yy", 0.32},
                                                                               {"zz", 0.33},
                                                                               {"xy", 0.01},
                                                                               {"xz", 0.02},
                                                                               {"yz", 0.015}})
    parameters += fmt::format("{}{} = {}\n", name, j, value);
  return fmt::format(
      "[[body]]\nname = \"b{0}\"\nmass = \"m{0}\"\ncenter_of_mass = [\"x{0}\", \"y{0}\", \"z{0}\"]\n"
      "inertia = {{ xx = \"xx{0}\", yy = \"yy{0}\", zz = \"zz{0}\", xy = \"xy{0}\", xz = \"xz{0}\", yz = "
      "\"yz{0}\" }}\n"
      "[[joint]]\nname = \"q{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"b{0}\"\naxis = [0, 0, "
      "1]\n"
      "position = [\"{2}\", \"-{3}*{4}\", \"{5}*{4}\"]\nrpy = [\"{6}\", 0, 0]\n",
      j, j == 1 ? "world" : fmt::format("b{}", j - 1), length, sine, offset, cosine, twist);
}

ir::Operations inverse_dynamics(const std::vector<Row>& rows, const std::string& gravity) {
  std::string parameters, parts;
  for (std::size_t j = 0; j < rows.size(); ++j) parts += row_text(j + 1, rows[j], parameters);
  const std::string text =
      fmt::format("[model]\nname = \"arm\"\ngravity = {}\n[parameters]\n{}{}", gravity, parameters, parts);
  support::Diagnostics diagnostics("arm.toml", text);
  const std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics);
  if (!mechanism) throw std::runtime_error(diagnostics.format() + text);
  CompileOptions options;
  options.functions = {"inverse_dynamics"};
  const CompiledModel compiled = compile(*mechanism, options);
  EXPECT_TRUE(compiled.verdict.accepted());
  return ir::count_operations(*ir::find_program(compiled.module, "inverse_dynamics"));
}

const std::string kDown = "[0, 0, -9.81]", kNone = "[0, 0, 0]";

/// Geometry: W. Khalil and E. Dombre, Modeling, Identification and Control of Robots (2002), and Puma's offsets.
TEST(TunableArms, TakeFewOperations) {
  const std::vector<Row> rx90 = {{}, {kRight}, {0, 0.45}, {-kRight, 0, 0.45}, {kRight}, {-kRight}};
  const std::vector<Row> puma = {{}, {-kRight}, {0, 0.43, 0.15}, {-kRight, 0.02, 0.43}, {kRight}, {-kRight}};
  const std::vector<Row> iiwa = {{},       {kRight}, {-kRight, 0, 0.42}, {-kRight}, {kRight, 0, 0.4},
                                 {kRight}, {-kRight}};
  EXPECT_EQ(inverse_dynamics(rx90, kDown).arithmetic(), 468u);
  EXPECT_EQ(inverse_dynamics(puma, kDown).arithmetic(), 488u);
  EXPECT_EQ(inverse_dynamics(iiwa, kDown).arithmetic(), 542u);
}

/// Published with base parameters: 486 multiplications and 380 additions for any six revolute joints, 38 and 27 for
/// three parallel ones without weight.
TEST(TunableArms, TakeFewerThanPublishedRecursions) {
  const std::vector<Row> general = {{0.3, 0.1, 0.2, true},   {0.4, 0.3, 0.15, true},
                                    {0.5, 0.2, 0.25, true},  {0.6, 0.12, 0.22, true},
                                    {0.7, 0.13, 0.14, true}, {0.8, 0.15, 0.16, true}};
  const ir::Operations six = inverse_dynamics(general, kDown);
  EXPECT_EQ(six.arithmetic(), 759u);
  EXPECT_LT(six.multiply, 486u);
  EXPECT_LT(six.add + six.subtract, 380u);
  const ir::Operations planar = inverse_dynamics({{}, {0, 0.3}, {0, 0.4}}, kNone);
  EXPECT_EQ(planar.arithmetic(), 60u);
  EXPECT_LT(planar.multiply, 38u);
  EXPECT_LT(planar.add + planar.subtract, 27u);
}

}  // namespace
}  // namespace jourdain::tests
