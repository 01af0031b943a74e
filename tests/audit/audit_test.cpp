// A report's figures against runs and solutions that know nothing of how reports are made.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "properties/effort.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;

constexpr double kTolerance = 1e-6;
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
  double compared = 0;  ///< s between two comparisons
};

std::vector<Claim> claims_of(const json& report) {
  std::vector<Claim> claims;
  const double interval = report["reference"]["interval_s"];
  for (const json& point : report["points"])
    claims.push_back({point["method"], point["step_s"],
                      point["finite"].get<bool>() ? point["largest"]["position"].get<double>() : INFINITY,
                      std::max(interval, point["step_s"].get<double>())});
  return claims;
}

Claim recommended(const json& report) {
  const json& advice = report["recommendation"];
  return {advice["method"], advice["step_s"], advice["largest_error"]["position"],
          advice["compared_every_s"]};
}

/// The program that audits a model.
void build_audit(const std::string& folder, const std::string& name) {
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
}

/// What the solution is known to, then the errors of the claims, which are compared at multiples of `interval` (s).
std::vector<double> audited(const std::string& folder, double duration, double interval,
                            const std::vector<Claim>& claims) {
  std::vector<std::string> command = {folder + "/audit", std::to_string(std::lround(duration / interval)),
                                      fmt::format("{}", interval)};
  for (const Claim& claim : claims)
    for (const std::string& argument :
         {claim.method, fmt::format("{}", claim.h), std::to_string(std::lround(claim.compared / claim.h)),
          std::to_string(std::lround(claim.compared / interval))})
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
  ASSERT_GE(claims.size(), 12u);
  build_audit(folder.path(), name);
  std::vector<double> errors = audited(folder.path(), judged, figures["reference"]["interval_s"], claims);
  ASSERT_EQ(errors.size(), claims.size() + 1);
  const Claim advised = recommended(figures);
  EXPECT_NEAR(advised.compared, advised.h, 1e-9 * advised.h);
  const std::vector<double> confirmed = audited(folder.path(), judged, advised.compared, {advised});
  ASSERT_EQ(confirmed.size(), 2u);
  EXPECT_LE(confirmed[1], kTolerance);
  claims.push_back(advised);
  errors.push_back(confirmed[1]);
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
    // Runs far off may be unstable ones, where the last bit counts. Of the last one, which confirms the recommendation,
    // the error has in it what is known of another solution, less where loops are closed.
    const bool confirms = i + 1 == claims.size();
    const double relative = errors[i + 1] >= kFar ? 0.2 : confirms && has_loops ? 0.02 : 1e-3;
    EXPECT_NEAR(claim.error, errors[i + 1], relative * errors[i + 1] + known)
        << claim.method << " " << claim.h;
    if (claim.error > 1e-9 && claim.error < kFar)
      worst = std::max(worst, std::fabs(claim.error / errors[i + 1] - 1));
  }
  fmt::print(
      "{}: {} errors within {:.1e}; recommended {}_step, h = {:.4g} s, error {:.2g}; solution known to "
      "{:.0e}\n",
      name, claims.size(), worst, claims.back().method, claims.back().h, errors.back(), errors.front());
}

/// A mass of 1 kg on a line, without its spring or force.
const std::string kSlider = R"toml([model]
name = "slider"
gravity = [0, 0, 0]
[[body]]
name = "a"
mass = 1
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "a"
axis = [1, 0, 0]
)toml";

/// Largest difference of a simulation's first coordinate to `exact`, over 2 s.
double simulation_error(const std::string& model, const Claim& claim,
                        const std::function<double(double)>& exact) {
  const double h = claim.h;
  const auto run = support::run_process(
      {JOURDAIN_BINARY, "simulate", model, "--method", claim.method, "--step", fmt::format("{:.17g}", h),
       "--duration", fmt::format("{:.17g}", std::floor(2 / h + 1e-9) * h), "--every", "1", "--output", "-"});
  std::istringstream lines(run.output);
  std::string line;
  double largest = 0, size = 0;
  std::size_t rows = 0;
  while (std::getline(lines, line)) {
    double t = 0, x = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &t, &x) != 2) continue;
    largest = std::max(largest, std::fabs(x - exact(t)));
    size = std::max(size, std::fabs(exact(t)));
    ++rows;
  }
  EXPECT_GE(double(rows), 2 / h - 1);
  // A run that loses a tenth of its energy fails, as one that half the step changes by a quarter, and is off by a
  // twentieth of its size at least.
  const bool is_lost = run.output.find("the energy, which nothing changes, drifted") != std::string::npos ||
                       run.output.find("this is not the motion") != std::string::npos;
  EXPECT_EQ(run.status, is_lost ? 1 : 0) << run.output;
  EXPECT_TRUE(!is_lost || largest > 0.05 * size) << largest;
  return largest;
}

/// Of an oscillation that comes round at every multiple of the longest step: its errors are greatest between these.
TEST(OscillationAudit, FindsTheErrorsThatTheReportStates) {
  constexpr double kAmplitude = 0.01, kFrequency = 2 * M_PI * 125, kAsked = 1e-4;
  const auto x = [](double t) { return kAmplitude * std::cos(kFrequency * t); };
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/oscillator.toml";
  support::write_file(model, kSlider + "stiffness = \"(2*pi*125)^2\"\ninitial_position = 0.01\n");
  for (const char* reference : {"auto", "cvode"}) {
    const auto report = support::run_process(
        {JOURDAIN_BINARY, "report", model, "-o", folder.path() + "/report", "--tolerance", "1e-4",
         "--reference", reference, "--effort", "0.5", "--methods", "rk4", "rk5", "rosw43"});
    ASSERT_EQ(report.status, 0) << report.output;
    const json figures = json::parse(support::read_file(folder.path() + "/report/report.json"));
    const Claim advised = recommended(figures);
    EXPECT_NEAR(advised.compared, advised.h, 1e-9 * advised.h);
    const double confirmed = simulation_error(model, advised, x);
    EXPECT_LE(confirmed, kAsked);
    EXPECT_NEAR(advised.error, confirmed, 1e-3 * confirmed) << advised.method << " " << advised.h;
    std::size_t compared = 0;
    for (const Claim& claim : claims_of(figures)) {
      if (!(claim.error > 1e-9 && claim.error < kAmplitude)) continue;
      const double error = simulation_error(model, claim, x);
      EXPECT_LE(claim.error, 1.001 * error) << reference << " " << claim.method << " " << claim.h;
      // Where steps are shorter than the reference's intervals the largest error may lie between these, as stated.
      EXPECT_GE(claim.error, (claim.compared < 1.001 * claim.h ? 0.999 : 0.7) * error)
          << reference << " " << claim.method << " " << claim.h;
      ++compared;
    }
    EXPECT_GE(compared, 6u);
  }
}

/// A force that turns round between the nodes of any step of a reference: constant on both sides, where no tolerance of
/// one step sees it.
TEST(JumpAudit, FindsTheErrorsThatTheReportStates) {
  constexpr double kJump = 0.7003, kForce = 3;
  const support::TemporaryFolder folder;
  const std::string model = folder.path() + "/turn.toml";
  support::write_file(
      model, kSlider + "initial_velocity = 1\n[[force]]\njoint = \"x\"\nvalue = \"if(t < 0.7003, 3, -3)\"\n");
  const auto x = [](double t) {
    const double after = std::max(0.0, t - kJump);
    return t + kForce * t * t / 2 - kForce * after * after;
  };
  const auto report = support::run_process({JOURDAIN_BINARY, "report", model, "-o", folder.path() + "/report",
                                            "--tolerance", "2e-4", "--effort", "0.5", "--methods", "rk4"});
  ASSERT_EQ(report.status, 0) << report.output;
  const json figures = json::parse(support::read_file(folder.path() + "/report/report.json"));
  std::vector<Claim> claims = claims_of(figures);
  claims.push_back(recommended(figures));
  EXPECT_LE(simulation_error(model, claims.back(), x), 2e-4);
  std::size_t compared = 0;
  for (const Claim& claim : claims) {
    if (claim.compared > 1.001 * claim.h || !std::isfinite(claim.error)) continue;
    EXPECT_NEAR(claim.error, simulation_error(model, claim, x), 1e-3 * claim.error) << claim.h;
    ++compared;
  }
  EXPECT_GE(compared, 6u);
}

}  // namespace
}  // namespace jourdain::tests
