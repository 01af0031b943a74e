// Motions that end in a finite time, which no step goes beyond, and stiff ones, which a step may leave unresolved.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "commands/pushed_scene.hpp"
#include "commands/run_jourdain.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

/// x'' = exp(x) from x = 1 at rest: x goes to infinity at t = pi/sqrt(2 e) = 1.3474 s.
TEST(BlowUp, IsNotSteppedAcross) {
  const PushedScene run(pushed_slide("1", "1", "", "exp(x)"));
  for (const char* method : {"rk4", "rodas4", "linearly_implicit_euler"})
    for (const char* step : {"0.002", "0.0003", "0.00005"}) {
      const support::ProcessResult result = run.simulate(method, step, "2");
      EXPECT_EQ(result.status, 1) << method << " " << step;
      EXPECT_NE(result.output.find("grows"), std::string::npos)
          << method << " " << step << ": " << result.output;
      EXPECT_NE(result.output.find("so does the motion"), std::string::npos) << result.output;
      EXPECT_EQ(result.output.find("rodas4"), std::string::npos) << "no method helps: " << result.output;
      EXPECT_FALSE(fs::exists(run.csv()));
    }
  EXPECT_EQ(run.simulate("rodas4", "0.002", "1.2").status, 0);
}

/// A plate of micrometres that pulls itself in: the gap of 2 um closes after 24 us.
TEST(BlowUp, OfMicrometresIsNotSteppedAcross) {
  const PushedScene run(
      pushed_slide("1e-9", "0", "stiffness = 1\ndamping = 1e-6\n", "8.854e-12*1e-8*20^2/(2*(2e-6 - x)^2)"));
  for (const char* method : {"rk4", "rodas4"})
    for (const char* step : {"3e-7", "1e-7", "1e-8"}) {
      const support::ProcessResult result = run.simulate(method, step, "1e-4");
      EXPECT_EQ(result.status, 1) << method << " " << step;
      EXPECT_NE(result.output.find("t = 2."), std::string::npos) << method << " " << step << result.output;
    }
  EXPECT_EQ(run.simulate("rk4", "1e-7", "2e-5").status, 0);
}

/// Slopes whose squares are no numbers any more.
TEST(BlowUp, OfHugeStiffnessIsAnError) {
  for (const char* force : {"-1e200*x", "-1e155*x", "1e200*x"}) {
    const PushedScene run(pushed_slide("1", "1", "", force));
    const support::ProcessResult result = run.simulate("rk4", "0.001", "1");
    EXPECT_EQ(result.status, 1) << force << result.output;
    EXPECT_NE(result.output.find("the run leaves all bounds"), std::string::npos) << result.output;
  }
}

support::ProcessResult simulate_model(const std::string& model, const std::string& method,
                                      const std::string& step) {
  const support::TemporaryFolder folder;
  return jourdain({"simulate", "models/" + model + ".toml", "--method", method, "--step", step, "--duration",
                   "3", "--output", folder.path() + "/x.csv"});
}

/// The velocity that grows is named, not one that swings meanwhile.
TEST(BlowUp, NamesWhatGrows) {
  std::string scene = pushed_slide("1", "1", "", "exp(x)");
  scene +=
      "[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"swing\"\ntype = \"prismatic\"\nparent = "
      "\"world\"\n"
      "child = \"b\"\naxis = [0, 1, 0]\ninitial_position = 0.1\nstiffness = 4e4\n";
  const support::ProcessResult result = PushedScene(scene).simulate("rodas4", "0.005", "3");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.output.find("what accelerates 'x' grows"), std::string::npos) << result.output;
}

/// Steps beyond the limit of an explicit method, which others do not have.
TEST(BlowUp, IsNoNameForAnUnstableStep) {
  const support::ProcessResult result = simulate_model("spring_joint", "adams_bashforth3", "0.005");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.output.find("is stable up to steps of"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("--method rodas4"), std::string::npos) << result.output;
}

/// Bristles let go, and a latch flips: steps are off for a while, and right again.
TEST(BlowUp, IsNotSeenWhereSomethingSlips) {
  const PushedScene slip(
      pushed_slide("1", "0", "", "2*(0.1*t - x)") +
      "[[friction]]\nname = \"bristles\"\njoint = \"x\"\ncoulomb = 1\nbreakaway = 1.5\n"
      "stribeck_speed = 0.001\nbristle_stiffness = 1e5\nbristle_damping = 300\nviscous = 0.4\n");
  for (const auto& [method, step] :
       {std::array{"linearly_implicit_euler", "0.0025"}, std::array{"linearly_implicit_euler", "0.003"},
        std::array{"rodas4", "0.005"}}) {
    const support::ProcessResult result = slip.simulate(method, step, "20");
    EXPECT_EQ(result.status, 0) << method << step << result.output;
  }
  const PushedScene latch(pushed_slide("1", "0", "stiffness = 400\ndamping = 20\n", "400*v") +
                          "[[state]]\nname = \"v\"\ninitial = 0.9\nrate = \"50*(v - v^3 + 0.6*sin(2*t))\"\n");
  const support::ProcessResult flipped = latch.simulate("rodas4", "0.02", "5");
  EXPECT_EQ(flipped.status, 0) << flipped.output;
}

/// What is stiff, or starts, changes much in a step, too.
TEST(BlowUp, IsNotSeenInStiffMotions) {
  for (const auto& [model, method, step] :
       {std::array{"elastic_arm", "rodas4", "0.01"}, std::array{"flyball_governor", "rodas4", "0.02"},
        std::array{"contact_wheel", "linearly_implicit_euler", "0.002"}}) {
    const support::ProcessResult result = simulate_model(model, method, step);
    EXPECT_EQ(result.status, 0) << model << result.output;
  }
}

}  // namespace
}  // namespace jourdain::tests
