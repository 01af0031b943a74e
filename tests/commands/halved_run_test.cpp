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

constexpr const char* kSays = "this is not the motion: half the step changes ";

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

/// A body that spins at a constant rate turns further in each step than the method follows.
TEST(HalvedRun, LooksAtAttitudes) {
  const PushedScene spin(
      "[model]\nname = \"spin\"\ngravity = [0, 0, 0]\n[[body]]\nname = \"b\"\nmass = 1\n"
      "inertia = [0.1, 0.1, 0.1]\n[[joint]]\nname = \"f\"\ntype = \"free\"\nparent = \"world\"\n"
      "child = \"b\"\ninitial_angular_velocity = [30, 40, 100]\n");
  const support::ProcessResult wrong = spin.simulate("rk4", "0.02", "2");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.output.find("half the step changes the quaternion from 'f_qw' by 0.4"), std::string::npos)
      << wrong.output;
  EXPECT_NE(wrong.output.find("0.8 (quaternions)"), std::string::npos) << wrong.output;
  const support::ProcessResult right = spin.simulate("rk4", "0.001", "2");
  EXPECT_EQ(right.status, 0) << right.output;
}

/// An oscillation that a method brakes away is not forgotten in a long run, nor by how often rows are written.
TEST(HalvedRun, RemembersWhatIsBrakedAway) {
  const PushedScene run(pushed_slide("1", "1", "stiffness = 40\ndamping = 1e-4\n", "0"));
  for (const char* duration : {"20", "100", "2000"})
    EXPECT_EQ(run.simulate("linearly_implicit_euler", "0.1", duration).status, 1) << duration;
  for (const char* every : {"1", "50", "200"})
    EXPECT_EQ(run.simulate("linearly_implicit_euler", "0.1", "20", {"--every", every}).status, 1) << every;
  EXPECT_EQ(run.simulate("rodas4", "0.05", "20").status, 0);
}

/// Neither a pressure in Pa nor a fast rotor hides what else is wrong.
TEST(HalvedRun, LooksAtEachVelocityByItself) {
  const std::string pressure = "[[state]]\nname = \"p\"\nrate = \"0\"\ninitial = 2e7\nunit = \"Pa\"\n";
  EXPECT_EQ(PushedScene(pushed_slide("1", "0.01", "stiffness = 40\n", "0") + pressure)
                .simulate("linearly_implicit_euler", "0.1", "5")
                .status,
            1);
  const std::string pendulum =
      "[model]\nname = \"driven\"\ngravity = [0, -9.81, 0]\n[[body]]\nname = \"a\"\nmass = 1\n"
      "center_of_mass = [1, 0, 0]\n[[joint]]\nname = \"q\"\ntype = \"revolute\"\nparent = \"world\"\n"
      "child = \"a\"\naxis = [0, 0, 1]\ninitial_position = 0.5\n"
      "[[body]]\nname = \"spindle\"\nmass = 0.01\ninertia = [1e-4, 1e-4, 1e-4]\n"
      "[[joint]]\nname = \"s\"\ntype = \"revolute\"\nparent = \"a\"\nchild = \"spindle\"\n"
      "axis = [0, 0, 1]\ninitial_velocity = 3000\n";
  const support::ProcessResult braked =
      PushedScene(pendulum).simulate("linearly_implicit_euler", "0.05", "20");
  EXPECT_EQ(braked.status, 1) << braked.output;
  EXPECT_NE(braked.output.find("velocity 'q'"), std::string::npos) << braked.output;
  EXPECT_EQ(PushedScene(pendulum).simulate("rk4", "0.001", "5").status, 0);
}

/// Two rotors that a stiff clutch brings to rest in the first step; a memory that samples at every step, which is
/// another controller in shorter ones.
TEST(HalvedRun, SeesNothingWhereStepsAreMeant) {
  const std::string clutch =
      "[model]\nname = \"clutch\"\ngravity = [0, 0, 0]\n[[repeat]]\ncount = 2\n[[repeat.body]]\n"
      "name = \"b{i}\"\nmass = 1\ninertia = [0.1, 0.1, 0.1]\n[[repeat.joint]]\nname = \"q{i}\"\n"
      "type = \"revolute\"\nparent = \"world\"\nchild = \"b{i}\"\naxis = [0, 0, 1]\n"
      "initial_velocity = \"30 - 20*{i}\"\n"
      "[[force]]\njoint = \"q1\"\nvalue = \"2e3*(q2.rate - q1.rate)\"\n"
      "[[force]]\njoint = \"q2\"\nvalue = \"2e3*(q1.rate - q2.rate)\"\n";
  for (const char* duration : {"0.01", "1"}) {
    const support::ProcessResult result = PushedScene(clutch).simulate("rodas4", "0.001", duration);
    EXPECT_EQ(result.status, 0) << duration << result.output;
  }
  const std::string sampled = pushed_slide("1", "1", "", "u") +
                              "[[memory]]\nname = \"last\"\nupdate = \"x\"\nPERIOD\ninitial = 1\n"
                              "[[memory]]\nname = \"u\"\nupdate = \"-20*x - 4*(x - last)/0.01\"\nPERIOD\n";
  const auto with_period = [&](const std::string& period) {
    std::string scene = sampled;
    for (std::size_t at = 0; (at = scene.find("PERIOD")) != std::string::npos;)
      scene.replace(at, 6, "period = " + period);
    return PushedScene(scene).simulate("rk4", "0.01", "5");
  };
  const support::ProcessResult each = with_period("0"), slow = with_period("0.1");
  EXPECT_EQ(each.status, 0) << each.output;
  EXPECT_EQ(each.output.find("half the step"), std::string::npos) << each.output;
  EXPECT_NE(slow.output.find("half the step"), std::string::npos) << slow.output;
}

/// By symmetry a velocity stays rounding, which a long step may make a thousand times as much.
TEST(HalvedRun, SeesNothingInRounding) {
  EXPECT_EQ(simulate("standing_quadruped", "linearly_implicit_euler", "0.005").status, 0);
}

}  // namespace
}  // namespace jourdain::tests
