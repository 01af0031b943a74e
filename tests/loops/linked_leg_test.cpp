// A leg as robots have it: a free root, a rod on a ball joint and a crank that close two loops in space, armatures,
// springs and dampers, read from MJCF.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/compiled_swing.hpp"
#include "properties/consistent_state.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using Vector = reference::VectorX<long double>;

model::Mechanism leg(bool damping) {
  return read_model(data_path("mjcf/linked_leg.xml"), {.damping = damping});
}

TEST(LinkedLeg, AcceleratesAsTheDescriptorFormSays) {
  constexpr double kSame = 1e-9;  // of the accelerations' norm, by multipliers in double
  const model::Mechanism mechanism = leg(true);
  const ClosedPrograms programs(mechanism);
  const reference::DescriptorReference<long double> descriptor(mechanism);
  const auto states = consistent_states(mechanism, 1, 20);
  ASSERT_TRUE(states);
  double worst = 0;
  for (const LoopState& state : *states) {
    const Vector u = Vector::LinSpaced(Eigen::Index(programs.layout().input_count()), -2, 3);
    const auto expected = descriptor.solve(state.t, state.y, state.z, u);
    ASSERT_EQ(expected.loop_rank, 6);
    const Vector zdot = programs.accelerations(state, u);
    ASSERT_EQ(zdot.size(), expected.zdot.size());
    worst = larger_error(worst, double((zdot - expected.zdot).norm() / expected.zdot.norm()));
  }
  fmt::print("accelerations at {} states: {:.1e}\n", states->size(), worst);
  EXPECT_LE(worst, kSame);
}

/// A second of steps from a closed state, its rates of order 1.
struct Fall {
  double drift = 0;    ///< largest change of the energy, J
  double gained = 0;   ///< energy at the end less that at the start, J
  double kinetic = 0;  ///< largest, J
  double opening = 0;  ///< largest, m
};

Fall fall(const model::Mechanism& mechanism, const CompiledModel& compiled, double h) {
  const CompiledSwing swing(mechanism, compiled);
  const LoopState from = consistent_states(mechanism, 2, 2).value().back();
  SwingState state = swing.start();
  std::copy(from.y.begin(), from.y.end(), state.y.begin());
  std::copy(from.z.begin(), from.z.end(), state.z.begin());
  const double at_start = swing.energy(state);
  Fall result;
  for (int i = 0, count = int(std::lround(1 / h)); i < count; ++i) {
    swing.step(state, h);
    result.gained = swing.energy(state) - at_start;
    result.drift = larger_error(result.drift, std::fabs(result.gained));
    result.kinetic = larger_error(result.kinetic, swing.kinetic_energy(state));
    result.opening = larger_error(result.opening, swing.opening(state));
  }
  return result;
}

TEST(LinkedLeg, KeepsItsEnergyWithoutDampers) {
  const model::Mechanism mechanism = leg(false);
  const auto compiled = compiled_or_refused(mechanism);
  ASSERT_TRUE(std::holds_alternative<CompiledLinkage>(compiled)) << std::get<std::string>(compiled);
  const CompiledModel& model = std::get<CompiledLinkage>(compiled).model;
  const Fall coarse = fall(mechanism, model, 1e-3), fine = fall(mechanism, model, 5e-4);
  fmt::print("of {:.0f} J: {:.1e} J at 1 ms, {:.1e} J at 0.5 ms; loops open by {:.1e} m\n", coarse.kinetic,
             coarse.drift, fine.drift, coarse.opening);
  constexpr double kDrift = 1e-6;  // J, of some 500; at this step it is 5e-8
  EXPECT_LE(coarse.drift, kDrift);
  EXPECT_LE(fine.drift, coarse.drift / 8);  // fourth order or better
  EXPECT_LE(coarse.opening, 1e-9);
}

TEST(LinkedLeg, LosesEnergyWithDampers) {
  const model::Mechanism mechanism = leg(true);
  const auto compiled = compiled_or_refused(mechanism);
  ASSERT_TRUE(std::holds_alternative<CompiledLinkage>(compiled)) << std::get<std::string>(compiled);
  EXPECT_LT(fall(mechanism, std::get<CompiledLinkage>(compiled).model, 1e-3).gained, -0.1);
}

}  // namespace
}  // namespace jourdain::tests
