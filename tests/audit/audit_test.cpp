// A report's figures against runs and solutions that know nothing of how reports are made.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "properties/effort.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;

constexpr double kInterval = 1e-3, kSampling = 16e-3, kTolerance = 1e-6;
const std::vector<std::string> kMethods = {"euler",
                                           "adams_bashforth2",
                                           "adams_bashforth3",
                                           "linearly_implicit_euler",
                                           "ros34pw2",
                                           "semi_implicit_euler",
                                           "heun",
                                           "rk4",
                                           "rk5",
                                           "rosw43",
                                           "rodas4"};

/// A method with a step, and the error that the report states; infinite where it says that the run fails.
struct Claim {
  std::string method;
  double h = 0, error = 0;
  bool recommended = false;

  /// Between two comparisons.
  double compared() const { return std::max(h, kSampling); }
};

std::vector<Claim> claims_of(const json& report) {
  std::vector<Claim> claims;
  for (const json& point : report["points"])
    claims.push_back({point["method"], point["step_s"],
                      point["finite"].get<bool>() ? point["largest"]["position"].get<double>() : INFINITY});
  const json& advice = report["recommendation"];
  if (advice.contains("method"))
    claims.push_back({advice["method"], advice["step_s"], advice["largest_error"]["position"], true});
  return claims;
}

/// Errors of the claims: the first number printed is what the solution is known to.
std::vector<double> audited(const std::string& folder, const std::string& name, double duration,
                            const std::vector<Claim>& claims) {
  support::write_file(
      folder + "/main.cpp",
      fmt::format(
          "#include \"{0}_kernels.hpp\"\n#include \"audit/audit.hpp\"\n"
          "int main(int count, char** arguments) {{ return "
          "audit::run<{0}::Model, {0}::Accelerations<double>, {0}::RateHistory>(count, arguments); }}\n",
          name));
  const auto compiled = support::run_process({"c++", "-std=c++20", "-O2", "-I" + folder,
                                              fmt::format("-I{}/tests", JOURDAIN_SOURCE_DIR),
                                              folder + "/main.cpp", "-o", folder + "/audit"});
  EXPECT_EQ(compiled.status, 0) << compiled.output;
  std::vector<std::string> command = {folder + "/audit", std::to_string(std::lround(duration / kInterval)),
                                      fmt::format("{}", kInterval)};
  for (const Claim& claim : claims)
    for (const std::string& argument :
         {claim.method, fmt::format("{}", claim.h), std::to_string(std::lround(claim.compared() / claim.h)),
          std::to_string(std::lround(claim.compared() / kInterval))})
      command.push_back(argument);
  const auto result = support::run_process(command);
  EXPECT_EQ(result.status, 0) << result.output;
  std::istringstream lines(result.output);
  std::vector<double> numbers;
  for (std::string number; lines >> number;) numbers.push_back(std::strtod(number.c_str(), nullptr));
  return numbers;
}

class Audit : public testing::TestWithParam<const char*> {};

#ifdef JOURDAIN_SANITIZED  // reports in 50 digits are too slow there
constexpr const char* kReference = "cvode";
INSTANTIATE_TEST_SUITE_P(Scenes, Audit, testing::Values("shaking_cart"));
#else
constexpr const char* kReference = "auto";

/// Scenes of each kind: trees with and without quaternions, drives, stiff parts and loops.
std::vector<const char*> audited_scenes() {
  if (!draws_all_cases()) return {"double_pendulum", "quadrotor", "shaking_cart", "four_bar", "elastic_arm"};
  return {"double_pendulum", "cart_pole",     "spring_pendulum", "hoop_bead",
          "quadrotor",       "lagrange_top",  "crane",           "ur5",
          "shaking_cart",    "four_bar",      "slider_crank",    "mcpherson_strut",
          "spring_four_bar", "contact_wheel", "elastic_arm",     "flyball_governor"};
}
INSTANTIATE_TEST_SUITE_P(Scenes, Audit, testing::ValuesIn(audited_scenes()));
#endif

TEST_P(Audit, FindsTheErrorsThatTheReportStates) {
  const std::string name = GetParam();
  const support::TemporaryFolder folder;
  const std::string model = fmt::format("{}/models/{}.toml", JOURDAIN_SOURCE_DIR, name);
  std::vector<std::string> report = {JOURDAIN_BINARY, "report", model, "-o", folder.path() + "/report"};
  for (const char* option :
       {"--tolerance", "1e-6", "--halvings", "6", "--effort", "0.5", "--reference", kReference, "--methods"})
    report.emplace_back(option);
  std::vector<std::string> compile = {JOURDAIN_BINARY, "compile", model, "-o", folder.path(), "--functions"};
  for (const std::string& method : kMethods) {
    report.push_back(method);
    compile.push_back(method + "_step");
  }
  for (const char* function : {"initial_state", "position_rate", "forward_dynamics"})
    compile.push_back(function);
  ASSERT_EQ(support::run_process(report).status, 0);
  ASSERT_EQ(support::run_process(compile).status, 0);
  const json figures = json::parse(support::read_file(folder.path() + "/report/report.json"));
  const double judged = figures["judged_s"];
  EXPECT_NEAR(judged, figures["duration_s"], 1e-9);
  std::vector<Claim> claims = claims_of(figures);
  std::erase_if(claims, [](const Claim& claim) {  // the audit's solution is known every interval only
    return std::fabs(std::remainder(claim.compared(), kInterval)) > 1e-9;
  });
  ASSERT_GE(claims.size(), 12u);
  EXPECT_TRUE(claims.back().recommended);
  const std::vector<double> errors = audited(folder.path(), name, judged, claims);
  ASSERT_EQ(errors.size(), claims.size() + 1);
  constexpr double kFar = 1e-2;
  const double known = 10 * figures["reference"]["error"].get<double>() + 1e-12;
  const bool has_loops = !figures["loops"].empty();
  double worst = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    if (!std::isfinite(claim.error)) {
      // Of loops the report says so where their closing fails, too.
      EXPECT_TRUE(has_loops || !(errors[i + 1] < 1)) << claim.method << " " << claim.h;
      continue;
    }
    // Runs far off may be unstable ones, where the last bit counts.
    const double relative = errors[i + 1] < kFar ? 1e-3 : 0.2;
    EXPECT_NEAR(claim.error, errors[i + 1], relative * errors[i + 1] + known)
        << claim.method << " " << claim.h;
    if (claim.error > 1e-9 && claim.error < kFar)
      worst = std::max(worst, std::fabs(claim.error / errors[i + 1] - 1));
    if (claim.recommended) {
      EXPECT_LE(errors[i + 1], kTolerance);
    }
  }
  fmt::print(
      "{}: {} errors within {:.1e}; recommended {}_step, h = {:.4g} s, error {:.2g}; solution known to "
      "{:.0e}\n",
      name, claims.size(), worst, claims.back().method, claims.back().h, errors.back(), errors.front());
}

}  // namespace
}  // namespace jourdain::tests
