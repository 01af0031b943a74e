// Where mechanisms with closed loops start: what is given, what settings change, and what cannot be.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "commands/first_row.hpp"
#include "commands/run_jourdain.hpp"
#include "support/files.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::tests {
namespace {

/// Keys of the crank's, the coupler's and the rocker's joint.
struct FourBarStart {
  std::string crank, coupler, rocker;
};

/// A four-bar with the lengths of crank, coupler, rocker and base, m; without gravity.
std::string four_bar(const std::array<double, 4>& lengths, const FourBarStart& start,
                     const std::string& loops = "") {
  std::string text = "[model]\nname = \"four_bar\"\n[parameters]\nangle = 1\nspeed = 2\n";
  for (const char* body : {"crank_bar", "coupler_bar", "rocker_bar"})
    text += fmt::format("[[body]]\nname = \"{}\"\nmass = 1\ninertia = [0.01, 0.01, 0.01]\n", body);
  const auto joint = [&](const char* name, const char* parent, double at, const std::string& keys) {
    text += fmt::format(
        "[[joint]]\nname = \"{0}\"\ntype = \"revolute\"\nparent = \"{1}\"\nchild = \"{0}_bar\"\nposition = "
        "[{2}, 0, "
        "0]\n{3}\n",
        name, parent, at, keys);
  };
  joint("crank", "world", 0, start.crank);
  joint("coupler", "crank_bar", lengths[0], start.coupler);
  joint("rocker", "world", lengths[3], start.rocker);
  return text + fmt::format(
                    "[[frame]]\nname = \"coupler_end\"\nbody = \"coupler_bar\"\nposition = [{}, 0, "
                    "0]\n[[frame]]\nname "
                    "= \"rocker_end\"\nbody = \"rocker_bar\"\nposition = [{}, 0, 0]\n[[loop]]\nname = "
                    "\"pin\"\ntype = "
                    "\"planar_pin\"\nfrom = \"rocker_end\"\nto = \"coupler_end\"\n{}",
                    lengths[1], lengths[2], loops);
}

constexpr std::array<double, 4> kGrashof = {0.12, 0.36, 0.24, 0.4}, kParallelogram = {0.2, 0.4, 0.2, 0.4};
const std::string kMultipliers = "[loops]\ntreatment = \"multipliers\"\n";

class Scene {
 public:
  explicit Scene(const std::string& text) { support::write_file(path(), text); }

  std::string path() const { return folder_.path() + "/scene.toml"; }
  support::ProcessResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"simulate", path(), "--output", folder_.path() + "/run.csv"};
    words.insert(words.end(), more.begin(), more.end());
    return jourdain(words);
  }
  double start(const std::string& name) const { return at_start(rows(), name); }
  double last(const std::string& name) const {
    const std::string text = rows();
    return at_start(text.substr(0, text.find('\n') + 1) + text.substr(text.rfind('\n', text.size() - 2) + 1),
                    name);
  }

 private:
  std::string rows() const { return support::read_file(folder_.path() + "/run.csv"); }

  support::TemporaryFolder folder_;
};

/// With all bars on a line the rates of the rocker do not follow from those of the crank: there are two ways on, and
/// velocities of least change are those of neither.
TEST(LoopStarts, VelocitiesThatNoMotionHasAreRefusedAtDeadPoints) {
  for (const double size : {1e-5, 1.0, 1e3, 1e7}) {
    std::array<double, 4> lengths = kParallelogram;
    for (double& length : lengths) length *= size;
    const Scene refused(four_bar(lengths, {"initial_velocity = 2", "", ""}, size > 1 ? kMultipliers : ""));
    expect(refused.run({"--duration", "0.02", "--step", "1e-4"}), 1,
           "error: no motion starts with these velocities: loop 'pin' is at a dead point");
  }
  const Scene rest(four_bar(kParallelogram, {"", "", ""}, kMultipliers));
  expect(rest.run({"--duration", "0.02", "--step", "1e-4"}), 0, "loops open by ");
  const Scene moving(
      four_bar(kParallelogram, {"initial_velocity = 2", "", "initial_velocity = 2"}, kMultipliers));
  expect(moving.run({"--duration", "0.02", "--step", "1e-4"}), 0, "loops open by ");
  EXPECT_NEAR(moving.start("coupler_velocity"), -2, 1e-12);
  for (const char* independent : {"crank", "rocker"}) {
    const Scene named(
        four_bar(kParallelogram, {"", "", ""},
                 fmt::format("[loops]\ntreatment = \"partitioned\"\nindependent = [\"{}\"]\n", independent)));
    expect(jourdain({"check", named.path()}), 1, "error: the initial state is a dead position");
  }
}

/// At settings numbers yield to initial values that follow parameters, which stay; the way of closing, too.
TEST(LoopStarts, ValuesThatFollowParametersStayWhereTheseAreSet) {
  const Scene all(four_bar(kGrashof,
                           {"initial_position = \"angle\"\ninitial_velocity = \"speed\"",
                            "initial_position = -0.6035768613\ninitial_velocity = -2.396165736",
                            "initial_position = 1.583640202\ninitial_velocity = 0.6120693956"},
                           kMultipliers));
  expect(all.run({"--set", "speed=-1", "--duration", "1e-3"}), 0,
         "the loops close with coupler's velocity = ");
  EXPECT_NEAR(all.start("crank_velocity"), -1, 1e-12);
  EXPECT_NEAR(all.start("coupler_velocity"), 2.396165736 / 2, 1e-6);
  expect(all.run({"--set", "angle=1.5", "--duration", "1e-3"}), 0, "the loops close with coupler = -1.17498");
  EXPECT_NEAR(all.start("crank"), 1.5, 1e-12);
  EXPECT_NEAR(all.start("crank_velocity"), 2, 1e-12);
}

TEST(LoopStarts, SettingsKeepTheWayOfClosing) {
  // Left to the tool the coupler is independent, which is not given.
  for (const std::string& loops : {std::string(), kMultipliers}) {
    const Scene one(four_bar(kGrashof, {"initial_position = \"angle\"", "", ""}, loops));
    for (const double angle : {1.0, 1.3, 2.5, 3.5, 5.0, -0.5, -2.0}) {
      expect(one.run({"--set", fmt::format("angle={}", angle), "--duration", "1e-3"}), 0, "");
      EXPECT_NEAR(one.start("crank"), angle, 1e-12) << loops;
      EXPECT_LT(std::sin(one.start("rocker") - one.start("crank") - one.start("coupler")), -0.5) << angle;
    }
  }
}

/// What rounding leaves of an offset is no measure of the mechanism.
TEST(LoopStarts, OffsetsByRoundingAreNoSize) {
  for (const char* offset : {"0", "1e-17", "1e-12", "1e-9"}) {
    std::string text = "[model]\nname = \"slides\"\ngravity = [0, -9.81, 0]\n";
    for (const char* axis : {"[1, 0, 0]", "[0, 1, 0]"})
      text += fmt::format(
          "[[body]]\nname = \"body_{0}\"\nmass = 1\n[[joint]]\nname = \"joint_{0}\"\ntype = "
          "\"prismatic\"\nparent = \"world\"\nchild = \"body_{0}\"\naxis = {1}\ninitial_position = "
          "{2}\n[[frame]]\nname "
          "= \"frame_{0}\"\nbody = \"body_{0}\"\nposition = [0, 0, {3}]\n",
          axis[1], axis, axis[1] == '1' ? 0.3 : 0.35, axis[1] == '1' ? "0" : offset);
    const Scene scene(
        text +
        "[[loop]]\nname = \"rod\"\ntype = \"rod\"\nfrom = \"frame_1\"\nto = \"frame_0\"\nlength = 0.5\n");
    expect(jourdain({"check", scene.path()}), 0, "loops: 1 degree of freedom");
  }
}

/// Slides far from their body's origin, as in files in which all frames have one origin, hold all that they hold.
TEST(LoopStarts, FramesFarFromTheirBodyLoseNoConstraint) {
  for (const double lever : {1.0, 20.0, 30.0, 100.0, 1e4}) {
    const Scene scene(fmt::format(R"([model]
name = "guided"
gravity = [0, 0, -9.81]
[[body]]
name = "b"
mass = 1
center_of_mass = [{0}, {1}, 0]
inertia = [{2}, {3}, {4}]
[[joint]]
name = "f"
type = "free"
parent = "world"
child = "b"
[[frame]]
name = "e"
body = "b"
position = [{5}, 0, 0]
[[frame]]
name = "g"
body = "world"
position = [{5}, 0, 0]
[[loop]]
type = "prismatic"
from = "g"
to = "e"
axis = [0, 1, 0]
)",
                                  lever / 2, lever / 10, lever * lever / 10, lever * lever / 5,
                                  lever * lever / 4, -lever));
    expect(jourdain({"check", scene.path()}), 0,
           "loops: 1 degree of freedom: 6 coordinates of the tree, 5 of 5 ");
    expect(scene.run({"--duration", "0.1"}), 0, "energy ");  // at rest, but for rounding
    EXPECT_NEAR(scene.last("f_z"), 0, 1e-9 * lever);
  }
}

/// Angles with six digits: the rows that do not agree stay open by less than that, and the mechanism moves.
TEST(LoopStarts, OverconstrainedMechanismsOfRoundedNumbersRun) {
  const std::string base = "0.5847608800326175";
  std::string text = "[model]\nname = \"bennett\"\ngravity = [1, -3, -9]\n";
  for (const char* body : {"A", "B", "C"})
    text += fmt::format(
        "[[body]]\nname = \"{}\"\nmass = 1.4\ncenter_of_mass = [0.2, 0.01, 0.02]\ninertia = [0.01, 0.06, "
        "0.065]\n",
        body);
  text += R"([[joint]]
name = "t1"
type = "revolute"
parent = "world"
child = "A"
initial_position = 0.9
initial_velocity = 1
[[joint]]
name = "t2"
type = "revolute"
parent = "A"
child = "B"
position = [0.4, 0, 0]
rpy = [0.698132, 0, 0]
initial_position = 2.8386784344329685
[[joint]]
name = "t3"
type = "revolute"
parent = "B"
child = "C"
position = [)" +
          base + R"(, 0, 0]
rpy = [1.22173, 0, 0]
initial_position = -0.9
[[frame]]
name = "ce"
body = "C"
position = [0.4, 0, 0]
rpy = [0.698132, 0, 0]
[[frame]]
name = "gd"
body = "world"
position = [-)" +
          base + R"(, 0, 0]
rpy = [-1.22173, 0, 0]
[[loop]]
type = "revolute"
to = "ce"
from = "gd"
)";
  const Scene scene(text);
  const support::ProcessResult result = scene.run({"--duration", "1"});
  expect(result, 0, "they are left open, by up to ");
  expect(result, 0, "loops open by ");
  expect(jourdain({"cost", scene.path(), "--output", scene.path() + ".json"}), 0, "");
}

/// Shafts at an angle: the driven one moves up to five times as fast as the driving one, here and there.
TEST(LoopStarts, DrivenShaftsAtALargeAngleAreFollowedInTime) {
  for (const double angle : {0.8, 1.2, 1.4})
    for (const char* motion : {"0.3 + 7*t", "0.3 + 30*t", "-0.5 + 4*t"}) {
      const Scene scene(fmt::format(R"([model]
name = "shafts"
[[body]]
name = "s1"
mass = 1
inertia = [0.01, 0.01, 0.02]
[[body]]
name = "s2"
mass = 1
inertia = [0.01, 0.01, 0.02]
[[joint]]
name = "a"
type = "revolute"
parent = "world"
child = "s1"
motion = "{}"
[[joint]]
name = "b"
type = "revolute"
parent = "world"
child = "s2"
rpy = [{}, 0, 0]
[[loop]]
type = "universal"
from = "s1"
to = "s2"
axis = [1, 0, 0]
to_axis = [0, 1, 0]
)",
                                    motion, angle));
      expect(jourdain({"check", scene.path()}), 0, "ok: shafts");
    }
}

}  // namespace
}  // namespace jourdain::tests
