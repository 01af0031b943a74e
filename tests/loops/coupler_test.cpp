// Couplers: explicit elimination against multipliers, the descriptor form and equations by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/loop_functions.hpp"
#include "properties/consistent_state.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using VectorL = reference::VectorX<long double>;

// Two ways of solving in double; the scenes are conditioned well.
constexpr double kTolerance = 1e-12;

model::Mechanism scene(const std::string& name) {
  return read_model(fmt::format("{}/tests/loops/scenes/{}.toml", JOURDAIN_SOURCE_DIR, name));
}

model::Mechanism with_multipliers(model::Mechanism mechanism) {
  mechanism.loop_options = {};
  mechanism.loop_options.treatment = model::LoopTreatment::kMultipliers;
  return mechanism;
}

std::vector<std::string> independent(const ClosedPrograms& programs) {
  std::vector<std::string> names;
  for (const std::size_t k : programs.plan().independent)
    names.push_back(programs.layout().velocity_names[k]);
  return names;
}

VectorL of_independent(const VectorL& all, const ClosedPrograms& programs) {
  VectorL result(Eigen::Index(programs.plan().independent.size()));
  for (std::size_t k = 0; k < programs.plan().independent.size(); ++k)
    result[Eigen::Index(k)] = all[Eigen::Index(programs.plan().independent[k])];
  return result;
}

double relative(const VectorL& a, const VectorL& b) { return static_cast<double>((a - b).norm() / b.norm()); }

/// Accelerations and λ at states off the start, and the independent velocities that are left.
void expect_agreement(const std::string& name, const std::vector<std::string>& left) {
  SCOPED_TRACE(name);
  const model::Mechanism mechanism = scene(name);
  const ClosedPrograms programs(mechanism), kept(with_multipliers(mechanism));
  EXPECT_EQ(programs.plan().treatment, model::LoopTreatment::kExplicit);
  EXPECT_EQ(independent(programs), left);
  const auto states = consistent_states(mechanism, 3, 5);
  ASSERT_TRUE(states);
  const VectorL u = VectorL::LinSpaced(Eigen::Index(programs.layout().input_count()), -2, 3);
  for (const LoopState& state : *states) {
    const VectorL zdot = programs.accelerations(state, u), lambda = programs.multipliers(state, u);
    const VectorL all = kept.accelerations(state, u);
    EXPECT_LE(relative(zdot, of_independent(all, programs)), kTolerance);
    EXPECT_LE(relative(lambda, kept.multipliers(state, u)), kTolerance);
    const auto expected =
        reference::DescriptorReference<long double>(mechanism).solve(state.t, state.y, state.z, u);
    EXPECT_LE(relative(zdot, of_independent(expected.zdot, programs)), kTolerance);
    EXPECT_LE(relative(lambda, expected.loop_lambda), kTolerance);
  }
  fmt::print("{}: {} of {} velocities, forward dynamics {} operations, with multipliers {}\n", name,
             programs.plan().independent.size(), programs.layout().velocity_count(),
             programs.operations("forward_dynamics"), kept.operations("forward_dynamics"));
}

TEST(Couplers, FingersFollowTheirLeader) { expect_agreement("gripper", {"shoulder", "left"}); }
TEST(Couplers, DifferentialsShareTheirThreeCoordinates) {
  expect_agreement("bevel_differential", {"left", "housing"});
}
TEST(Couplers, StandBesideLoopsAndOnWhatTheseDetermine) { expect_agreement("geared_four_bar", {"crank"}); }

/// With a and b the accelerations of the shafts and (a + b)/2 that of the housing, and torques τ_l on the left shaft
/// and τ_h on the housing: λ pulls the shafts alike, I_l a = τ_l − λ, I_r b = −λ, I_h (a + b)/2 = τ_h + 2 λ.
TEST(Couplers, ADifferentialMovesAsItsThreeEquationsSay) {
  const ClosedPrograms programs(scene("bevel_differential"));
  LoopState state;
  state.y = VectorL::Zero(3);
  state.z = VectorL::Zero(3);
  VectorL u(2);
  u << 0.7L, 2.0L;
  const VectorL zdot = programs.accelerations(state, u);
  // Of both equations without λ: (I_l + I_h/4) a + I_h/4 b = τ_l + τ_h/2 and I_h/4 a + (I_r + I_h/4) b = τ_h/2.
  const long double p = 0.02L + 0.0125L, q = 0.0125L, r = 0.03L + 0.0125L, determinant = p * r - q * q;
  const long double a = (r * 1.7L - q * 1.0L) / determinant, b = (p * 1.0L - q * 1.7L) / determinant;
  ASSERT_EQ(independent(programs), (std::vector<std::string>{"left", "housing"}));
  EXPECT_NEAR(static_cast<double>(zdot[0]), static_cast<double>(a), 1e-12);
  EXPECT_NEAR(static_cast<double>(zdot[1]), static_cast<double>((a + b) / 2), 1e-12);
  EXPECT_NEAR(static_cast<double>(programs.multipliers(state, u)[0]), static_cast<double>(-0.03L * b), 1e-12);
}

/// What a joint transmits about its axis is all that accelerates its body: I_r b of the right shaft, τ_l − λ of the
/// left.
TEST(Couplers, AreInWhatJointsTransmit) {
  model::Mechanism mechanism = scene("bevel_differential");
  for (const std::size_t joint : {0, 1}) {
    model::Output output;
    output.name = joint == 0 ? "of_left" : "of_right";
    output.kind = model::OutputKind::kReaction;
    output.joint = model::JointIndex(joint);
    mechanism.outputs.push_back(output);
  }
  for (const model::Mechanism& treated : {mechanism, with_multipliers(mechanism)}) {
    const LoopFunctions functions(treated);
    const std::vector<double> z(functions.plan().is_reduced() ? 2 : 3, 0.0);
    // Force and moment of the left joint, then of the right one.
    const std::vector<double> values = functions("outputs", {0, 0, 0}, z, {}, {0.7, 2.0});
    // As in the test above.
    const double p = 0.02 + 0.0125, q = 0.0125, r = 0.03 + 0.0125, determinant = p * r - q * q;
    const double a = (r * 1.7 - q * 1.0) / determinant, b = (p * 1.0 - q * 1.7) / determinant;
    EXPECT_NEAR(values.at(3), 0.02 * a, 1e-12);
    EXPECT_NEAR(values.at(9), 0.03 * b, 1e-12);
    EXPECT_NEAR(values.at(2), 9.81, 1e-12);
  }
}

/// The finger starts at its offset; what terms hold together is assembled.
TEST(Couplers, StartWhereTheFollowerFollowsTo) {
  const ClosedPrograms programs(scene("gripper"));
  const auto& y = programs.plan().y;
  EXPECT_NEAR(y[1] + y[2], 0.003, 1e-15);
  EXPECT_NEAR(y[3] * 0.012, y[1], 1e-15);
}

}  // namespace
}  // namespace jourdain::tests
