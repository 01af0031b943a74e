// Accelerations and constraint forces of the emitted programs against the descriptor form: every model and robot
// with loops and more than a hundred random mechanisms, of which a third have states beside them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "agreement/shared_data.hpp"
#include "loops/closed_programs.hpp"
#include "loops/plan/plan.hpp"
#include "loops/rows/configuration.hpp"
#include "model/motion_sources.hpp"
#include "properties/consistent_state.hpp"
#include "properties/effort.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_mixture.hpp"
#include "properties/random_rolling.hpp"
#include "properties/random_states.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::tests {
namespace {

using Long = long double;
using VectorL = reference::VectorX<Long>;
using MatrixL = reference::MatrixX<Long>;

const std::uint64_t kMechanisms = cases(120), kMixtures = cases(60);
constexpr std::size_t kStates = 3;
// Normwise, times the condition number: accelerations are solved with G M⁻¹ Gᵀ in double, with multipliers of
// regularised.
constexpr double kTolerance = 1e-9;

struct Tally {
  std::size_t mechanisms = 0, states = 0, left_out = 0, on_kinks = 0, redundant = 0;
  bool leaves_out_kinks = false;
  std::size_t treatments[3] = {0, 0, 0};
  double accelerations = 0, forces = 0, multipliers = 0;  ///< worst errors over condition numbers
  double of_redundant = kTolerance;  ///< of multipliers: rounding over the regularisation, 1e-7 of S
};

VectorL inputs(std::size_t count) { return VectorL::LinSpaced(Eigen::Index(count), -2, 3); }

double relative(const VectorL& a, const VectorL& b, Long scale) {
  return static_cast<double>((a - b).norm() / std::max(scale, b.norm()));
}

/// Singular values of G M⁻¹ Gᵀ with rows as long as the plan has them.
VectorL schur_values(const MatrixL& G, const MatrixL& M, const loops::LoopPlan& plan) {
  MatrixL scaled = G;
  for (Eigen::Index r = 0; r < G.rows(); ++r)
    scaled.row(r) *= Long(plan.row_length[static_cast<std::size_t>(r)]);
  const MatrixL S = scaled * reference::solved_by_ldlt<Long>(M, MatrixL(scaled.transpose()));
  return reference::singular_values(S);
}

/// The λ of least norm with lengths as the plan has them: of all with these generalized forces.
VectorL least_norm_multipliers(const MatrixL& G, const VectorL& forces, const loops::LoopPlan& plan) {
  VectorL length(G.rows());
  for (Eigen::Index r = 0; r < G.rows(); ++r) length[r] = Long(plan.row_length[static_cast<std::size_t>(r)]);
  const MatrixL scaled = length.asDiagonal() * G;
  return length.asDiagonal() * loops::least_norm(scaled.transpose(), forces);
}

void compare(const model::Mechanism& mechanism, const ClosedPrograms& programs, const LoopState& state,
             Tally& tally) {
  const loops::LoopPlan& plan = programs.plan();
  const VectorL u = inputs(programs.layout().input_count());
  const reference::DescriptorReference<Long> descriptor(mechanism);
  const auto expected = descriptor.solve(state.t, state.y, state.z, u);
  const MatrixL& G = expected.loops.G;
  const auto terms = reference::Reference<Long>(mechanism).evaluate(state, u);
  const VectorL sigma = schur_values(G, terms.M, plan);
  Long smallest = sigma[0];
  for (const Long s : sigma)
    if (s > 1e-12L * sigma[0]) smallest = std::min(smallest, s);
  if (!plan.is_reduced() && smallest < 20 * Long(plan.regularisation)) {
    ++tally.left_out;
    return;
  }
  if (tally.leaves_out_kinks && programs.is_on_a_kink(state, u)) {
    ++tally.on_kinks;
    return;
  }
  ++tally.states;
  // Regularised is by a share of what it is at the start.
  const Long condition = std::max(sigma[0], Long(plan.closing_regularisation) * 1e10L) / smallest;
  const VectorL zdot = programs.accelerations(state, u);
  const Long scale =
      expected.zdot.norm() + reference::solved_by_ldlt<Long>(terms.M, expected.loop_forces).norm();
  VectorL reduced = expected.zdot;
  if (plan.is_reduced()) {
    reduced.resize(Eigen::Index(plan.independent.size()));
    for (std::size_t j = 0; j < plan.independent.size(); ++j)
      reduced[Eigen::Index(j)] = expected.zdot[Eigen::Index(plan.independent[j])];
  }
  const double acceleration = relative(zdot, reduced, scale) / static_cast<double>(condition);
  const VectorL lambda = programs.multipliers(state, u);
  const Long load = expected.loop_forces.norm() + terms.k_bar.norm() + terms.q_bar.norm();
  const double force =
      relative(G.transpose() * lambda, expected.loop_forces, load) / static_cast<double>(condition);
  EXPECT_LE(acceleration, kTolerance) << "zdot, condition " << static_cast<double>(condition);
  EXPECT_LE(force, kTolerance) << "G^T lambda, condition " << static_cast<double>(condition);
  tally.accelerations = std::max(tally.accelerations, acceleration);
  tally.forces = std::max(tally.forces, force);
  const bool full = static_cast<std::size_t>(expected.loop_rank) == plan.row_length.size();
  tally.redundant += !full;
  if (plan.is_reduced() && !full) return;  // zero for rows that are not used
  if (!plan.sharing.empty()) return;       // so are those that do not share
  const VectorL least = full ? expected.loop_lambda : least_norm_multipliers(G, expected.loop_forces, plan);
  const Long lambda_scale = least.norm() + load / std::sqrt(sigma[0]);
  const double multiplier = relative(lambda, least, lambda_scale) / static_cast<double>(condition);
  EXPECT_LE(multiplier, full ? kTolerance : tally.of_redundant)
      << "lambda, condition " << static_cast<double>(condition);
  tally.multipliers = std::max(tally.multipliers, multiplier);
}

void compare(const model::Mechanism& given, std::optional<model::LoopTreatment> treatment,
             const std::vector<LoopState>& states, Tally& tally) {
  model::Mechanism mechanism = given;
  if (treatment) mechanism.loop_options = {};
  if (treatment) mechanism.loop_options.treatment = treatment;
  const ClosedPrograms programs(mechanism);
  ++tally.mechanisms;
  ++tally.treatments[static_cast<std::size_t>(programs.plan().treatment)];
  for (const LoopState& state : states) compare(mechanism, programs, state, tally);
}

bool has_plan(const model::Mechanism& mechanism) {
  support::Diagnostics diagnostics("rolling", "");
  return loops::plan_loops(mechanism, diagnostics).has_value();
}

void print(const char* what, const Tally& tally) {
  fmt::print(
      "{}: {} programs ({} explicit, {} partitioned, {} multipliers) at {} states, {} with redundant rows, "
      "{} "
      "near singular configurations and {} on kinks left out; errors over condition: accelerations {:.1e}, "
      "G^T "
      "lambda {:.1e}, lambda {:.1e}\n",
      what, tally.mechanisms, tally.treatments[0], tally.treatments[1], tally.treatments[2], tally.states,
      tally.redundant, tally.left_out, tally.on_kinks, tally.accelerations, tally.forces, tally.multipliers);
}

TEST(Loops, RandomMechanismsAccelerateAndLoadAsTheDescriptorFormSays) {
  Tally chosen, multipliers;
  for (std::uint64_t seed = 0; seed < kMechanisms; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    model::Mechanism mechanism = random_loops(seed);
    if (seed % 3 == 2) add_states(mechanism, seed);
    const auto states = consistent_states(mechanism, seed, kStates);
    ASSERT_TRUE(states);
    compare(mechanism, {}, *states, chosen);
    compare(mechanism, model::LoopTreatment::kMultipliers, *states, multipliers);
  }
  print("chosen", chosen);
  print("multipliers", multipliers);
  EXPECT_GE(chosen.states + multipliers.states, 5 * kMechanisms);
  EXPECT_GT(multipliers.redundant, kMechanisms / 10);
}

TEST(Loops, MechanismsThatRollAccelerateAndLoadAsTheDescriptorFormSays) {
  Tally tally, reduced;
  tally.of_redundant = 1e-7;  // rows weigh as little as they do
  for (std::uint64_t seed = 0; seed < cases(200); ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const model::Mechanism mechanism = random_rolling(seed);
    const auto states = consistent_states(mechanism, seed, kStates);
    ASSERT_TRUE(states);
    compare(mechanism, {}, *states, tally);
    if (const model::Mechanism asking = asking_for_independent_velocities(mechanism); has_plan(asking))
      compare(asking, {}, *states, reduced);
  }
  print("rolling", tally);
  print("rolling, by independent velocities", reduced);
  EXPECT_GE(tally.states, 5 * cases(200) / 2);
  EXPECT_GE(reduced.mechanisms, cases(200) / 12);
}

TEST(Loops, MixturesWithElementsAndLawsAccelerateAndLoadAsTheDescriptorFormSays) {
  Tally chosen, multipliers;
  int led = 0;
  multipliers.of_redundant = chosen.of_redundant = 1e-7;
  multipliers.leaves_out_kinks = chosen.leaves_out_kinks = true;
  for (std::uint64_t seed = 0; seed < kMixtures; ++seed) {
    if (seed % 3 == 0) continue;  // without loops
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const model::Mechanism mechanism = random_mixture(seed);
    led += model::motions_follow_states(mechanism);
    const auto states = consistent_states(mechanism, seed, kStates);
    ASSERT_TRUE(states);
    compare(mechanism, {}, *states, chosen);
    compare(mechanism, model::LoopTreatment::kMultipliers, *states, multipliers);
  }
  EXPECT_GT(led, 0);
  print(fmt::format("mixtures ({} with motions that follow states), chosen", led).c_str(), chosen);
  print("mixtures, multipliers", multipliers);
  EXPECT_GE(chosen.states + multipliers.states, 2 * kMixtures);
}

TEST(Loops, EveryModelAcceleratesAndLoadsAsTheDescriptorFormSays) {
  Tally chosen, multipliers;
  for (const std::string& name : models_with_loops()) {
    SCOPED_TRACE(name);
    const model::Mechanism mechanism = read_model(model_path(name + ".toml"));
    const auto states = consistent_states(mechanism, 1, 5);
    ASSERT_TRUE(states);
    compare(mechanism, {}, *states, chosen);
    compare(mechanism, model::LoopTreatment::kMultipliers, *states, multipliers);
  }
  print("models, chosen", chosen);
  print("models, multipliers", multipliers);
  EXPECT_GE(chosen.mechanisms, 7u);
}

/// A robot beside the project, as far as it is there and its format is read.
std::optional<model::Mechanism> public_robot(const std::string& file) {
  const std::filesystem::path path = public_data_path(file);
  if (!std::filesystem::exists(path)) {
    fmt::print("public robot {} is not there: a case less\n", file);
    return {};
  }
  return read_model(path);
}

/// Robots with loops: a leg of ours, and Cassie where it is there.
TEST(Loops, RobotsAccelerateAndLoadAsTheDescriptorFormSays) {
  std::vector<std::pair<std::string, model::Mechanism>> robots;
  robots.emplace_back("linked_leg", read_model(data_path("mjcf/linked_leg.xml")));
  for (const char* file : {"urdf/cassie_simple.sdf", "urdf/cassie_v2.sdf"})
    if (auto robot = public_robot(file)) robots.emplace_back(file, *std::move(robot));
  for (const auto& [name, mechanism] : robots) {
    SCOPED_TRACE(name);
    const auto states = consistent_states(mechanism, 1, 5);
    ASSERT_TRUE(states);
    Tally chosen, multipliers;
    compare(mechanism, {}, *states, chosen);
    compare(mechanism, model::LoopTreatment::kMultipliers, *states, multipliers);
    print((name + ", chosen").c_str(), chosen);
    print((name + ", multipliers").c_str(), multipliers);
    EXPECT_GE(chosen.states, 3u);
  }
}

/// Suspensions on a chassis that moves, with tunable lengths, with a strut of two bodies, and a point between
/// three spheres.
TEST(Loops, ClosedFormsInSpaceAgreeWithTheDescriptorForm) {
  Tally tally;
  for (const char* name : {"chassis_corner", "tunable_corner", "strut_with_slide", "delta_leg",
                           "mounted_universal", "tilted_four_bar"}) {
    SCOPED_TRACE(name);
    const model::Mechanism mechanism =
        read_model(fmt::format("{}/tests/loops/scenes/{}.toml", JOURDAIN_SOURCE_DIR, name));
    const auto states = consistent_states(mechanism, 5, kStates);
    ASSERT_TRUE(states);
    compare(mechanism, std::nullopt, *states, tally);
  }
  print("closed forms in space", tally);
  EXPECT_EQ(tally.treatments[0], 6u);
}

}  // namespace
}  // namespace jourdain::tests
