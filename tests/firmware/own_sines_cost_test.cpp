// With sines and cosines of their own steps take the same instructions at every angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/tool.hpp"
#include "firmware/firmware.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

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

long step_instructions(const std::string& model, const std::string& angle, const char* option) {
  const support::TemporaryFolder folder;
  const std::string file = fmt::format("{}/{}.toml", folder.path(), model),
                    output = folder.path() + "/cost.json";
  support::write_file(file, with_angles(model, angle));
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
    const long first = step_instructions(model, "0", "--own-sines");
    EXPECT_GT(first, 100);
    for (const char* angle : {"0.3", "0.79", "2", "-50", "300", "1e5", "1.07e9", "1e30"})
      EXPECT_EQ(step_instructions(model, angle, "--own-sines"), first) << model << " at " << angle;
    EXPECT_GT(step_instructions(model, "300", ""), 5 * step_instructions(model, "0.3", "")) << model;
  }
}

}  // namespace
}  // namespace jourdain::tests
