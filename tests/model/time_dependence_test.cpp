#include "model/time_dependence.hpp"

#include <gtest/gtest.h>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

/// A driven slide and a free one side by side, and what is added.
Mechanism scene(const std::string& motion, const std::string& more) {
  const std::string text = R"toml(
[model]
name = "scene"
[parameters]
a = 1
[[body]]
name = "cart"
mass = 1
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "cart"
)toml" + motion + R"toml(
[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
[[frame]]
name = "on_cart"
body = "cart"
[[frame]]
name = "on_bob"
body = "bob"
position = [1, 0, 0]
)toml" + more;
  support::Diagnostics diagnostics("scene.toml", text);
  std::optional<Mechanism> mechanism = read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return mechanism.value_or(Mechanism());
}

TimeDependence time_of(const std::string& motion, const std::string& more = "") {
  return time_dependence(scene(motion, more));
}

std::string expression(const std::string& value) {
  return "[[output]]\nname = \"o\"\nkind = \"expression\"\nvalue = \"" + value + "\"\n";
}

std::string of_frame(const std::string& kind, const std::string& frame) {
  return "[[output]]\nname = \"o\"\nkind = \"" + kind + "\"\nframe = \"" + frame + "\"\n";
}

constexpr const char* kMotion = "motion = \"a*sin(t)\"\n";

TEST(TimeDependence, IsThatOfMotionsAndForces) {
  EXPECT_FALSE(time_of("").any());
  EXPECT_FALSE(time_of("motion = \"2*a\"\n").any());
  EXPECT_TRUE(time_of(kMotion).positions);
  EXPECT_TRUE(time_of(kMotion).dynamics);
  EXPECT_FALSE(time_of(kMotion).outputs);
  const TimeDependence pushed = time_of("", "[[force]]\njoint = \"hinge\"\nvalue = \"a*t\"\n");
  EXPECT_FALSE(pushed.positions);
  EXPECT_TRUE(pushed.dynamics);
}

TEST(TimeDependence, OfOutputsAloneLeavesTheDynamicsFree) {
  const TimeDependence time = time_of("", expression("t*hinge"));
  EXPECT_TRUE(time.outputs);
  EXPECT_FALSE(time.dynamics);
  EXPECT_FALSE(time_of("", expression("a*hinge")).outputs);
}

TEST(TimeDependence, OfOutputsFollowsWhatTheyAreMadeOf) {
  EXPECT_TRUE(time_of(kMotion, expression("slide + hinge")).outputs);
  EXPECT_TRUE(time_of(kMotion, expression("slide.rate")).outputs);
  EXPECT_FALSE(time_of(kMotion, expression("hinge")).outputs);
  EXPECT_TRUE(time_of(kMotion, expression("on_cart.x")).outputs);
  EXPECT_FALSE(time_of(kMotion, expression("on_bob.x")).outputs);
  for (const char* kind : {"pose", "velocity", "jacobian"}) {
    EXPECT_TRUE(time_of(kMotion, of_frame(kind, "on_cart")).outputs) << kind;
    EXPECT_FALSE(time_of(kMotion, of_frame(kind, "on_bob")).outputs) << kind;
  }
  EXPECT_TRUE(
      time_of("", "[[force]]\njoint = \"hinge\"\nvalue = \"t\"\n" + of_frame("acceleration", "on_bob"))
          .outputs);
  EXPECT_TRUE(time_of(kMotion, "[[output]]\nname = \"o\"\nkind = \"kinetic_energy\"\n").outputs);
}

/// Positions follow a state and not t; velocities follow its rate.
TEST(TimeDependence, OfMotionsThatFollowStatesIsThatOfTheirRates) {
  const auto led = [](const std::string& rate, const std::string& more) {
    return time_of("motion = \"p\"\n", "[[state]]\nname = \"p\"\nrate = \"" + rate + "\"\n" + more);
  };
  const std::string energy = "[[output]]\nname = \"o\"\nkind = \"kinetic_energy\"\n";
  for (const std::string& output : {expression("slide.rate"), of_frame("velocity", "on_cart"), energy}) {
    const TimeDependence moving = led("sin(t)", output), steady = led("2", output);
    EXPECT_TRUE(moving.outputs && moving.dynamics && moving.drift && !moving.positions) << output;
    EXPECT_TRUE(!steady.outputs && !steady.dynamics && steady.drift && !steady.positions) << output;
  }
  EXPECT_FALSE(led("sin(t)", of_frame("velocity", "on_bob")).outputs);
  const std::string bound = "[[constraint]]\nname = \"c\"\nvelocity = \"hinge.rate - 1\"\n";
  EXPECT_TRUE(led("sin(t)", bound + expression("hinge.rate")).outputs);
  EXPECT_FALSE(led("2", bound + expression("hinge.rate")).outputs);
}

}  // namespace
}  // namespace jourdain::model
