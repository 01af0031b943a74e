// Operations of the emitted models, counted by running them on a counting number type.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "crane_packs/crane_packs_kernels.hpp"
#include "embed/counting.hpp"
#include "embed/emitted_models.hpp"
#include "embed/generic_driver.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadrotor_packs/quadrotor_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"

/// What users' functions take is none of the model's operations.
template <>
struct glider::Functions<jourdain::tests::Counting> {
  using Counting = jourdain::tests::Counting;
  Counting lift(const Counting& incidence) const noexcept { return incidence; }
  Counting drag(const Counting& incidence) const noexcept { return incidence; }
};

/// So that operations on lanes are counted as such.
#define JOURDAIN_COUNT_LANES(name)                             \
  template <int N>                                             \
  struct name::detail::LanesOf<N, jourdain::tests::Counting> { \
    typedef jourdain::tests::CountingLanes<N> Type;            \
  };
JOURDAIN_COUNT_LANES(quadruped)
JOURDAIN_COUNT_LANES(quadruped_packs)
JOURDAIN_COUNT_LANES(standing_quadruped)
#undef JOURDAIN_COUNT_LANES

namespace jourdain::tests {
namespace {

using Counts = std::map<std::string, ir::Operations>;

/// Counts of every function of an emitted model, run at its initial state.
template <class Model>
Counts count_functions() {
  const Model model;
  const auto state = initial_state(model);
  Results<Model> results;
  Counts counts;
  visit_functions(model, state, typename Model::Input{}, results, [&](const char* name, auto&& call) {
    counted = {};
    call();
    counts[name] = counted;
  });
  return counts;
}

std::map<std::string, Counts> all_counts() {
  std::map<std::string, Counts> counts;
#define JOURDAIN_COUNT(name) counts[#name] = count_functions<::name::Model<Counting>>();
  JOURDAIN_EMITTED_MODELS(JOURDAIN_COUNT)
  return counts;
}

/// Then angles are sums of two numbers, which the manifest counts as one.
bool turns_with_time(const nlohmann::json& manifest) {
  for (const std::string sentence : manifest["assumptions"])
    if (sentence.starts_with("angles that follow from time")) return true;
  return false;
}

void expect_counts_of_the_manifest(const std::string& folder, const std::string& model,
                                   const Counts& functions) {
  std::ifstream file(fmt::format("{}/{}/{}.json", folder, model, model));
  const nlohmann::json manifest = nlohmann::json::parse(file), &stated = manifest["operations"];
  const bool turns = turns_with_time(manifest);
  for (const auto& [function, c] : functions) {
    const nlohmann::json& s = stated[function];
    if (turns) {
      EXPECT_GE(c.arithmetic(), s["arithmetic"]) << model << " " << function;
      continue;
    }
    EXPECT_EQ(s["add"], c.add) << model << " " << function;
    EXPECT_EQ(s["sub"], c.subtract) << model << " " << function;
    EXPECT_EQ(s["mul"], c.multiply) << model << " " << function;
    EXPECT_EQ(s["div"], c.divide) << model << " " << function;
    EXPECT_EQ(s["sqrt"], c.sqrt) << model << " " << function;
    EXPECT_EQ(s["sin"], c.sin) << model << " " << function;
    EXPECT_EQ(s["cos"], c.cos) << model << " " << function;
    EXPECT_EQ(s.value("atan2", std::size_t(0)), c.atan2) << model << " " << function;
    EXPECT_EQ(s["arithmetic"], c.arithmetic()) << model << " " << function;
  }
}

TEST(Operations, AreThoseOfTheManifest) {
  for (const auto& [model, functions] : all_counts())
    expect_counts_of_the_manifest(JOURDAIN_EMITTED, model, functions);
}

/// The text for packs, in which one operation is one of a whole pack.
TEST(Operations, OfPacksAreThoseOfTheManifest) {
#define JOURDAIN_COUNT(name) \
  expect_counts_of_the_manifest(JOURDAIN_PACKS, #name, count_functions<::name::Model<Counting>>())
  JOURDAIN_COUNT(crane_packs);
  JOURDAIN_COUNT(four_bar_packs);
  JOURDAIN_COUNT(panda_packs);
  JOURDAIN_COUNT(quadrotor_packs);
  JOURDAIN_COUNT(quadruped_packs);
#undef JOURDAIN_COUNT
}

/// How many operations go with others, as the manifest says it, of those that it counts.
template <class Model>
void expect_lanes_of_the_manifest(const std::string& name) {
  std::ifstream file(fmt::format("{}/{}/{}.json", JOURDAIN_EMITTED, name, name));
  const nlohmann::json manifest = nlohmann::json::parse(file), &said = manifest["assumptions"];
  const Model model;
  Results<Model> results;
  std::string sentence;
  visit_functions(model, initial_state(model), typename Model::Input{}, results,
                  [&](const std::string& function, auto&& call) {
                    if (function != "forward_dynamics") return;
                    counted = {};
                    counted_with_others = 0;
                    call();
                    sentence = fmt::format(
                        "limbs that are alike are computed at once, as lanes of vectors: {} of {} "
                        "operations of forward_dynamics go with others (--no-lanes: one after the other)",
                        counted_with_others, counted.arithmetic());
                  });
  EXPECT_NE(std::find(said.begin(), said.end(), sentence), said.end()) << sentence << "\n" << said;
}

TEST(Operations, OnLanesAreThoseOfTheManifest) {
  expect_lanes_of_the_manifest<::quadruped::Model<Counting>>("quadruped");
  expect_lanes_of_the_manifest<::standing_quadruped::Model<Counting>>("standing_quadruped");
}

TEST(Operations, StayAtTheBestThatWasReached) {
  auto counts = all_counts();
  // The manifests hold all counts; these are the ones that other generators are compared with.
  EXPECT_EQ(counts["ur5"]["forward_dynamics"].arithmetic(), 360u);
  EXPECT_EQ(counts["ur5"]["mass_matrix"].arithmetic(), 85u);
  EXPECT_EQ(counts["panda"]["forward_dynamics"].arithmetic(), 997u);
  EXPECT_EQ(counts["panda"]["mass_matrix"].arithmetic(), 313u);
  EXPECT_EQ(counts["puma560"]["forward_dynamics"].arithmetic(), 504u);
  EXPECT_EQ(counts["pendulum"]["forward_dynamics"].arithmetic(), 1u);
  EXPECT_EQ(counts["four_bar"]["forward_dynamics"].arithmetic(), 103u);
  EXPECT_EQ(counts["slider_crank"]["forward_dynamics"].arithmetic(), 76u);
  EXPECT_EQ(counts["squeezer"]["forward_dynamics"].arithmetic(), 316u);
  // 16 of each for an angle that follows from time and is a sum of two numbers.
  EXPECT_EQ(counts["double_wishbone"]["forward_dynamics"].arithmetic(), 679u + 16u);
  EXPECT_EQ(counts["mcpherson_strut"]["forward_dynamics"].arithmetic(), 970u + 16u);
  EXPECT_EQ(counts["double_pendulum"]["forward_dynamics"].arithmetic(), 22u);
  EXPECT_EQ(counts["chain4"]["forward_dynamics"].arithmetic(), 129u);
  EXPECT_EQ(counts["n_four_bar"]["forward_dynamics"].arithmetic(), 343u);
}

TEST(Operations, UseOneSineAndCosineAJointAtMost) {
  auto counts = all_counts();
  const std::map<std::string, std::size_t> joints = {{"cart_pole", 2}, {"chain4", 4},  {"double_pendulum", 2},
                                                     {"panda", 7},     {"puma560", 6}, {"ur5", 6}};
  for (const auto& [model, most] : joints)
    for (const auto& [function, c] : counts[model]) {
      EXPECT_LE(c.sin, most) << model << " " << function;
      EXPECT_LE(c.cos, most) << model << " " << function;
    }
}

}  // namespace
}  // namespace jourdain::tests
