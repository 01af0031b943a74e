// Motions that end in a finite time, which no step goes beyond, and stiff ones, which a step may leave unresolved.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

namespace fs = std::filesystem;

/// A body of `mass` (kg) on a slide from `at` (m), with more keys of the joint, and a force on it.
std::string pushed_slide(const std::string& mass, const std::string& at, const std::string& keys,
                         const std::string& force) {
  return "[model]\nname = \"pushed\"\ngravity = [0, 0, 0]\n[[body]]\nname = \"a\"\nmass = " + mass +
         "\n[[joint]]\nname = \"x\"\ntype = \"prismatic\"\nparent = \"world\"\nchild = \"a\"\naxis = [1, 0, "
         "0]\n"
         "initial_position = " +
         at + "\n" + keys + "[[force]]\njoint = \"x\"\nvalue = \"" + force + "\"\n";
}

class PushedScene {
 public:
  explicit PushedScene(const std::string& scene) {
    support::write_file(folder_.path() + "/scene.toml", scene);
  }

  support::ProcessResult simulate(const std::string& method, const std::string& step,
                                  const std::string& duration) const {
    return jourdain({"simulate", folder_.path() + "/scene.toml", "--method", method, "--step", step,
                     "--duration", duration, "--output", csv()});
  }
  std::string csv() const { return folder_.path() + "/x.csv"; }

 private:
  support::TemporaryFolder folder_;
};

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

/// Bristles that a step stretches too far hurl the block away, which flies on as if nothing were wrong.
TEST(ThrownOff, IsAnError) {
  for (const auto& [model, method, step, velocity] :
       {std::array{"block_on_slope", "linearly_implicit_euler", "0.01", "root_v"},
        std::array{"block_on_slope", "linearly_implicit_euler", "0.02", "root_v"},
        std::array{"contact_wheel", "rk4", "0.05", "suspension"},
        std::array{"quarter_car", "rk4", "0.05", "spin"}}) {
    const support::ProcessResult result = simulate_model(model, method, step);
    EXPECT_EQ(result.status, 1) << model << step;
    EXPECT_NE(result.output.find(std::string("throws '") + velocity), std::string::npos)
        << model << step << result.output;
    EXPECT_NE(result.output.find("is too long"), std::string::npos) << result.output;
  }
  EXPECT_EQ(simulate_model("block_on_slope", "linearly_implicit_euler", "0.001").status, 0);
}

constexpr const char* kSecondSlide =
    "[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"y\"\ntype = \"prismatic\"\nparent = \"world\"\n"
    "child = \"b\"\naxis = [1, 0, 0]\n";

/// A spring that is let go far from rest relaxes within the first step, at the velocity that this takes.
TEST(ThrownOff, IsNotSeenWhereStiffMotionsBegin) {
  for (const char* keys : {"stiffness = 1e6\ndamping = 1e4\n", "stiffness = 1e8\ndamping = 1\n"})
    for (const char* method : {"linearly_implicit_euler", "rodas4"}) {
      const support::ProcessResult result =
          PushedScene(pushed_slide("1", "0.1", keys, "0")).simulate(method, "0.01", "2");
      EXPECT_EQ(result.status, 0) << keys << method << result.output;
    }
}

/// A force that begins where a step ends is in that step for some methods, in the next one for shorter steps.
TEST(ThrownOff, IsNotSeenWhereForcesBegin) {
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
TEST(ThrownOff, IsNotSeenWhereOthersAreFast) {
  const std::string impact = pushed_slide("1", "-0.01099", "initial_velocity = 1\n", "-1e6*max(x - y, 0)") +
                             kSecondSlide + "[[force]]\njoint = \"y\"\nvalue = \"1e6*max(x - y, 0)\"\n";
  for (const char* method : {"heun", "rk4", "rk5", "rodas4"}) {
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
TEST(ThrownOff, IsNotSeenInRounding) {
  EXPECT_EQ(simulate_model("standing_quadruped", "linearly_implicit_euler", "0.05").status, 0);
}

/// What is stiff, or starts, changes much in a step, too.
TEST(BlowUp, IsNotSeenInStiffMotions) {
  for (const auto& [model, method, step] :
       {std::array{"elastic_arm", "rodas4", "0.01"}, std::array{"flyball_governor", "rodas4", "0.02"},
        std::array{"contact_wheel", "linearly_implicit_euler", "0.02"}}) {
    const support::ProcessResult result = simulate_model(model, method, step);
    EXPECT_EQ(result.status, 0) << model << result.output;
  }
}

}  // namespace
}  // namespace jourdain::tests
