// Bodies without mass inside loops.
#include "loops/plan/inertia.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "loops/closed_programs.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

/// A four-bar whose coupler has this mass (kg).
model::Mechanism four_bar(double coupler_mass) {
  std::string text = "[model]\nname = \"four_bar\"\ngravity = [0, -9.81, 0]\n";
  text += fmt::format("[[body]]\nname = \"coupler_bar\"\nmass = {}\ncenter_of_mass = [0.1, 0, 0]\n",
                      coupler_mass);
  text += R"(
[[body]]
name = "crank_bar"
mass = 1
center_of_mass = [0.05, 0, 0]
inertia = [0.01, 0.01, 0.01]
[[body]]
name = "rocker_bar"
mass = 1
center_of_mass = [0.1, 0, 0]
inertia = [0.02, 0.02, 0.02]
[[joint]]
name = "crank"
type = "revolute"
parent = "world"
child = "crank_bar"
initial_position = 1
initial_velocity = 3
[[joint]]
name = "coupler"
type = "revolute"
parent = "crank_bar"
child = "coupler_bar"
position = [0.12, 0, 0]
[[joint]]
name = "rocker"
type = "revolute"
parent = "world"
child = "rocker_bar"
position = [0.4, 0, 0]
initial_position = 1.6
[[frame]]
name = "coupler_end"
body = "coupler_bar"
position = [0.36, 0, 0]
[[frame]]
name = "rocker_end"
body = "rocker_bar"
position = [0.24, 0, 0]
[[loop]]
name = "pin"
type = "planar_pin"
from = "rocker_end"
to = "coupler_end"
[[output]]
name = "support"
kind = "reaction"
joint = "coupler"
)";
  support::Diagnostics diagnostics("text.toml", text);
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, {});
  EXPECT_TRUE(mechanism) << diagnostics.format();
  return mechanism.value_or(model::Mechanism());
}

double acceleration(const model::Mechanism& mechanism) {
  const ClosedPrograms programs(mechanism);
  EXPECT_TRUE(programs.plan().is_reduced());
  EXPECT_EQ(programs.layout().velocity_names[programs.plan().independent.at(0)], "crank");
  return programs.values("forward_dynamics", 0, programs.plan().y, {3}, {}).begin()->second;
}

TEST(LoopInertia, ABodyWithoutMassIsTheLimitOfALightOne) {
  const double light = acceleration(four_bar(1e-9)), none = acceleration(four_bar(0));
  EXPECT_NEAR(none, light, 1e-6 * std::abs(light));
}

TEST(LoopInertia, ModelsWithBodiesWithoutMassAreValidated) {
  const CompiledModel compiled = compile(four_bar(0), {});
  EXPECT_TRUE(compiled.verdict.accepted());
  EXPECT_EQ(compiled.verdict.condition, 1);
}

}  // namespace
}  // namespace jourdain::tests
