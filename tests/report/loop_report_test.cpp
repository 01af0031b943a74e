// Reports on mechanisms with closed loops.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;

#ifndef JOURDAIN_SANITIZED  // arithmetic in 50 digits is too slow there

TEST(LoopReport, ErrorsComeFromTheirPartsAndLoopsStayClosed) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  const support::ProcessResult result = support::run_process(
      {JOURDAIN_BINARY, "report", std::string(JOURDAIN_SOURCE_DIR) + "/models/four_bar.toml", "--duration",
       "0.5s", "--longest-step", "8ms", "--halvings", "4", "--methods", "rk4,rk5", "--tolerance", "1e-5",
       "--effort", "1", "--no-plots", "-o", out});
  ASSERT_EQ(result.status, 0) << result.output;
  const json report = json::parse(support::read_file(out + "/report.json"));
  EXPECT_LT(report["reference"]["error"].get<double>(), 1e-16);
  EXPECT_FALSE(report["error_sources"].empty());
  for (const json& s : report["error_sources"])
    if (s["measured"]["position"].get<double>() < 1e-3) {
      EXPECT_LT(s["difference"]["position"].get<double>(), 0.1 * s["measured"]["position"].get<double>())
          << s["method"] << " " << s["step_s"];
    }
  const json& runs = report["loops"]["runs"];
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0]["step_s"], report["recommendation"]["step_s"]);
  EXPECT_NEAR(runs[1]["step_s"].get<double>(), 10 * runs[0]["step_s"].get<double>(), 1e-12);
  EXPECT_LT(runs[0]["largest_residual_m"].get<double>(), 1e-14);
  EXPECT_EQ(support::read_file(out + "/loops.csv").substr(0, 31), "method,step_s,steps,closed_by,l");
  // The same scene in absolute coordinates, whose loops other code closes.
  ASSERT_EQ(report["first_kind"].size(), 2u);
  const json& projected = report["first_kind"][1]["points"].back();
  EXPECT_LT(projected["position_error_m"].get<double>(), 1e-4);
  for (const char* part : {"closed loops\n", "the reference moves all positions", "each step ends with",
                           "1 degree of freedom: 3 coordinates of the tree"})
    EXPECT_NE(result.output.find(part), std::string::npos) << part << "\n" << result.output;
}

/// Absolute coordinates start with the states that the scene has.
TEST(LoopReport, FormsInOtherCoordinatesKnowStates) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/report";
  const support::ProcessResult result = support::run_process(
      {JOURDAIN_BINARY, "report", std::string(JOURDAIN_SOURCE_DIR) + "/tests/steppers/led_crank.toml",
       "--duration", "0.5s", "--longest-step", "8ms", "--halvings", "4", "--methods", "rk4", "--effort", "1",
       "--constant-input", "20", "--no-plots", "-o", out});
  ASSERT_EQ(result.status, 0) << result.output;
  const json report = json::parse(support::read_file(out + "/report.json"));
  ASSERT_EQ(report["first_kind"].size(), 2u);
  for (const json& form : report["first_kind"])
    EXPECT_LT(form["points"].back()["position_error_m"].get<double>(), 1e-4) << form["form"];
}

#endif

}  // namespace
}  // namespace jourdain::tests
