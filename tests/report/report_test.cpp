// Reports as their users make them: orders, sources of the error, recommendations, failures.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "agreement/exact_pendulum.hpp"
#include "pendulum/pendulum_kernels.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kSource = JOURDAIN_SOURCE_DIR;

support::ProcessResult jourdain(std::vector<std::string> arguments,
                                std::vector<std::string> environment = {}) {
  std::vector<std::string> command = {"env"};
  command.insert(command.end(), environment.begin(), environment.end());
  command.push_back(JOURDAIN_BINARY);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return support::run_process(command);
}

std::string model(const std::string& name) { return (kSource / "models" / (name + ".toml")).string(); }

/// The Panda arm with linear springs and dampers in its joints.
std::string compliant_panda(const std::string& folder) {
  std::string text = support::read_file(model("panda"));
  const std::string revolute = "type = \"revolute\"\n", elements = "stiffness = 20\ndamping = 0.5\n";
  for (std::size_t at = 0; (at = text.find(revolute, at)) != std::string::npos;
       at += revolute.size() + elements.size())
    text.insert(at + revolute.size(), elements);
  const std::string path = folder + "/panda.toml";
  support::write_file(path, text);
  return path;
}

/// Reports on six scenes, made once.
class Reports : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new support::TemporaryFolder;
    const std::string sweep = (kSource / "models/scenarios/panda_sweep.toml").string();
#ifdef JOURDAIN_SANITIZED  // arithmetic in 50 digits is too slow there; the release build makes all of them
    make("pendulum", {model("pendulum"), "--effort", "0.5"});
    return;
#endif
    make("pendulum", {model("pendulum"), "--effort", "3"});
    for (const char* name : {"double_pendulum", "lagrange_top", "spring_pendulum"})
      make(name, {model(name), "--effort", "1"});
    // The load hardly swings: errors of the best methods vanish in rounding unless steps are long.
    make("crane", {model("crane"), "--longest-step", "64ms", "--halvings", "9", "--effort", "1"});
    make("panda", {compliant_panda(folder_->path()), "--inputs", sweep, "--effort", "4", "--reference",
                   "extrapolation"});
  }
  static void TearDownTestSuite() { delete folder_; }

  static void make(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    const std::string out = folder_->path() + "/" + name;
    for (const std::string& argument :
         {std::string("--tolerance"), std::string("1e-6"), std::string("-o"), out})
      arguments.push_back(argument);
    const support::ProcessResult result = jourdain(arguments);
    ASSERT_EQ(result.status, 0) << result.output;
    texts_[name] = result.output;
    reports_[name] = json::parse(support::read_file(folder_->path() + "/" + name + "/report.json"));
  }

  static json point(const std::string& name, const std::string& method, double h) {
    for (const json& p : reports_[name]["points"])
      if (p["method"] == method && std::fabs(p["step_s"].get<double>() - h) < 1e-12) return p;
    ADD_FAILURE() << "no point of " << method << " at " << h;
    return {};
  }

  static support::TemporaryFolder* folder_;
  static std::map<std::string, json> reports_;
  static std::map<std::string, std::string> texts_;
};

support::TemporaryFolder* Reports::folder_ = nullptr;
std::map<std::string, json> Reports::reports_;
std::map<std::string, std::string> Reports::texts_;

TEST_F(Reports, OrdersAreTheMethodsOwn) {
#ifndef JOURDAIN_SANITIZED
  EXPECT_EQ(reports_.size(), 6u);
#endif
  for (const auto& [name, report] : reports_) {
    std::string line = fmt::format("{:<16}", name);
    EXPECT_EQ(report["methods"].size(), 11u);
    for (const json& method : report["methods"]) {
      ASSERT_FALSE(method["measured_order"].is_null()) << name << " " << method["name"];
      const double measured = method["measured_order"];
      // Implicit methods reach rounding before their slope settles on some scenes.
      const double tolerance = method["implicit"].get<bool>() ? 0.4 : 0.1;
      EXPECT_NEAR(measured, method["order"].get<double>(), tolerance) << name << " " << method["name"];
      line += fmt::format(" {:.3f}", measured);
    }
    fmt::print("{}\n", line);
  }
}

bool is_implicit(const json& report, const std::string& method) {
  for (const json& m : report["methods"])
    if (m["name"] == method) return m["implicit"];
  return false;
}

TEST_F(Reports, PartsOfTheErrorPredictIt) {
  // What they miss where errors are large is the quadratic part; these are small beside 1 rad.
  constexpr double kSmall = 1e-3;
  for (const auto& [name, report] : reports_) {
    double worst = 0;
    int judged = 0;
    const bool solvable = name == "pendulum" || name == "lagrange_top" || name == "panda";
    for (const json& s : report["error_sources"]) {
      const double measured = s["measured"]["position"], missed = s["difference"]["position"];
      if (measured > kSmall) continue;
      // An implicit method's accelerations carry errors of their own from step to step, which count at its longest.
      const double allowed = is_implicit(report, s["method"]) ? 0.6 : 0.1;
      EXPECT_TRUE(!solvable || missed < allowed * measured)
          << name << " " << s["method"] << " " << s["step_s"];
      worst = std::max(worst, missed / measured);
      ++judged;
    }
    fmt::print("{:<16} {:>3} points, parts miss at most {:.1e} of the error\n", name, judged, worst);
  }
}

TEST_F(Reports, AccelerationsFarFromTheUsualKeepTheirDigits) {
  constexpr double kBackward = 100;  // units of rounding
  for (const auto& [name, report] : reports_) {
    EXPECT_FALSE(report["extremes"].empty()) << name;
    double worst = 0;
    for (const json& sweep : report["extremes"])
      for (const json& point : sweep["points"]) {
        EXPECT_TRUE(point["finite"].get<bool>())
            << name << " " << sweep["quantity"] << " " << point["factor"];
        EXPECT_LE(point["backward_u"].get<double>(), kBackward)
            << name << " " << sweep["quantity"] << " " << point["factor"];
        worst = std::max(worst, point["backward_u"].get<double>());
      }
    fmt::print("{:<16} backward error {:.1f} u at most\n", name, worst);
    EXPECT_NE(texts_[name].find("accelerations far from the usual"), std::string::npos);
  }
}

TEST_F(Reports, StabilityAndStiffnessAreToldOfEveryModel) {
  for (const auto& [name, report] : reports_) {
    const json& limits = report["stability"]["limits"];
    EXPECT_EQ(limits.size(), report["methods"].size()) << name;
    EXPECT_NE(texts_[name].find("largest stable step"), std::string::npos);
    EXPECT_NE(texts_[name].find("none: L-stable"), std::string::npos);
  }
}

TEST_F(Reports, ErrorsOnThePendulumAreTheExactOnes) {
  for (const double h : {0.016, 0.008, 0.004, 0.002, 0.001, 0.0005}) {
    const pendulum::Model<> emitted;
    auto state = initial_state(emitted);
    for (long i = 0; i < std::lround(2 / h); ++i) rk4_step(emitted, state, {}, h);
    const double exact = double(std::fabs(static_cast<long double>(state.y[0]) - exact_pendulum_angle(2)));
    const double stated = point("pendulum", "rk4", h)["end"]["position"];
    fmt::print("pendulum, rk4, h = {:<7g} stated {:.10e}, exact {:.10e}\n", h, stated, exact);
    EXPECT_NEAR(stated, exact, 1e-15) << h;  // the closed form in long double has about 1e-17
  }
}

TEST_F(Reports, RoundingShowsOnThePendulum) {
  for (const char* method : {"rk4", "rk5"})
    for (const double h : {0.00025, 0.000125, 0.0000625}) {
      const double error = point("pendulum", method, h)["largest"]["position"];
      EXPECT_LT(error, 1e-12);
      EXPECT_GT(error, 1e-16);
    }
#ifndef JOURDAIN_SANITIZED  // too few steps in 50 digits for slopes
  for (const json& method : reports_["pendulum"]["methods"])
    if (method["name"] == "rk5") {
      EXPECT_GT(method["sources"]["rounding_dominates_below_s"].get<double>(), 1e-4);
      EXPECT_LT(method["sources"]["rounding_dominates_below_s"].get<double>(), 1e-2);
      EXPECT_LT(method["sources"]["rounding_slope"].get<double>(), 0);
    }
#endif
}

TEST_F(Reports, RecommendationsAreConfirmedByTheirRun) {
  for (const auto& [name, report] : reports_) {
    const json& advice = report["recommendation"];
    EXPECT_TRUE(advice["confirmed"].get<bool>()) << name;
    EXPECT_LE(advice["largest_error"]["position"].get<double>(), 1e-6) << name;
    EXPECT_NE(texts_[name].find("a run confirms it:"), std::string::npos);
  }
}

TEST_F(Reports, OtherIntegratorsAreComparedAtEqualError) {
  for (const auto& [name, report] : reports_) {
    const json &rows = report["alternatives"]["rows"], &advice = report["recommendation"];
    ASSERT_EQ(rows.size(), 5u) << name;
    EXPECT_EQ(rows[0]["integrator"], advice["method"]) << name;
    EXPECT_EQ(rows[0]["largest_error"]["position"], advice["largest_error"]["position"]) << name;
    EXPECT_EQ(rows[0]["ratio"], 1) << name;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const json& row = rows[i];
      ASSERT_TRUE(row["finished"].get<bool>()) << name << " " << row["integrator"];
      EXPECT_GT(row["ratio"].get<double>(), 0) << name << " " << row["integrator"];
      EXPECT_GE(row["calls"].get<long>(), row["steps"].get<long>()) << name << " " << row["integrator"];
      EXPECT_EQ(row["keeps_error"].get<bool>(), row["largest_error"]["position"].get<double>() <= 1e-6);
      EXPECT_TRUE(i == 4 || row["keeps_error"].get<bool>()) << name << " " << row["integrator"];
    }
    EXPECT_NE(texts_[name].find("other integrators on the same right-hand side"), std::string::npos);
  }
}

TEST_F(Reports, TheReferenceIsBetterThanEveryMethod) {
  for (const auto& [name, report] : reports_) {
    EXPECT_LT(report["reference"]["error"].get<double>(), 1e-17) << name;
    EXPECT_EQ(report["judged_s"], report["duration_s"]) << name;
  }
}

#ifndef JOURDAIN_SANITIZED  // the Panda's report is made in the release build only
TEST_F(Reports, AFollowedMotionIsItsOwnExactSolution) {
  // The sweep ends where it starts, so that the error at the end is the distance to the start.
  const std::string csv = folder_->path() + "/sweep.csv";
  const support::ProcessResult result =
      jourdain({"simulate", folder_->path() + "/panda.toml", "--inputs",
                (kSource / "models/scenarios/panda_sweep.toml").string(), "--duration", "2", "--step",
                "0.008", "--every", "250", "--output", csv});
  ASSERT_EQ(result.status, 0) << result.output;
  const std::string text = support::read_file(csv);
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  double t = 0, y[7] = {};
  ASSERT_EQ(std::sscanf(text.c_str() + last, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t, &y[0], &y[1], &y[2],
                        &y[3], &y[4], &y[5], &y[6]),
            8);
  const double start[7] = {0, -0.5, 0, -2, 0, 1.6, 0.8};
  double error = 0;
  for (int i = 0; i < 7; ++i) error = std::max(error, std::fabs(y[i] - start[i]));
  EXPECT_NEAR(error, point("panda", "rk4", 0.008)["end"]["position"].get<double>(), 1e-12);
}
#endif

TEST_F(Reports, DescriptorFormDriftsAndProjectionStopsIt) {
  for (const auto& [name, report] : reports_) {
    // Bodies of a pendulum without inertia about their centre cannot be free, nor can springs act on what is
    // no coordinate.
    ASSERT_EQ(report["first_kind"].size(), name == "lagrange_top" ? 5u : 3u) << name;
    const json &minimal = report["first_kind"][0], &plain = report["first_kind"][1],
               &projected = report["first_kind"][2];
    EXPECT_GT(plain["unknowns"], minimal["unknowns"]);
    for (const json& p : projected["points"])
      EXPECT_TRUE(!p["finite"] || p["drift"].get<double>() < 1e-8) << name;
    // With the longest step the plain form has left its constraints further than the projected one.
    EXPECT_GT(plain["points"][0]["drift"].get<double>(), 10 * projected["points"][0]["drift"].get<double>())
        << name;
  }
}

#ifndef JOURDAIN_SANITIZED  // the top's report is made in the release build only
TEST_F(Reports, FreeBodiesAreEmittedToo) {
  const json& forms = reports_["lagrange_top"]["first_kind"];
  const json &minimal = forms[3], &free = forms[4];
  EXPECT_EQ(minimal["form"], "emitted: minimal coordinates");
  EXPECT_EQ(free["form"], "emitted: free bodies");
  EXPECT_EQ(free["states"], 13);
  EXPECT_EQ(free["unknowns"], 3);
  ASSERT_GE(free["points"].size(), 5u);
  for (const json& p : free["points"]) EXPECT_LT(p["drift"].get<double>(), 1e-12);
  const auto error = [](const json& form, std::size_t i) {
    return form["points"][i]["position_error_m"].get<double>();
  };
  EXPECT_NEAR(std::log2(error(free, 2) / error(free, 3)), 4, 0.3);
  EXPECT_NEAR(std::log2(error(minimal, 2) / error(minimal, 3)), 4, 0.3);
}
#endif

TEST_F(Reports, ThePageIsWholeAndNeedsNothingElse) {
  const std::string page = support::read_file(folder_->path() + "/pendulum/report.html");
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find(" src="), std::string::npos);
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_NE(page.find("id=\"work_precision\""), std::string::npos);
  EXPECT_NE(page.find("\"frames\":["), std::string::npos);
  EXPECT_NE(page.find("<td>Dormand-Prince 5(4)</td>"), std::string::npos);
  EXPECT_EQ(page.substr(page.size() - 8), "</html>\n");
}

TEST(Report, InputsThatAreHeldCostAnOrder) {
  const support::TemporaryFolder folder;
  const std::string inputs = folder.path() + "/push.toml";
  support::write_file(inputs, "[input]\npush = \"2*sin(5*t)\"\n");
  const auto report = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"report",      model("cart_pole"),
                                          "--inputs",    inputs,
                                          "--methods",   "rk4,heun",
                                          "--effort",    "0.3",
                                          "--no-forms",  "--no-plots",
                                          "--tolerance", "1e-3",
                                          "-o",          folder.path() + "/out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const support::ProcessResult result = jourdain(arguments);
    EXPECT_EQ(result.status, 0) << result.output;
    return std::pair(json::parse(support::read_file(folder.path() + "/out/report.json")), result.output);
  };
  const auto [sampled, text] = report({});
  const json& advice = sampled["recommendation"];
  EXPECT_FALSE(advice["inputs_held"].get<bool>());
  EXPECT_GT(advice["largest_error_with_inputs_held"]["position"].get<double>(),
            100 * advice["largest_error"]["position"].get<double>());
  EXPECT_NE(text.find("held over each step, position error"), std::string::npos);
  EXPECT_GT(advice["step_s"].get<double>(), 0.017);  // beyond the usual longest step
  const fs::path out = folder.path() + "/out";
  for (const char* name : {"report.html", "error_sources.csv", "error_sources_rk4.svg", "mine.csv"})
    support::write_file((out / name).string(), "of an older report, or mine");
  const auto [held, held_text] = report({"--hold-inputs"});
  EXPECT_TRUE(held["recommendation"]["inputs_held"].get<bool>());
  for (const fs::path& file : fs::directory_iterator(out))
    EXPECT_EQ(held_text.find(file.string()) != std::string::npos, file.filename() != "mine.csv") << file;
  EXPECT_LE(held["recommendation"]["largest_error"]["position"].get<double>(), 1e-3);
  for (const json& method : held["methods"]) EXPECT_NEAR(method["measured_order"].get<double>(), 1, 0.1);
}

TEST(Report, MostAccurateWithinABudget) {
  const support::TemporaryFolder folder;
  const support::ProcessResult result =
      jourdain({"report", model("double_pendulum"), "--budget", "20us", "--effort", "0.3", "--no-forms",
                "--no-plots", "-o", folder.path() + "/out"});
  ASSERT_EQ(result.status, 0) << result.output;
  const json advice = json::parse(support::read_file(folder.path() + "/out/report.json"))["recommendation"];
  // The confirming run measures anew, and a busy machine may be slower then: the report has to say so.
  const double run_time = advice["run_time_per_simulated_second_s"].get<double>() * 1e-3;
  EXPECT_EQ(advice["confirmed"].get<bool>(), run_time <= 20e-6);
  const double steps = 1e-3 / advice["step_s"].get<double>();
  EXPECT_NEAR(steps, std::round(steps), 1e-9);
}

TEST(Report, JudgesChaoticMotionOnlyWhileTwoReferencesAgree) {
  const support::TemporaryFolder folder;
  std::string text = support::read_file(model("double_pendulum"));
  for (std::size_t at = 0; (at = text.find("45*deg", at)) != std::string::npos;)
    text.replace(at, 6, "150*deg");
  const std::string path = folder.path() + "/chaos.toml";
  support::write_file(path, text);
  const support::ProcessResult result =
      jourdain({"report", path, "--duration", "30s", "--effort", "0.3", "--no-forms", "--methods", "rk4,rk5",
                "-o", folder.path() + "/out"});
  ASSERT_EQ(result.status, 0) << result.output;
  const json report = json::parse(support::read_file(folder.path() + "/out/report.json"));
  EXPECT_LT(report["reference"]["error"].get<double>(), 1e-6);
  EXPECT_LT(report["judged_s"].get<double>(), 25);
  EXPECT_GT(report["judged_s"].get<double>(), 2);
  const std::size_t second = result.output.find('\n') + 1;
  EXPECT_EQ(result.output.compare(second, 20, "  NOT THE WHOLE TIME"), 0) << result.output;
  const std::string page = support::read_file(folder.path() + "/out/report.html");
  EXPECT_NE(page.find("</h1>\n<p class=\"warning\">NOT THE WHOLE TIME"), std::string::npos);
}

TEST(Report, FailuresOfTheEnvironmentEndWithStatusThree) {
  const support::TemporaryFolder folder;
  const std::string out = folder.path() + "/out";
  const auto expect = [](const support::ProcessResult& result, int status, const std::string& part) {
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  expect(jourdain({"report", model("pendulum"), "-o", out}, {"PATH=/nowhere"}), 3, "gnuplot");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--no-plots"}, {"PATH=/nowhere"}), 3,
         "cannot run 'c++'");
  expect(jourdain({"report", model("pendulum"), "-o", "/proc/nowhere/out"}), 3, "/proc/nowhere");
  expect(jourdain({"report", model("pendulum"), "-o", model("pendulum")}), 3, "pendulum.toml");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--tolerance", "1e-6", "--budget", "1us"}), 2,
         "--budget");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--budget", "1 parsec"}), 2, "20us");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--duration", "1000000s"}), 2, "are possible");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--real", "float", "--reference", "cvode"}), 2,
         "double");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--set", "length=1"}), 2, "no parameter 'length'");
  expect(jourdain({"report", model("pendulum"), "-o", out, "--methods", "rk44"}), 2, "did you mean 'rk4'");
  EXPECT_FALSE(fs::exists(out));
}

/// A mass of 2 kg that meets a stop at 1 m/s, without damping: it goes in by v sqrt(m/k), for pi sqrt(m/k).
TEST(Report, SaysHowDeepAStopIsPressedAndWhatKeepsItWithinADepth) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/stop.toml";
  support::write_file(path, R"([model]
name = "stop"
gravity = [0, 0, 0]
[parameters]
k = 800
[[body]]
name = "mass"
mass = 2
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "mass"
axis = [1, 0, 0]
initial_velocity = 1
[[stop]]
name = "buffer"
joint = "slide"
upper = 0.1
stiffness = "k"
)");
  std::string printed;
  const auto buffer = [&](const std::string& stiffness) {
    const std::string out = folder.path() + "/out" + stiffness;
    const auto result = jourdain({"report",        path,    "--set",      "k=" + stiffness,
                                  "--penetration", "0.01",  "--duration", "1s",
                                  "--halvings",    "6",     "--methods",  "rk4",
                                  "--reference",   "cvode", "--no-forms", "--no-plots",
                                  "--effort",      "0.5",   "-o",         out});
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("one-sided elements"), std::string::npos);
    printed = result.output;
    return json::parse(support::read_file(out + "/report.json"))["one_sided_elements"]["elements"][0];
  };
  const json soft = buffer("800");
  EXPECT_EQ(soft["name"], "buffer");
  EXPECT_EQ(soft["unit"], "m");
  EXPECT_NEAR(soft["deepest"].get<double>(), 0.05, 1e-5);
  EXPECT_NEAR(soft["at_s"].get<double>(), 0.1 + std::acos(0.0) * 0.05, 1e-3);
  EXPECT_NEAR(soft["share"].get<double>(), std::acos(-1.0) * 0.05 / 1.008, 5e-4);  // whole longest steps
  EXPECT_NEAR(soft["stiffness_within_depth"].get<double>(), 800 * std::pow(0.05 / 0.008, 2), 20);
  EXPECT_NEAR(soft["steps_within_depth"].get<double>(), 0.16, 1e-4);
  const json hard = buffer("31250");
  EXPECT_NEAR(hard["deepest"].get<double>(), 0.008, 1e-5);
  EXPECT_FALSE(hard.contains("stiffness_within_depth"));
  // Deeper than asked for when it starts: no stiffness keeps it within.
  std::string pressed = support::read_file(path);
  pressed.replace(pressed.find("initial_velocity = 1"), 20, "initial_position = 0.112");
  support::write_file(path, pressed);
  const json deep = buffer("801");
  EXPECT_NEAR(deep["deep_at_start"].get<double>(), 0.012, 1e-9);
  EXPECT_FALSE(deep.contains("stiffness_within_depth"));
  EXPECT_EQ(soft["deep_at_start"], 0.0);
  EXPECT_NE(printed.find("none: it starts deeper"), std::string::npos) << printed;
  const auto none = jourdain({"report", JOURDAIN_SOURCE_DIR "/models/pendulum.toml", "--penetration", "0.01",
                              "-o", folder.path() + "/none"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.output.find("'pendulum' has none"), std::string::npos) << none.output;
}

/// A quarter of a car that drives over a bump, its tyre off the road for a while: a run confirms the step.
TEST(Report, RecommendsAStepForATyreOnABump) {
  const support::TemporaryFolder folder;
  const auto result =
      jourdain({"report", model("quarter_car"), "--tolerance", "1e-3", "--duration", "1s", "--halvings", "6",
                "--methods", "rk4,adams_bashforth3", "--reference", "cvode", "--no-forms", "--no-plots",
                "--effort", "0.5", "-o", folder.path() + "/out"});
  ASSERT_EQ(result.status, 0) << result.output;
  const json advice = json::parse(support::read_file(folder.path() + "/out/report.json"))["recommendation"];
  EXPECT_TRUE(advice["confirmed"].get<bool>());
  EXPECT_LE(advice["largest_error"]["position"].get<double>(), 1e-3);
  EXPECT_NE(result.output.find("a run confirms it:"), std::string::npos) << result.output;
}

/// A wheel that rolls straight ahead over ground with a height: nothing pushes its tyre sideways.
TEST(Report, ComparesNothingWithRowsThatAreZeroBySymmetry) {
  const support::TemporaryFolder folder;
  const std::string path = folder.path() + "/wheel.toml";
  support::write_file(path, R"toml([model]
name = "wheel"
gravity = [0, 0, -9.81]
[parameters]
k = 2e5
[[body]]
name = "hub"
mass = 20
[[body]]
name = "wheel"
mass = 15
inertia = [0.5, 1, 0.5]
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "hub"
axis = [1, 0, 0]
initial_velocity = 10
[[joint]]
name = "spin"
type = "revolute"
parent = "hub"
child = "wheel"
axis = [0, 1, 0]
position = [0, 0, 0.29]
initial_velocity = 33.3
[[tyre]]
name = "t"
frame = "wheel"
radius = 0.3
stiffness = "k"
height = "0.01*sin(x)"
friction = 0.9
relaxation_length = 0.3
stiffness_factor = [12, 10]
shape_factor = [1.6, 1.3]
)toml");
  const auto result = jourdain({"report", path, "--duration", "0.2s", "--halvings", "2", "--methods", "rk4",
                                "--no-forms", "--no-plots", "--effort", "0.2", "-o", folder.path() + "/out"});
  ASSERT_EQ(result.status, 0) << result.output;
  const json sweeps = json::parse(support::read_file(folder.path() + "/out/report.json"))["extremes"];
  ASSERT_EQ(sweeps.size(), 3u);
  for (const json& sweep : sweeps)
    for (const json& point : sweep["points"]) {
      EXPECT_GT(point["backward_u"].get<double>(), 0) << sweep["quantity"] << " " << point["factor"];
      // The wheel's own row holds what rounding leaves of the normal force's moment, however slow it turns.
      const double most = sweep["quantity"] == "all velocities" ? 1e9 : 100;
      EXPECT_LE(point["backward_u"].get<double>(), most) << sweep["quantity"] << " " << point["factor"];
    }
}

/// A control loop may have no longer one.
TEST(Report, RecommendsNoStepBeyondTheOneThatIsGiven) {
  const support::TemporaryFolder folder;
  const auto report = [&](const std::string& longest) {
    std::vector<std::string> arguments = {"report",      model("pendulum"),
                                          "--tolerance", "0.1",
                                          "--halvings",  "2",
                                          "--methods",   "rk4",
                                          "--effort",    "0.3",
                                          "--no-forms",  "--no-plots",
                                          "--reference", "cvode",
                                          "-o",          folder.path() + "/out"};
    if (!longest.empty()) arguments.insert(arguments.end(), {"--longest-step", longest});
    const support::ProcessResult result = jourdain(arguments);
    EXPECT_EQ(result.status, 0) << result.output;
    const json all = json::parse(support::read_file(folder.path() + "/out/report.json"));
    double tried = 0;
    for (const json& p : all["points"]) tried = std::max(tried, p["step_s"].get<double>());
    return std::pair(all["recommendation"]["step_s"].get<double>(), tried);
  };
  const auto [advised, tried] = report("20ms");
  EXPECT_NEAR(advised, 0.02, 1e-12);
  EXPECT_NEAR(tried, 0.02, 1e-12);
  const auto [free_advised, free_tried] = report("");
  EXPECT_GT(free_advised, 0.03);
  EXPECT_GT(free_tried, 0.03);
}

}  // namespace
}  // namespace jourdain::tests
