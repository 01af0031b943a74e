// Runs in steps that are too long, told by what half the step changes.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "commands/pushed_scene.hpp"
#include "commands/run_jourdain.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSays = "this is not the motion: half the step changes velocities in ";

constexpr const char* kGrows = "small differences grow, the end depends on them";

support::ProcessResult simulate(const std::string& model, const std::string& method, const std::string& step,
                                const std::vector<std::string>& more = {}) {
  const support::TemporaryFolder folder;
  std::vector<std::string> words = {
      "simulate", "models/" + model + ".toml", "--method", method, "--step", step,
      "--output", folder.path() + "/x.csv"};
  words.insert(words.end(), more.begin(), more.end());
  const support::ProcessResult result = jourdain(words);
  EXPECT_TRUE(fs::exists(folder.path() + "/x.csv")) << model << result.output;
  return result;
}

/// Bristles that a step stretches too far hurl a block away, which flies on as if nothing were wrong; a wheel bounces
/// and spins as it should not; a linkage is braked by the method.
TEST(HalvedRun, TellsWhatIsNotTheMotion) {
  for (const auto& [model, method, step] :
       {std::array{"block_on_slope", "linearly_implicit_euler", "0.02"},
        std::array{"contact_wheel", "rk4", "0.02"}, std::array{"quarter_car", "rodas4", "0.05"},
        std::array{"tumbling_box", "rodas4", "0.01"},
        std::array{"four_bar", "linearly_implicit_euler", "0.02"}}) {
    const support::ProcessResult result = simulate(model, method, step, {"--duration", "3"});
    EXPECT_EQ(result.status, 1) << model;
    EXPECT_NE(result.output.find(kSays), std::string::npos) << model << result.output;
    EXPECT_NE(result.output.find("is too long"), std::string::npos) << model << result.output;
  }
}

TEST(HalvedRun, IsRightInShortSteps) {
  for (const auto& [model, method, step] :
       {std::array{"block_on_slope", "linearly_implicit_euler", "0.001"},
        std::array{"contact_wheel", "rk4", "0.0005"}, std::array{"quarter_car", "rodas4", "0.002"},
        std::array{"tumbling_box", "rodas4", "0.001"},
        std::array{"four_bar", "linearly_implicit_euler", "0.0005"}}) {
    const support::ProcessResult result = simulate(model, method, step, {"--duration", "3"});
    EXPECT_EQ(result.status, 0) << model << result.output;
    EXPECT_NE(result.output.find("half the step moves it by at most"), std::string::npos) << result.output;
  }
}

TEST(HalvedRun, AllowsWhatIsAskedFor) {
  const std::vector<std::string> allowed = {"--duration", "5", "--accuracy", "1"};
  EXPECT_EQ(simulate("four_bar", "linearly_implicit_euler", "0.02", allowed).status, 0);
  EXPECT_EQ(simulate("four_bar", "linearly_implicit_euler", "0.0005", {"--accuracy", "1e-9"}).status, 1);
}

/// A robot that falls about is chaotic: half the step leads elsewhere, though no step errs.
TEST(HalvedRun, LetsSensitiveMotionsBe) {
  const support::ProcessResult result = simulate("panda", "rk4", "0.001", {"--duration", "5"});
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find(kGrows), std::string::npos) << result.output;
}

/// An error that is known: x'' = -x by linearly implicit Euler, which shrinks amplitudes by exp(-h t/2) for
/// small steps h: from half the step they differ by exp(-h t/4) - exp(-h t/2), here by 0.0227 m at the last peak.
TEST(HalvedRun, PrintsWhatHalfTheStepChanges) {
  const PushedScene run(pushed_slide("1", "1", "stiffness = 1\n", "0"));
  const support::ProcessResult result = run.simulate("linearly_implicit_euler", "0.01", "10");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("half the step moves it by at most 0.02 m, 0.02 m/s\n"), std::string::npos)
      << result.output;
}

constexpr const char* kSecondSlide =
    "[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"y\"\ntype = \"prismatic\"\nparent = \"world\"\n"
    "child = \"b\"\naxis = [1, 0, 0]\n";

/// A spring that is let go far from rest relaxes within the first step, at the velocity that this takes.
TEST(HalvedRun, SeesNothingWhereStiffMotionsBegin) {
  for (const char* keys : {"stiffness = 1e6\ndamping = 1e4\n", "stiffness = 1e8\ndamping = 1\n"})
    for (const char* method : {"linearly_implicit_euler", "rodas4"}) {
      const support::ProcessResult result =
          PushedScene(pushed_slide("1", "0.1", keys, "0")).simulate(method, "0.01", "2");
      EXPECT_EQ(result.status, 0) << keys << method << result.output;
    }
}

/// A force that begins where a step ends is in that step for some methods, in the next one for shorter steps.
TEST(HalvedRun, SeesNothingWhereForcesBegin) {
  for (const char* force : {"if(t < 1, 0, 1e3)", "if(t < 0.9999, 0, 1e3)"})
    for (const char* method : {"heun", "rk4", "rk5", "ros34pw2", "rodas4", "linearly_implicit_euler"})
      for (const char* step : {"0.001", "0.01"}) {
        const PushedScene run(pushed_slide("1", "0.1", "damping = 1\n", force));
        const support::ProcessResult result = run.simulate(method, step, "2");
        EXPECT_EQ(result.status, 0) << force << method << step << result.output;
      }
}

/// One body meets another in the last hundredth of a step, and a locomotive draws wagons of which the last ones move by
/// nothing yet.
TEST(HalvedRun, SeesNothingWhereOthersAreFast) {
  const std::string impact = pushed_slide("1", "-0.01099", "initial_velocity = 1\n", "-1e6*max(x - y, 0)") +
                             kSecondSlide + "[[force]]\njoint = \"y\"\nvalue = \"1e6*max(x - y, 0)\"\n";
  EXPECT_EQ(PushedScene(impact).simulate("heun", "0.001", "0.1").status, 1) << "the impact gains energy";
  for (const char* method : {"rk4", "rk5", "rodas4"}) {
    const support::ProcessResult result = PushedScene(impact).simulate(method, "0.001", "0.1");
    EXPECT_EQ(result.status, 0) << method << result.output;
  }
  std::string train =
      "[model]\nname = \"train\"\ngravity = [0, 0, 0]\n[[repeat]]\ncount = 8\n[[repeat.body]]\n"
      "name = \"w{i}\"\nmass = 8e4\n[[repeat.joint]]\nname = \"x{i}\"\ntype = \"prismatic\"\n"
      "parent = \"world\"\nchild = \"w{i}\"\naxis = [1, 0, 0]\n[[repeat]]\ncount = 7\n"
      "[[repeat.force]]\njoint = \"x{i}\"\nvalue = \"1e7*(x{i+1} - x{i}) + 2e5*(x{i+1}.rate - x{i}.rate)\"\n"
      "[[repeat.force]]\njoint = \"x{i+1}\"\nvalue = \"1e7*(x{i} - x{i+1}) + 2e5*(x{i}.rate - "
      "x{i+1}.rate)\"\n"
      "[[force]]\njoint = \"x1\"\nvalue = 2e5\n";
  for (const char* step : {"0.02", "0.2"}) {
    const support::ProcessResult result = PushedScene(train).simulate("linearly_implicit_euler", step, "2");
    EXPECT_EQ(result.status, 0) << step << result.output;
  }
}

/// By symmetry a velocity stays rounding, which a long step may make a thousand times as much.
TEST(HalvedRun, SeesNothingInRounding) {
  EXPECT_EQ(simulate("standing_quadruped", "linearly_implicit_euler", "0.005").status, 0);
}

}  // namespace
}  // namespace jourdain::tests
