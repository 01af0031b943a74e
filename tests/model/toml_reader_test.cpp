#include <gtest/gtest.h>

#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

struct Result {
  std::optional<Mechanism> mechanism;
  std::string messages;
};

Result read(const std::string& text, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("model.toml", text);
  auto mechanism = read_mechanism(diagnostics, options);
  return {std::move(mechanism), diagnostics.format()};
}

/// A mechanism whose file must be without any message.
Mechanism read_cleanly(const std::string& text, const ReadOptions& options = {}) {
  Result result = read(text, options);
  EXPECT_EQ(result.messages, "");
  return result.mechanism.value_or(Mechanism());
}

double value(const Mechanism& mechanism, const Expression& expression) {
  std::vector<double> values;
  for (const Parameter& parameter : mechanism.parameters) values.push_back(parameter.value);
  return expression.evaluate<double>(values);
}

std::string hinge(const std::string& child, const std::string& parent = "world") {
  return "[[joint]]\nname = \"to_" + child + "\"\ntype = \"revolute\"\nparent = \"" + parent +
         "\"\nchild = \"" + child + "\"\n";
}

const std::string kPendulum = R"([model]
name = "pendulum"
description = "a point mass on a massless rod"
source = "textbook"
gravity = [0, 0, -9.80665]

[parameters]
m = 2.0
l = { value = "1/4", unit = "m", description = "length" }
a = 3

[[body]]
name = "bob"
mass = "m"
center_of_mass = [0, 0, "-l"]
inertia = { xx = "m*l^2/12", yy = 0.5, zz = 0.5, xy = 0.01 }
inertia_at = "origin"
inertia_rpy = [0, "30*deg", 0]
inertia_kind = "lumped"

[[joint]]
name = "hinge"
type = "revolute"
parent = "world"
child = "bob"
position = [1, "2*l", 3]
rpy = ["90*deg", 0, 0]
axis = ["sqrt(2)/2", 0, 1]
stiffness = 5
rest = 0.1
damping = 0.2
initial_position = 0.3
initial_velocity = 0.4

[[actuator]]
joint = "hinge"
name = "motor"
)";

TEST(ReadToml, TakesModelAndParametersInOrder) {
  const Mechanism m = read_cleanly(kPendulum);
  EXPECT_EQ(m.name, "pendulum");
  EXPECT_EQ(m.description, "a point mass on a massless rod");
  EXPECT_EQ(m.source, "textbook");
  EXPECT_EQ(m.gravity[2].constant(), -9.80665);
  ASSERT_EQ(m.parameters.size(), 3u);
  EXPECT_EQ(m.parameters[0].name, "m");
  EXPECT_EQ(m.parameters[1].name, "l");
  EXPECT_EQ(m.parameters[1].value, 0.25);
  EXPECT_EQ(m.parameters[1].unit, "m");
  EXPECT_EQ(m.parameters[1].description, "length");
  EXPECT_EQ(m.parameters[2].name, "a");
  EXPECT_EQ(m.parameters[2].where.line, 10);
  EXPECT_TRUE(m.snap);
}

TEST(ReadToml, TakesABody) {
  const Mechanism m = read_cleanly(kPendulum);
  ASSERT_EQ(m.bodies.size(), 1u);
  const Body& bob = m.bodies[0];
  EXPECT_EQ(bob.name, "bob");
  EXPECT_EQ(bob.where.line, 13);
  EXPECT_FALSE(bob.mass.is_constant());
  EXPECT_EQ(value(m, bob.mass), 2);
  EXPECT_EQ(value(m, bob.center_of_mass[2]), -0.25);
  EXPECT_EQ(value(m, bob.inertia.xx), 2 * 0.0625 / 12);
  EXPECT_EQ(bob.inertia.xy.constant(), 0.01);
  EXPECT_TRUE(bob.inertia.xz.is_zero());
  EXPECT_EQ(bob.inertia_point, InertiaPoint::kOrigin);
  EXPECT_DOUBLE_EQ(bob.inertia_axes.rpy[1].constant(), 0.52359877559829882);
  EXPECT_TRUE(bob.lumped);
}

TEST(ReadToml, TakesAJointAndItsActuator) {
  const Mechanism m = read_cleanly(kPendulum);
  ASSERT_EQ(m.joints.size(), 1u);
  const Joint& hinge = m.joints[0];
  EXPECT_EQ(hinge.name, "hinge");
  EXPECT_EQ(hinge.type, JointType::kRevolute);
  EXPECT_FALSE(hinge.parent.has_value());
  EXPECT_EQ(hinge.child, BodyIndex(0));
  EXPECT_EQ(value(m, hinge.placement.position[1]), 0.5);
  EXPECT_DOUBLE_EQ(hinge.placement.rotation.rpy[0].constant(), 1.5707963267948966);
  EXPECT_DOUBLE_EQ(hinge.axis[0], 0.70710678118654752);
  EXPECT_EQ(hinge.coordinates[0].stiffness.constant(), 5);
  EXPECT_EQ(hinge.coordinates[0].rest.constant(), 0.1);
  EXPECT_EQ(hinge.coordinates[0].damping.constant(), 0.2);
  EXPECT_EQ(hinge.coordinates[0].initial_position.constant(), 0.3);
  EXPECT_EQ(hinge.coordinates[0].initial_velocity.constant(), 0.4);
  ASSERT_EQ(m.actuators.size(), 1u);
  EXPECT_EQ(m.actuators[0].name, "motor");
  EXPECT_EQ(m.actuators[0].joint, JointIndex(0));
}

TEST(ReadToml, HasDefaults) {
  const Mechanism m = read_cleanly("[model]\nname = \"m\"\n[[body]]\nname = \"b\"\nmass = 1\n" + hinge("b") +
                                   "[[actuator]]\njoint = \"to_b\"\n");
  EXPECT_TRUE(m.gravity[0].is_zero());
  EXPECT_EQ(m.gravity[2].constant(), -9.81);
  EXPECT_TRUE(m.bodies[0].inertia.xx.is_zero());
  EXPECT_EQ(m.bodies[0].inertia_point, InertiaPoint::kCenterOfMass);
  EXPECT_FALSE(m.bodies[0].lumped);
  EXPECT_EQ(m.joints[0].axis, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(m.actuators[0].name, "to_b");
}

TEST(ReadToml, AllowsAnyOrderOfBodiesAndJoints) {
  const Mechanism m = read_cleanly(hinge("tip", "base") + hinge("base") +
                                   "[[body]]\nname = \"tip\"\nmass = 1\n[[body]]\nname = \"base\"\nmass = 1\n"
                                   "[model]\nname = \"m\"\n");
  const auto order = moving_joints(m);
  ASSERT_EQ(order.size(), 2u);
  EXPECT_EQ(m.joints[order[0].value].name, "to_base");
  EXPECT_EQ(m.joints[order[1].value].name, "to_tip");
}

TEST(ReadToml, ComputesInertiaFromShapes) {
  const auto body_with = [](const std::string& lines) {
    return read_cleanly("[model]\nname = \"m\"\n[parameters]\nr = 2\n[[body]]\nname = \"b\"\n" + lines +
                        hinge("b"));
  };
  const Mechanism box = body_with("mass = 12\nshape = { kind = \"box\", size = [1, 2, 3] }\n");
  EXPECT_EQ(value(box, box.bodies[0].inertia.xx), 13);
  EXPECT_EQ(value(box, box.bodies[0].inertia.zz), 5);
  const Mechanism ball = body_with("shape = { kind = \"sphere\", radius = \"r\", density = 3 }\n");
  EXPECT_DOUBLE_EQ(value(ball, ball.bodies[0].mass), 32 * 3.141592653589793);
  EXPECT_DOUBLE_EQ(value(ball, ball.bodies[0].inertia.yy), 0.4 * 32 * 3.141592653589793 * 4);
  const Mechanism tube =
      body_with("mass = 12\nshape = { kind = \"cylinder\", radius = 2, length = 3, axis = \"x\" }\n");
  EXPECT_EQ(value(tube, tube.bodies[0].inertia.xx), 24);
  EXPECT_EQ(value(tube, tube.bodies[0].inertia.yy), 21);
  const Mechanism rod = body_with("mass = 12\nshape = { kind = \"rod\", length = 2 }\n");
  EXPECT_EQ(value(rod, rod.bodies[0].inertia.xx), 4);
  EXPECT_TRUE(rod.bodies[0].inertia.zz.is_zero());
}

TEST(ReadToml, LocksJoints) {
  const std::string bodies =
      "[model]\nname = \"m\"\n[[body]]\nname = \"a\"\nmass = 1\n[[body]]\nname = \"b\"\nmass = 1\n";
  const Mechanism m =
      read_cleanly(bodies + hinge("a") + hinge("b", "a") + "stiffness = 4\n[[actuator]]\njoint = \"to_b\"\n",
                   {.locked_joints = {"to_b"}});
  EXPECT_EQ(m.joints[1].type, JointType::kFixed);
  EXPECT_TRUE(m.joints[1].coordinates.empty());
  EXPECT_TRUE(m.actuators.empty());
  EXPECT_EQ(moving_joints(m).size(), 1u);
}

TEST(ReadToml, TakesByteOrderMarkAndWindowsLineEnds) {
  const Mechanism m = read_cleanly(
      "\xef\xbb\xbf[model]\r\nname = \"m\"\r\n[[body]]\r\nname = \"b\"\r\nmass = 1\r\n" + hinge("b"));
  EXPECT_EQ(m.name, "m");
}

TEST(ReadToml, BoundsTheNumberOfBodies) {
  std::string text = "[model]\nname = \"m\"\n";
  for (int i = 0; i < 1001; ++i) text += "[[body]]\nmass = 1\n";
  const Result result = read(text);
  EXPECT_FALSE(result.mechanism.has_value());
  EXPECT_EQ(result.messages,
            "model.toml:3:1: error: the file has 1001 [[body]] tables, more than 1000\n    3 | [[body]]\n    "
            "  | ^~~~~~~~\n");
}

}  // namespace
}  // namespace jourdain::model
