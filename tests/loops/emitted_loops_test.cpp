// Published benchmarks with loops, run through the emitted code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "agreement/shared_data.hpp"
#include "embed/emitted_models.hpp"
#include "loops/closed_programs.hpp"

namespace jourdain::tests {
namespace {

template <class Model>
double energy(const Model& model, const typename Model::State& state) {
  return kinetic_energy(model, state) + potential_energy(model, state);
}

/// Largest |g| of a state.
template <class Model>
double opening(const Model& model, const typename Model::State& state) {
  double g[Model::constraint_count], rate[Model::constraint_count], worst = 0;
  constraint_residual(model, state, g, rate);
  for (const double entry : g) worst = std::max(worst, std::fabs(entry));
  return worst;
}

/// The recomputed column at t = 0.03 s, by name.
std::map<std::string, double> squeezer_at_end() {
  std::ifstream file(data_path("reference/andrews_squeezer.json"));
  const nlohmann::json rows = nlohmann::json::parse(file)["rows"];
  std::map<std::string, double> values;
  for (const auto& row : rows) values[row["name"]] = std::stod(row["computed"].get<std::string>());
  return values;
}

TEST(Squeezer, ReachesTheRecomputedPositionsWithRk4) {
  const std::map<std::string, double> expected = squeezer_at_end();
  const squeezer::Model<> model;
  double previous = 0, best = 1;
  fmt::print("     h, s      error   residual, m\n");
  for (const int steps : {750, 1500, 3000, 6000}) {
    squeezer::State<> state = initial_state(model);
    double residual = 0;
    for (int i = 0; i < steps; ++i) rk4_step(model, state, {}, 0.03 / steps);
    double error = 0;
    for (int i = 0; i < model.position_count; ++i)
      error = std::max(error, std::fabs(state.y[i] - expected.at(squeezer::position_names[i])));
    residual = opening(model, state);
    fmt::print("  {:.1e}   {:.2e}      {:.1e}\n", 0.03 / steps, error, residual);
    EXPECT_LT(residual, 1e-15);
    const bool above_rounding = previous > 1e-12;
    EXPECT_TRUE(!above_rounding || error < previous / 10) << "order 4 or better";
    previous = error;
    best = std::min(best, error);
  }
  EXPECT_LT(best, 1e-9);
}

TEST(Squeezer, HasTheRecomputedVelocitiesAccelerationsAndMultipliers) {
  const std::map<std::string, double> expected = squeezer_at_end();
  const squeezer::Model<> model;
  squeezer::State<> state = initial_state(model);
  for (int i = 0; i < 10000; ++i) rk4_step(model, state, {}, 3e-6);
  double rates[7], zdot[1], lambda[6];
  position_rate(model, state, rates);
  forward_dynamics(model, state, {}, zdot);
  constraint_forces(model, state, {}, lambda);
  for (int i = 0; i < 7; ++i) {
    const double rate = expected.at(fmt::format("d{}", squeezer::position_names[i]));
    EXPECT_NEAR(rates[i], rate, 1e-9 * std::fabs(rate) + 1e-8) << squeezer::position_names[i];
  }
  EXPECT_NEAR(zdot[0], expected.at("ddbeta"), 1e-8 * std::fabs(expected.at("ddbeta")));
  for (int r = 0; r < 6; ++r) EXPECT_NEAR(lambda[r], expected.at(fmt::format("lambda{}", r + 1)), 1e-6) << r;
}

TEST(NFourBar, PassesItsSingularPositions) {
  const n_four_bar::Model<> model;
  fmt::print("     h, s   error of B0, m   energy drift, J   residual, m\n");
  for (const int steps : {2500, 5000, 10000, 20000, 40000}) {
    n_four_bar::State<> state = initial_state(model);
    const double at_start = energy(model, state);
    double drift = 0, residual = 0;
    for (int i = 0; i < steps; ++i) {
      rk4_step(model, state, {}, 10.0 / steps);
      drift = std::max(drift, std::fabs(energy(model, state) - at_start));
      residual = std::max(residual, opening(model, state));
    }
    const double error =
        std::hypot(-std::sin(state.y[0]) - 0.328458111541, std::cos(state.y[0]) - 0.944518538179);
    fmt::print("  {:.1e}   {:.1e}          {:.1e}           {:.1e}\n", 10.0 / steps, error, drift, residual);
    if (steps < 5000) continue;
    EXPECT_LT(error, 1e-6) << steps;
    EXPECT_LE(drift, 1e-6) << steps;
    EXPECT_LT(residual, 1e-10) << steps;
  }
}

TEST(FourBar, DoesWhatTheReadmeShows) {
  const four_bar::Model<> model;
  auto state = initial_state(model);
  state.y[0] = 0.5;
  close_loops(model, state);
  EXPECT_LT(opening(model, state), 1e-15);
  for (int i = 0; i < 1000; ++i) rk4_step(model, state, {}, 1e-3);
  EXPECT_LT(opening(model, state), 1e-15);
  double lambda[2];
  constraint_forces(model, state, {}, lambda);
  EXPECT_NEAR(lambda[0], -0.98, 0.005);
  EXPECT_NEAR(lambda[1], -5.5, 0.05);
}

TEST(SpringFourBar, SaysWhenItHasLeftTheRangeOfTheProof) {
  using Model = spring_four_bar::Model<>;
  const Model model;
  Model::State state = initial_state(model);
  const auto moved_to = [&](double crank) {
    const double way = crank - state.y[0];
    for (int i = 0; i < 100; ++i) {
      state.y[0] += way / 100;
      close_loops(model, state);
    }
    close_loops(model, state);
    return state.beyond[0];
  };
  for (const double inside : {2.0, 2.94, 1.0, 0.51}) {
    EXPECT_LT(moved_to(inside), 0) << inside;
    EXPECT_TRUE(Model::loops_closed(state)) << inside;
  }
  for (const double outside : {0.49, 2.0, 2.96}) {
    const bool is_inside = outside == 2.0;  // on the way back
    EXPECT_EQ(moved_to(outside) > 0, !is_inside) << outside;
    EXPECT_EQ(Model::loops_closed(state), is_inside) << outside;
  }
}

TEST(SpringFourBar, SaysWhenItWasMovedFartherThanIsProven) {
  using Model = spring_four_bar::Model<>;
  const Model model;
  Model::State state = initial_state(model);
  state.y[0] += 1e-2;
  close_loops(model, state);
  EXPECT_FALSE(Model::loops_closed(state));
  close_loops(model, state);
  EXPECT_TRUE(Model::loops_closed(state));
  state.y[0] += 1e-4;
  close_loops(model, state);
  EXPECT_TRUE(Model::loops_closed(state));
  for (double spring_four_bar::State<>::*member :
       {&spring_four_bar::State<>::regularity, &spring_four_bar::State<>::opening}) {
    Model::State broken = state;
    broken.*member = NAN;
    EXPECT_FALSE(Model::loops_closed(broken));
  }
}

TEST(DoubleWishbone, SaysForWhichParametersItIsProven) {
  double_wishbone::Parameters<> parameters;
  EXPECT_TRUE(double_wishbone::Model<>::loops_proven(parameters));
  parameters.steering *= 1.5;
  EXPECT_FALSE(double_wishbone::Model<>::loops_proven(parameters));
}

TEST(SpringFourBar, HasThePublishedEquilibrium) {
  const spring_four_bar::Model<> model;
  spring_four_bar::State<> state = initial_state(model);
  for (int i = 0; i < 100000; ++i) rk4_step(model, state, {}, 1e-3);
  EXPECT_NEAR(state.y[0], 2.234331019017586, 1e-10);
  const ClosedPrograms programs(read_model(model_path("spring_four_bar.toml")), true);
  const auto A = programs.values("linearize", 0, {state.y, state.y + 3}, {0.0}, {});
  const double real = A.at("A[1][1]") / 2, imaginary = std::sqrt(-A.at("A[1][0]") - real * real);
  fmt::print("equilibrium {:.13f} rad, eigenvalues {:.12f} +- {:.12f} i\n", state.y[0], real, imaginary);
  EXPECT_NEAR(real, -0.2423858093105051, 1e-8);
  EXPECT_NEAR(imaginary, 2.13395502834838, 1e-8);
}

}  // namespace
}  // namespace jourdain::tests
