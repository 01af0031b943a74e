// Robot files whose angles and axes were rounded, or carry the noise of what exported them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <regex>
#include <sstream>

#include "agreement/shared_data.hpp"
#include "compile.hpp"
#include "support/files.hpp"
#include "support/uniform.hpp"

namespace jourdain::tests {
namespace {

using Change = std::function<double(double)>;

/// The description with each number of each rpy and axis changed.
std::string with_directions(const std::string& text, const Change& change) {
  static const std::regex attribute(R"(rpy="([^"]*)\"|<axis\s+xyz="([^"]*)\")");
  std::string changed;
  std::size_t copied = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), attribute), end; match != end; ++match) {
    const std::size_t group = (*match)[1].matched ? 1 : 2;
    const auto begin = static_cast<std::size_t>(match->position(group));
    changed += text.substr(copied, begin - copied);
    std::istringstream numbers((*match)[group].str());
    for (double number = 0; numbers >> number;) changed += fmt::format("{:.17g} ", change(number));
    copied = begin + (*match)[group].str().size();
  }
  return changed + text.substr(copied);
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

}  // namespace
}  // namespace jourdain::tests
