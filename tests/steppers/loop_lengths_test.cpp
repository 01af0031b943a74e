// A coupler whose length is set at run time, on both sides of where a bar begins to turn round: the emitted
// code is right there, or it says that it is not to be trusted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "agreement/shared_data.hpp"
#include "loops/compiled_swing.hpp"
#include "rocking_four_bar_all/rocking_four_bar_all_kernels.hpp"
#include "turning_four_bar/turning_four_bar_kernels.hpp"

namespace jourdain::tests {
namespace {

using Rocking = rocking_four_bar_all::Model<>;
using Turning = turning_four_bar::Model<>;

/// The change point: 0.5 + 1 m = 0.6 + 0.9 m.
constexpr double kChange = 0.9;

void close(const Rocking& model, Rocking::State& state) {
  for (int i = 0; i < 60; ++i) project(model, state);
}
void close(const Turning& model, Turning::State& state) {
  for (int i = 0; i < 60; ++i) close_loops(model, state);
}

/// Released at rest with that coupler.
template <class Model>
typename Model::State start(const Model& model) {
  typename Model::State state = initial_state(model);
  for (double& z : state.z) z = 0;
  close(model, state);
  return state;
}

template <class Model>
Model with_length(double length) {
  typename Model::Parameters parameters;
  parameters.length = length;
  return Model(parameters);
}

/// Largest difference of an angle to the motion of a description that has this length and start, compiled afresh.
template <class Model>
double off_from_fresh(double length, double duration, double h) {
  model::Mechanism mechanism = read_model(JOURDAIN_SOURCE_DIR "/tests/steppers/rocking_four_bar.toml");
  const Model model = with_length<Model>(length);
  typename Model::State state = start(model);
  mechanism.parameters[0].value = length;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    mechanism.joints[j].coordinates[0].initial_position = state.y[j];
  const auto fresh = compiled_or_refused(mechanism);
  if (const auto* refused = std::get_if<std::string>(&fresh)) {
    ADD_FAILURE() << *refused;
    return INFINITY;
  }
  const CompiledSwing swing(mechanism, std::get<CompiledLinkage>(fresh).model);
  SwingState other = swing.start();
  other.z.assign(other.z.size(), 0);
  double worst = 0;
  for (double t = 0; t < duration; t += h) {
    rk4_step(model, state, {}, h);
    swing.step(other, h);
    EXPECT_TRUE(Model::loops_closed(state)) << length << " m at " << t << " s";
    for (std::size_t j = 0; j < 3; ++j) worst = std::max(worst, std::fabs(state.y[j] - other.y[j]));
  }
  return worst;
}

TEST(LoopLengths, OnBothSidesOfTheChangePointMoveAsThoseOfAFreshModel) {
  for (const double length : {0.3, 0.5, 0.8, 0.88, 0.92, 0.95, 1.1})
    EXPECT_LT(off_from_fresh<Rocking>(length, 1, 1e-4), 1e-7) << length;
  EXPECT_LT(off_from_fresh<Turning>(0.92, 1, 1e-4), 1e-7);
}

struct Outcome {
  bool flagged = false;
  double drift = 0;  ///< of the energy, share of it
};

template <class Model>
Outcome run(double length, double h) {
  const Model model = with_length<Model>(length);
  typename Model::State state = start(model);
  const auto energy = [&] { return kinetic_energy(model, state) + potential_energy(model, state); };
  const double at_start = energy();
  Outcome result;
  for (double t = 0; t < 2 && !result.flagged; t += h) {
    rk4_step(model, state, {}, h);
    result.flagged = !Model::loops_closed(state);
    if (!result.flagged) result.drift = std::max(result.drift, std::fabs(energy() / at_start - 1));
  }
  return result;
}

TEST(LoopLengths, NearTheChangePointAreRightOrFlagged) {
  constexpr double kVisible = 2e-3;  // what the fourth order leaves at this step
  int flagged = 0;
  for (int i = -20; i <= 20; ++i) {
    const Outcome coarse = run<Rocking>(kChange + 1e-4 * i, 1e-3),
                  fine = run<Rocking>(kChange + 1e-4 * i, 5e-5);
    flagged += coarse.flagged;
    EXPECT_LT(coarse.drift, kVisible) << i;
    EXPECT_LT(fine.drift, 1e-6) << i;
  }
  EXPECT_GT(flagged, 0);
  EXPECT_TRUE(run<Rocking>(kChange, 1e-3).flagged);  // half a joule is lost there
}

TEST(LoopLengths, WhereTheClosedFormIsNotProvenAreNamedAndFlagged) {
  Turning::Parameters parameters;
  EXPECT_TRUE(Turning::loops_proven(parameters));
  EXPECT_FALSE(run<Turning>(parameters.length, 1e-3).flagged);
  for (const double length : {0.92, 0.5, 0.3, static_cast<double>(NAN)}) {
    parameters.length = length;
    EXPECT_FALSE(Turning::loops_proven(parameters)) << length;
  }
  EXPECT_TRUE(run<Turning>(0.5, 1e-3).flagged);
  EXPECT_TRUE(run<Turning>(0.3, 1e-3).flagged);
}

}  // namespace
}  // namespace jourdain::tests
