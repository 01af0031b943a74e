// With sines and cosines of their own steps take the same instructions at every angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/tool.hpp"
#include "firmware/firmware.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// The model with its first coordinate beginning `turns` turns further on, which closes its loops as before.
std::string turned(const std::string& model, int turns) {
  std::string text = support::read_file(fmt::format("{}/models/{}.toml", JOURDAIN_SOURCE_DIR, model));
  constexpr std::string_view kKey = "initial_position = ";
  const std::size_t begin = text.find(kKey) + kKey.size(), end = text.find('\n', begin);
  std::string value = text.substr(begin, end - begin);
  value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
  return text.replace(begin, end - begin, fmt::format("\"{} + {}*pi\"", value, 2 * turns));
}

/// The model with every coordinate beginning at `angle`.
std::string with_angles(const std::string& model, const std::string& angle) {
  std::string text = support::read_file(fmt::format("{}/models/{}.toml", JOURDAIN_SOURCE_DIR, model)), result;
  constexpr std::string_view kKey = "initial_position = ";
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    result += (line.starts_with(kKey) ? std::string(kKey) + angle : line) + "\n";
  }
  return result;
}

long step_instructions(const std::string& model, const std::string& text, const char* option) {
  const support::TemporaryFolder folder;
  const std::string file = fmt::format("{}/{}.toml", folder.path(), model),
                    output = folder.path() + "/cost.json";
  support::write_file(file, text);
  std::vector<std::string> command = {JOURDAIN_BINARY, "cost", file, "--target", "cortex-m4",
                                      "--methods",     "rk4",  "-o", output};
  if (*option) command.emplace_back(option);
  const support::ProcessResult result = support::run_process(command);
  EXPECT_EQ(result.status, 0) << result.output;
  const nlohmann::json cost = nlohmann::json::parse(support::read_file(output));
  for (const nlohmann::json& function : cost["functions"])
    if (function["name"] == "rk4_step") return function["instructions"].get<long>();
  ADD_FAILURE() << "no rk4_step of " << model;
  return 0;
}

TEST(OwnSinesCost, IsTheSameAtEveryAngle) {
  require_tools(*commands::find_target("cortex-m4"));
  for (const std::string model : {"pendulum", "panda"}) {
    const auto instructions = [&](const char* angle, const char* option) {
      return step_instructions(model, with_angles(model, angle), option);
    };
    const long first = instructions("0", "");
    EXPECT_GT(first, 100);
    for (const char* angle : {"0.3", "0.79", "2", "-50", "300", "1e5", "1.07e9", "1e30"})
      EXPECT_EQ(instructions(angle, ""), first) << model << " at " << angle;
    EXPECT_GT(instructions("300", "--libm"), 5 * instructions("0.3", "--libm")) << model;
  }
}

TEST(OwnSinesCost, IsTheSameWithClosedLoops) {
  require_tools(*commands::find_target("cortex-m4"));
  for (const std::string model : {"four_bar", "squeezer"}) {
    const long first = step_instructions(model, turned(model, 0), "");
    EXPECT_GT(first, 1000);
    for (const int turns : {-1, 1, 30, 1000})
      EXPECT_EQ(step_instructions(model, turned(model, turns), ""), first) << model << " after " << turns;
  }
}

}  // namespace
}  // namespace jourdain::tests
