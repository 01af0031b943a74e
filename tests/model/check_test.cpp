#include <gtest/gtest.h>

#include "model/check/checks.hpp"
#include "model/read/read.hpp"

namespace jourdain::model {
namespace {

/// A chain of `bodies`; the first hangs on a revolute joint, the others are fixed to their predecessor at
/// `offset`.
Mechanism welded(std::vector<Body> bodies, const Vector3& offset = {}) {
  Mechanism mechanism;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Joint joint;
    joint.name = "j" + std::to_string(i);
    joint.set_type(i == 0 ? JointType::kRevolute : JointType::kFixed);
    if (i > 0) {
      joint.parent = BodyIndex(i - 1);
      joint.placement.position = offset;
    }
    joint.child = BodyIndex(i);
    bodies[i].name = "b" + std::to_string(i);
    mechanism.joints.push_back(joint);
  }
  mechanism.bodies = std::move(bodies);
  return mechanism;
}

Body body(double mass, double xx, double yy, double zz) {
  Body result;
  result.mass = mass;
  result.inertia = {xx, yy, zz, 0.0, 0.0, 0.0};
  return result;
}

std::string messages(const Mechanism& mechanism, support::Severity triangle = support::Severity::kError) {
  support::Diagnostics diagnostics("f", "");
  check_mechanism(mechanism, diagnostics, triangle);
  return diagnostics.format();
}

TEST(CheckMechanism, AllowsPointMassesThinRodsAndMasslessBodies) {
  EXPECT_EQ(messages(welded({body(1, 0, 0, 0)})), "");
  EXPECT_EQ(messages(welded({body(1, 0.3, 0.3, 0)})), "");
  EXPECT_EQ(messages(welded({body(0, 0, 0, 0)})), "");
  EXPECT_EQ(messages(welded({body(1, 1, 1, 2)})), "");
  Body frame = body(0, 0, 0, 0);
  frame.center_of_mass = {1.0, 2.0, 3.0};
  EXPECT_EQ(messages(welded({frame})), "");
}

TEST(CheckMechanism, AllowsAPointMassGivenAboutTheOrigin) {
  Body bob = body(3, 3 * 0.49, 3 * 0.49, 0);
  bob.center_of_mass = {0.0, 0.0, 0.7};
  bob.inertia_point = InertiaPoint::kOrigin;
  EXPECT_EQ(messages(welded({bob})), "");
}

TEST(CheckMechanism, MovesToTheCentreOfMassBeforeJudging) {
  Body bob = body(3, 1, 1, 1);
  bob.center_of_mass = {0.0, 0.0, 0.7};
  EXPECT_EQ(messages(welded({bob})), "");
  bob.inertia_point = InertiaPoint::kOrigin;
  EXPECT_NE(messages(welded({bob})).find("indefinite"), std::string::npos);
}

TEST(CheckMechanism, JudgesTheTriangleAfterMerging) {
  const Body odd = body(1, 1, 1, 3);
  EXPECT_NE(messages(welded({odd})).find("error: no rigid body has the inertia of 'b0'"), std::string::npos);
  EXPECT_NE(messages(welded({odd}), support::Severity::kWarning).find("warning: no rigid body"),
            std::string::npos);
  EXPECT_EQ(messages(welded({odd, body(1, 1, 1, 0)})), "");
  EXPECT_NE(messages(welded({odd, body(1, 0, 0, 0)})), "");
  EXPECT_EQ(messages(welded({odd, body(2, 0, 0, 0)}, {0.0, 0.0, 2.0})), "");
}

TEST(CheckMechanism, ForgivesRoundedMomentsWithAWarning) {
  EXPECT_NE(messages(welded({body(1, 1, 1, 2.01)})).find("warning: no rigid body"), std::string::npos);
  EXPECT_NE(messages(welded({body(1, 1, 1, 2.03)})).find("error: no rigid body"), std::string::npos);
}

TEST(CheckMechanism, JudgesIndefiniteInertiasAfterMergingWhereAJointMovesThem) {
  const Body antenna = body(0.01, -1e-8, 2e-8, 3e-8), base = body(10, 1, 1, 1);
  EXPECT_NE(messages(welded({antenna})).find("error: inertia of body 'b0'"), std::string::npos);
  EXPECT_NE(messages(welded({antenna, body(0, 0, 0, 0)})).find("error: inertia of body 'b0'"),
            std::string::npos);
  const std::string merged = messages(welded({base, antenna}));
  EXPECT_NE(merged.find("warning: inertia of body 'b1'"), std::string::npos);
  EXPECT_EQ(merged.find("error"), std::string::npos);
  Mechanism fixed = welded({antenna, base});
  fixed.joints[0].set_type(JointType::kFixed);
  fixed.joints[1].set_type(JointType::kRevolute);
  const std::string at_rest = messages(fixed);
  EXPECT_NE(at_rest.find("no joint moves it"), std::string::npos);
  EXPECT_EQ(at_rest.find("error"), std::string::npos);
}

TEST(CheckMechanism, TurnsInertiasWhenMerging) {
  Mechanism mechanism = welded({body(1, 1, 1, 3), body(1, 0, 1, 1)});
  EXPECT_NE(messages(mechanism), "");
  mechanism.joints[1].placement.rotation.rpy[1] = 1.5707963267948966;
  EXPECT_EQ(messages(mechanism), "");
}

TEST(CheckMechanism, AcceptsPublishedLumpedParameters) {
  // Puma 560, links 1 and 3: inertia about the link origin (see the robot's published table).
  Body first = body(0, 0, 0.35, 0);
  Body third = body(4.8, 0.090474288, 0.111498032, 0.01543232);
  third.inertia.xy = -0.001373904;
  third.inertia.xz = 0.0068208;
  third.inertia.yz = 0.0047376;
  third.center_of_mass = {-0.0203, -0.0141, 0.07};
  for (Body* link : {&first, &third}) {
    link->lumped = true;
    link->inertia_point = InertiaPoint::kOrigin;
  }
  EXPECT_EQ(messages(welded({first})), "");
  EXPECT_EQ(messages(welded({third})), "");
  first.inertia.yy = -0.35;
  EXPECT_NE(messages(welded({first})).find("negative moment of inertia"), std::string::npos);
  third.mass = -1.0;
  EXPECT_NE(messages(welded({third})).find("is negative"), std::string::npos);
}

TEST(CheckMechanism, UsesParameterDefaults) {
  Mechanism mechanism = welded({body(1, 0, 0, 0)});
  mechanism.parameters = {{.name = "m", .value = -2, .unit = "", .description = ""}};
  mechanism.bodies[0].mass = Expression::parameter(ParameterIndex(0));
  EXPECT_NE(messages(mechanism).find("mass of body 'b0' is negative: -2 kg"), std::string::npos);
}

TEST(CheckMechanism, ReportsEachLoopOnce) {
  Mechanism mechanism = welded({body(1, 0, 0, 0), body(1, 0, 0, 0), body(1, 0, 0, 0)});
  mechanism.joints[0].parent = BodyIndex(1);
  EXPECT_EQ(
      messages(mechanism),
      "f: error: the joints form a loop: 'b0' -> 'b1' -> 'b0'\n      | one joint must lead to the world; the "
      "one that closes a loop is a [[loop]] of a TOML model\n");
}

TEST(DepthFirst, ListsParentsBeforeChildrenAndSiblingsAsDeclared) {
  Mechanism mechanism;
  mechanism.bodies.resize(5);
  const auto add = [&](std::optional<std::size_t> parent, std::size_t child, JointType type) {
    Joint joint;
    joint.set_type(type);
    if (parent) joint.parent = BodyIndex(*parent);
    joint.child = BodyIndex(child);
    mechanism.joints.push_back(joint);
  };
  add(1, 2, JointType::kRevolute);
  add({}, 1, JointType::kFixed);
  add(1, 3, JointType::kPrismatic);
  add({}, 0, JointType::kRevolute);
  add(2, 4, JointType::kRevolute);
  std::vector<std::size_t> order;
  for (const JointIndex joint : depth_first(mechanism)) order.push_back(joint.value);
  EXPECT_EQ(order, (std::vector<std::size_t>{1, 0, 4, 2, 3}));
  order.clear();
  for (const JointIndex joint : moving_joints(mechanism)) order.push_back(joint.value);
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 4, 2, 3}));
}

}  // namespace
}  // namespace jourdain::model
