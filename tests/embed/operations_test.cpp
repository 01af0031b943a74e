// Operations of the emitted models, counted by running them on a counting number type.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "embed/counting.hpp"
#include "embed/emitted_models.hpp"

namespace jourdain::tests {
namespace {

using Counts = std::map<std::string, ir::Operations>;

/// Counts of every function of an emitted model, run at its initial state.
template <class Model>
Counts count_functions() {
  constexpr int n = Model::velocity_count;
  const Model model;
  const auto state = initial_state(model);
  const typename Model::Input input{};
  Counting M[n][n], v[n], zdot[n];
  Counts counts;
  const auto count = [&](const char* name, auto&& call) {
    counted = {};
    call();
    counts[name] = counted;
  };
  count("initial_state", [&] { initial_state(model); });
  count("mass_matrix", [&] { mass_matrix(model, state, M); });
  count("k_bar", [&] { k_bar(model, state, v); });
  count("q_bar", [&] { q_bar(model, state, input, v); });
  count("forward_dynamics", [&] { forward_dynamics(model, state, input, v); });
  count("inverse_dynamics", [&] { inverse_dynamics(model, state, zdot, v); });
  count("kinetic_energy", [&] { kinetic_energy(model, state); });
  count("potential_energy", [&] { potential_energy(model, state); });
  return counts;
}

std::map<std::string, Counts> all_counts() {
  std::map<std::string, Counts> counts;
#define JOURDAIN_COUNT(name) counts[#name] = count_functions<::name::Model<Counting>>();
  JOURDAIN_EMITTED_MODELS(JOURDAIN_COUNT)
  return counts;
}

TEST(Operations, AreThoseOfTheManifest) {
  for (const auto& [model, functions] : all_counts()) {
    std::ifstream file(fmt::format("{}/generated/{}/{}.json", JOURDAIN_SOURCE_DIR, model, model));
    const nlohmann::json stated = nlohmann::json::parse(file)["operations"];
    for (const auto& [function, c] : functions) {
      const nlohmann::json& s = stated[function];
      EXPECT_EQ(s["add"], c.add) << model << " " << function;
      EXPECT_EQ(s["sub"], c.subtract) << model << " " << function;
      EXPECT_EQ(s["mul"], c.multiply) << model << " " << function;
      EXPECT_EQ(s["div"], c.divide) << model << " " << function;
      EXPECT_EQ(s["sqrt"], c.sqrt) << model << " " << function;
      EXPECT_EQ(s["sin"], c.sin) << model << " " << function;
      EXPECT_EQ(s["cos"], c.cos) << model << " " << function;
      EXPECT_EQ(s["arithmetic"], c.arithmetic()) << model << " " << function;
    }
  }
}

TEST(Operations, StayAtTheBestThatWasReached) {
  auto counts = all_counts();
  // The manifests in generated/ hold all counts; these are the ones that other generators are compared with.
  EXPECT_EQ(counts["ur5"]["forward_dynamics"].arithmetic(), 375u);
  EXPECT_EQ(counts["ur5"]["mass_matrix"].arithmetic(), 82u);
  EXPECT_EQ(counts["panda"]["forward_dynamics"].arithmetic(), 1003u);
  EXPECT_EQ(counts["panda"]["mass_matrix"].arithmetic(), 319u);
  EXPECT_EQ(counts["puma560"]["forward_dynamics"].arithmetic(), 527u);
  EXPECT_EQ(counts["pendulum"]["forward_dynamics"].arithmetic(), 3u);
}

TEST(Operations, UseOneSineAndCosineAJointAtMost) {
#define JOURDAIN_CHECK_PAIRS(name)                                                       \
  for (const auto& [function, c] : count_functions<::name::Model<Counting>>()) {         \
    EXPECT_LE(c.sin, std::size_t(::name::Model<>::velocity_count)) << #name << function; \
    EXPECT_LE(c.cos, std::size_t(::name::Model<>::velocity_count)) << #name << function; \
  }
  JOURDAIN_EMITTED_MODELS(JOURDAIN_CHECK_PAIRS)
}

}  // namespace
}  // namespace jourdain::tests
