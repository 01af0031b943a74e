// Robot files whose angles, axes and lengths were rounded, or carry the noise of what exported them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <sstream>

#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "support/files.hpp"
#include "support/uniform.hpp"

namespace jourdain::tests {
namespace {

using Change = std::function<double(double)>;

/// The text between quotes that follows each `opening`, with each of its numbers changed.
std::string with_numbers(const std::string& text, const std::string& opening, const Change& change) {
  std::string changed;
  std::size_t copied = 0;
  for (std::size_t at = text.find(opening); at != std::string::npos; at = text.find(opening, at + 1)) {
    const std::size_t begin = at + opening.size(), end = text.find('"', begin);
    changed += text.substr(copied, begin - copied);
    std::istringstream numbers(text.substr(begin, end - begin));
    for (double number = 0; numbers >> number;) changed += fmt::format("{:.17g} ", change(number));
    copied = end;
  }
  return changed + text.substr(copied);
}

std::string with_directions(const std::string& text, const Change& change) {
  return with_numbers(with_numbers(text, "rpy=\"", change), "<axis xyz=\"", change);
}

/// Operations of forward_dynamics; nothing where the description or the compiler refuses.
std::optional<long> operations(const std::string& robot, const std::string& text) {
  support::Diagnostics diagnostics(robot + ".urdf", text);
  const std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics);
  EXPECT_TRUE(mechanism) << diagnostics.format();
  if (!mechanism) return {};
  CompileOptions options;
  options.functions = {"forward_dynamics"};
  const CompiledModel compiled = compile(*mechanism, options);
  EXPECT_TRUE(compiled.verdict.accepted()) << robot << ": " << compiled.verdict.failures.front();
  for (const ir::Program& program : compiled.module.functions)
    if (program.name == "forward_dynamics") return ir::count_operations(program).arithmetic();
  return {};
}

double rounded(double value, int decimals) {
  return std::round(value * std::pow(10, decimals)) / std::pow(10, decimals);
}

TEST(RoundedDirections, CompileAndAgreeAndFourDecimalsCostNothing) {
  for (const std::string robot : {"biped", "rail_arm"}) {
    const std::string text = support::read_file(urdf_path(robot).string());
    const std::optional<long> exact = operations(robot, text);
    ASSERT_TRUE(exact);
    fmt::print("{:<12} as it is {:>5};", robot, *exact);
    for (int decimals = 2; decimals <= 7; ++decimals) {
      const auto count =
          operations(robot, with_directions(text, [&](double x) { return rounded(x, decimals); }));
      ASSERT_TRUE(count);
      fmt::print(" {} decimals {};", decimals, *count);
      if (decimals >= 4) {
        EXPECT_LE(*count, *exact) << decimals;
      }
    }
    for (const double noise : {1e-17, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-6, 1e-5}) {
      support::Uniform uniform(7);
      const auto count =
          operations(robot, with_directions(text, [&](double x) { return x + noise * uniform(-1, 1); }));
      ASSERT_TRUE(count);
      fmt::print(" {:g} {};", noise, *count);
      EXPECT_LE(*count, 1.02 * static_cast<double>(*exact))
          << noise;  // legs no longer share all their numbers
    }
    fmt::print("\n");
  }
}

// Where zeros were meant, programs that export robots leave what rounding left them.
TEST(RoundedDirections, LengthsAndProductsOfInertiaThatAreRoundingCostNothing) {
  const std::string robot = "rail_arm", text = support::read_file(urdf_path(robot).string());
  const auto with_dust = [&text](double dust) {
    std::string changed = text;
    for (const std::string opening : {" xyz=\"", "ixy=\"", "ixz=\"", "iyz=\""})
      changed = with_numbers(changed, opening, [dust](double x) { return x == 0 ? dust : x; });
    return changed;
  };
  const std::optional<long> exact = operations(robot, text);
  ASSERT_TRUE(exact);
  EXPECT_EQ(operations(robot, with_dust(1e-18)), exact);
  EXPECT_EQ(operations(robot, with_dust(-2.7e-51)), exact);
  const std::optional<long> meant = operations(robot, with_dust(1e-9));
  ASSERT_TRUE(meant);
  EXPECT_GT(*meant, *exact);
}

}  // namespace
}  // namespace jourdain::tests
