// A gimbal in both references: three hinges with nothing between them; the motion of a ball joint in other coordinates.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "properties/gimbals.hpp"
#include "reference/descriptor.hpp"
#include "reference/minimal.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = VectorX<Long>;

constexpr double kRounding = 1e-15;

/// A heavy top about a fixed point.
model::Mechanism top(const tests::Sequence& sequence) {
  model::Mechanism mechanism;
  mechanism.gravity = {0.3, -0.5, -9.81};
  model::Body body;
  body.name = "top";
  body.mass = 2.0;
  body.center_of_mass = {0.1, -0.2, 0.7};
  body.inertia = {0.4, 0.5, 0.3, 0.02, -0.03, 0.01};
  mechanism.bodies = {body};
  model::Joint joint;
  joint.name = "gimbal";
  joint.set_type(model::JointType::kGimbal);
  joint.child = model::BodyIndex(0);
  joint.placement = {{0.2, 0.1, -0.3}, {.rpy = {0.4, -0.7, 1.1}}};
  joint.sequence = sequence;
  mechanism.joints = {joint};
  return mechanism;
}

/// With middle angles on both sides of where the outer axes line up.
std::vector<State<Long>> states() {
  std::vector<State<Long>> list;
  for (const Long middle : {0.6L, -0.8L, 2.2L, -2.5L, 7.1L}) {
    State<Long> state;
    state.t = 0;
    state.y = VectorL(3);
    state.y << 0.9L, middle, -4.2L;
    state.z = VectorL(3);
    state.z << 1.3L, -0.7L, 2.1L;
    list.push_back(state);
  }
  return list;
}

Long distance(const auto& a, const auto& b) { return (a - b).norm() / (1 + b.norm()); }

TEST(Gimbal, IsThreeHingesWithNothingBetween) {
  for (const tests::Sequence& sequence : tests::all_sequences()) {
    model::Mechanism gimbal = top(sequence);
    for (std::size_t k = 0; k < 3; ++k) {
      gimbal.joints[0].coordinates[k].stiffness = 3.0 + double(k);
      gimbal.joints[0].coordinates[k].damping = 0.5 - 0.1 * double(k);
    }
    const Reference<Long> own(gimbal), hinges(tests::on_hinges(gimbal));
    for (const State<Long>& state : states()) {
      const Terms<Long> a = own.evaluate(state, VectorL(0)), b = hinges.evaluate(state, VectorL(0));
      EXPECT_LE(distance(a.M, b.M), kRounding);
      EXPECT_LE(distance(a.k_bar, b.k_bar), kRounding);
      EXPECT_LE(distance(a.q_bar, b.q_bar), kRounding);
      const VectorL zdot = DescriptorReference<Long>(gimbal).solve(0, state.y, state.z, VectorL(0)).zdot;
      EXPECT_LE(distance(zdot, forward_dynamics(b)), 100 * kRounding);
    }
  }
}

TEST(Gimbal, MovesATopAsABallJointDoes) {
  for (const tests::Sequence& sequence : tests::all_sequences()) {
    const model::Mechanism gimbal = top(sequence), ball = tests::on_ball(gimbal);
    const Reference<Long> own(gimbal), other(ball);
    const DescriptorReference<Long> absolute(gimbal);
    for (const State<Long>& state : states()) {
      const BodyMotion<Long> motion = own.motion(state)[0];
      const Matrix3<Long> R_WJ =
          rotation_value(gimbal.joints[0].placement.rotation, std::span<const Long>(), gimbal.snap);
      const Eigen::Quaternion<Long> turned(Matrix3<Long>(R_WJ.transpose() * motion.R_WB));
      State<Long> same;
      same.t = 0;
      same.y = VectorL(4);
      same.y << turned.w(), turned.x(), turned.y(), turned.z();
      same.z = motion.omega;
      const VectorL omega_dot = forward_dynamics(other.evaluate(same, VectorL(0)));
      const VectorL zdot = forward_dynamics(own.evaluate(state, VectorL(0)));
      EXPECT_LE(distance(VectorL(motion.J_r * zdot + motion.zeta_bar), omega_dot), 100 * kRounding);
      const auto solution = absolute.solve(0, state.y, state.z, VectorL(0));
      EXPECT_LE(distance(VectorL(solution.bodies[0].omega_dot), omega_dot), 100 * kRounding);
    }
  }
}

}  // namespace
}  // namespace jourdain::reference
