// Scenes that need almost nothing, and what is left of their code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/compiled_batch.hpp"
#include "compile/compile.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

model::Mechanism read_text(const std::string& text) {
  support::Diagnostics diagnostics("scene.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics);
  if (!mechanism) throw std::runtime_error(diagnostics.format());
  return *mechanism;
}

const ir::Program& function(const CompiledModel& compiled, const std::string& name) {
  for (const ir::Program& program : compiled.module.functions)
    if (program.name == name) return program;
  throw std::runtime_error("no " + name);
}

bool leaves_out(const CompiledModel& compiled, const std::string& name) {
  for (const Omission& omission : compiled.omissions)
    if (omission.name == name) return true;
  return false;
}

/// A rotor about y with its centre of mass off the axis, driven.
constexpr const char* kDrivenRotor = R"toml([model]
name = "rotor"
[[body]]
name = "disc"
mass = 2
center_of_mass = [0.1, 0, 0]
inertia = [1, 1, 1.5]
[[joint]]
name = "spin"
type = "revolute"
parent = "world"
child = "disc"
axis = [0, 1, 0]
motion = "10*t + 0.1*sin(3*t)"
[[output]]
name = "torque"
kind = "drive"
joint = "spin"
[[output]]
name = "disc_pose"
kind = "pose"
frame = "disc"
)toml";

TEST(SpecialScenes, ASceneThatIsPrescribedThroughoutHasItsOutputs) {
  const Derived derived = derive(read_text(kDrivenRotor));
  ASSERT_TRUE(derived.equations.zdot.empty());
  for (const std::string compiler : {"g++", "clang++"}) {
    ASSERT_TRUE(have_compiler(compiler)) << "no " << compiler;
    const CompiledBatch batch({emit_model(derived, "rotor")}, compiler, "double", {"-O1"});
    Sample sample;
    sample.t = 0.7;
    const Evaluation e = batch.evaluate(0, sample);
    const double angle = 7 + 0.1 * std::sin(2.1), acceleration = -0.9 * std::sin(2.1);
    const double rate = 10 + 0.3 * std::cos(2.1);
    // (I_yy + m c²) θ'' less the moment of the weight: the centre is at c (cos θ, 0, −sin θ).
    EXPECT_NEAR(e.outputs.at(0), 1.02 * acceleration - 2 * 9.81 * 0.1 * std::cos(angle), 1e-12);
    EXPECT_NEAR(e.outputs.at(4), std::cos(angle), 1e-15);
    EXPECT_NEAR(e.kinetic, 1.02 * rate * rate / 2, 1e-12);
    EXPECT_NEAR(e.potential, -2 * 9.81 * 0.1 * std::sin(angle), 1e-13);
  }
}

TEST(SpecialScenes, ALoneFreeBodyIsNewtonsAndEulersEquations) {
  const CompiledModel compiled = compile(read_text(R"toml([model]
name = "body"
gravity = [0, 0, 0]
[[body]]
name = "stone"
mass = 2
inertia = [1, 2, 3]
[[joint]]
name = "root"
type = "free"
parent = "world"
child = "stone"
[[input]]
name = "push"
[[input]]
name = "twist"
[[force]]
frame = "stone"
axes = "world"
force = ["push", 0, 0]
[[force]]
frame = "stone"
moment = [0, "twist", 0]
)toml"),
                                         {});
  ASSERT_TRUE(compiled.verdict.accepted());
  // v' = f/m: turned into the body and back, because a load is a wrench on the body.
  ir::LeafValues<double> leaves;
  leaves[ir::LeafKind::kPosition] = {0, 0, 0, 0.5, 0.5, -0.5, 0.5};
  leaves[ir::LeafKind::kVelocity] = {0, 0, 0, 0.3, -0.7, 1.1};
  leaves[ir::LeafKind::kInput] = {4, 6};
  const std::vector<double> zdot = ir::interpret(function(compiled, "forward_dynamics"), leaves);
  EXPECT_NEAR(zdot[0], 2, 1e-15);
  EXPECT_NEAR(zdot[3], (2 - 3) * -0.7 * 1.1 / 1, 1e-15);
  EXPECT_NEAR(zdot[4], ((3 - 1) * 1.1 * 0.3 + 6) / 2, 1e-15);
  EXPECT_NEAR(zdot[5], (1 - 2) * 0.3 * -0.7 / 3, 1e-15);
  EXPECT_TRUE(leaves_out(compiled, "coupling"));
}

TEST(SpecialScenes, ATorqueFreeBodyTakesOneProductForEachComponent) {
  const CompiledModel compiled = compile(read_text(R"toml([model]
name = "body"
gravity = [0, 0, 0]
[[body]]
name = "stone"
mass = 2
inertia = [1, 2, 3]
[[joint]]
name = "root"
type = "free"
parent = "world"
child = "stone"
)toml"),
                                         {});
  // ω_y ω_z, ω_z ω_x, ω_x ω_y and the factor (1 − 2)/3 of the last; the others are ∓1.
  EXPECT_EQ(ir::count_operations(function(compiled, "forward_dynamics")).arithmetic(), 4u);
  EXPECT_EQ(ir::count_operations(function(compiled, "mass_matrix")).arithmetic(), 0u);
}

TEST(SpecialScenes, MassesAndSpringsNeedNoTrigonometryAndNoFactorisation) {
  const CompiledModel compiled = compile(read_text(R"toml([model]
name = "masses"
gravity = [0, 0, 0]
[[body]]
name = "a"
mass = 2
[[body]]
name = "b"
mass = 3
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "a"
axis = [1, 0, 0]
stiffness = 10
[[joint]]
name = "w"
type = "prismatic"
parent = "a"
child = "b"
axis = [1, 0, 0]
stiffness = 20
damping = 0.5
)toml"),
                                         {});
  ASSERT_TRUE(compiled.verdict.accepted());
  for (const ir::Program& program : compiled.module.functions) {
    const ir::Operations count = ir::count_operations(program);
    EXPECT_EQ(count.sin + count.cos + count.divide + count.sqrt, 0u) << program.name;
  }
  EXPECT_TRUE(leaves_out(compiled, "factorisation"));
  EXPECT_LE(ir::count_operations(function(compiled, "forward_dynamics")).arithmetic(), 8u);
}

TEST(SpecialScenes, ThePassiveEndOfASpringWithoutFreeLengthNeedsNoRoot) {
  const CompiledModel compiled = compile(read_text(R"toml([model]
name = "ball"
[[body]]
name = "stone"
mass = 2
[[joint]]
name = "x"
type = "prismatic"
parent = "world"
child = "stone"
axis = [1, 0, 0]
[[frame]]
name = "anchor"
body = "world"
position = [0, 1, 0]
[[spring]]
from = "anchor"
to = "stone"
stiffness = 30
)toml"),
                                         {});
  const ir::Operations count = ir::count_operations(function(compiled, "forward_dynamics"));
  EXPECT_EQ(count.sqrt + count.divide, 0u);
  EXPECT_EQ(count.arithmetic(), 1u);
}

}  // namespace
}  // namespace jourdain::tests
