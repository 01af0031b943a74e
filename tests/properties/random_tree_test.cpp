#include "random_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "model/read/read.hpp"
#include "reference/massless.hpp"
#include "to_toml.hpp"

namespace jourdain::tests {
namespace {

constexpr std::uint64_t kSeeds = 300;

/// First seed of a class, then every tenth: all seeds of that class below kSeeds (of kGeneral, a fifth of
/// them).
std::vector<std::uint64_t> seeds_of(TreeClass kind) {
  std::vector<std::uint64_t> seeds;
  std::uint64_t first = 0;
  while (tree_class(first) != kind) ++first;
  for (std::uint64_t seed = first; seed < kSeeds; seed += 10) seeds.push_back(seed);
  return seeds;
}

bool depends_on_parameters(const model::Mechanism& mechanism) {
  for (const model::Body& body : mechanism.bodies)
    if (!body.mass.is_constant()) return true;
  for (const model::Joint& joint : mechanism.joints)
    for (const model::Expression& c : joint.placement.position)
      if (!c.is_constant()) return true;
  return false;
}

/// Whether some revolute joint follows a revolute joint directly and its axis is parallel to that one's.
bool has_parallel_pair(const model::Mechanism& mechanism, const reference::State<double>& state) {
  const std::vector<model::JointIndex> joints = model::moving_joints(mechanism);
  const auto motion = reference::Reference<double>(mechanism).motion(state);
  const auto axis_of = [&](model::JointIndex j) {
    Eigen::Index column = 0;
    while (joints[std::size_t(column)] != j) ++column;
    const auto& body = motion[mechanism.joints[j.value].child.value];
    return reference::Vector3<double>(body.R_WB * body.J_r.col(column));
  };
  for (const model::JointIndex j : joints)
    for (const model::JointIndex p : joints) {
      const model::Joint &child = mechanism.joints[j.value], &parent = mechanism.joints[p.value];
      if (child.parent != parent.child || child.type != model::JointType::kRevolute ||
          parent.type != model::JointType::kRevolute)
        continue;
      if (axis_of(j).cross(axis_of(p)).norm() < 1e-14) return true;
    }
  return false;
}

TEST(RandomTree, IsTheSameForTheSameSeed) {
  std::set<std::string> texts;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const std::string text = to_toml(random_tree(seed));
    EXPECT_EQ(text, to_toml(random_tree(seed)));
    texts.insert(text);
  }
  EXPECT_EQ(texts.size(), 40u);
}

TEST(RandomTree, HasARegularMassMatrix) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const model::Mechanism mechanism = random_tree(seed);
    const auto terms = reference::Reference<double>(mechanism).evaluate(random_state(mechanism, seed),
                                                                        random_inputs(mechanism, seed));
    EXPECT_GE(terms.M.rows(), 1) << seed;
    EXPECT_EQ(terms.M.llt().info(), Eigen::Success) << seed;
    EXPECT_LE(reference::condition(terms.M), kMaximumCondition) << seed;
    EXPECT_TRUE(reference::massless_joints(mechanism).empty()) << seed;
  }
}

TEST(RandomTree, PassesTheModelChecksAndSurvivesBeingWrittenAndRead) {
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const std::string text = to_toml(random_tree(seed));
    support::Diagnostics diagnostics("tree.toml", text);
    const std::optional<model::Mechanism> again = model::read_mechanism(diagnostics);
    ASSERT_TRUE(again) << diagnostics.format() << text;
    EXPECT_EQ(to_toml(*again), text);
  }
}

TEST(RandomTree, AlignedTreesHaveSignedPermutationsAndUnitAxes) {
  for (const std::uint64_t seed : seeds_of(TreeClass::kAligned)) {
    const model::Mechanism mechanism = random_tree(seed);
    for (const model::Joint& joint : mechanism.joints) {
      for (const model::Expression& angle : joint.placement.rotation.rpy)
        EXPECT_EQ(std::remainder(angle.constant(), std::numbers::pi / 2), 0) << seed;
      EXPECT_EQ(std::abs(joint.axis[0]) + std::abs(joint.axis[1]) + std::abs(joint.axis[2]), 1) << seed;
    }
  }
}

TEST(RandomTree, ParallelTreesHaveParallelNeighbours) {
  for (const std::uint64_t seed : seeds_of(TreeClass::kParallel)) {
    const model::Mechanism mechanism = random_tree(seed);
    EXPECT_TRUE(has_parallel_pair(mechanism, random_state(mechanism, seed))) << seed;
  }
}

TEST(RandomTree, MasslessTreesHaveAMovingBodyWithoutMassSomewhere) {
  bool moving = false;
  for (const std::uint64_t seed : seeds_of(TreeClass::kMassless)) {
    const model::Mechanism mechanism = random_tree(seed);
    bool any = false;
    for (const model::Joint& joint : mechanism.joints) {
      const bool massless = mechanism.bodies[joint.child.value].mass.is_zero();
      any = any || massless;
      moving = moving || (massless && joint.type != model::JointType::kFixed);
    }
    EXPECT_TRUE(any) << seed;
  }
  EXPECT_TRUE(moving);
}

TEST(RandomTree, MassRatiosReachFiveDecades) {
  double widest = 1;
  for (const std::uint64_t seed : seeds_of(TreeClass::kMassRatios)) {
    double lightest = 1e9, heaviest = 0;
    for (const model::Body& body : random_tree(seed).bodies) {
      lightest = std::min(lightest, body.mass.constant());
      heaviest = std::max(heaviest, body.mass.constant());
    }
    widest = std::max(widest, heaviest / lightest);
  }
  EXPECT_GE(widest, 1e5);
}

TEST(RandomTree, TunableTreesDependOnTheirParametersAndOthersHaveNone) {
  int dependent = 0;
  for (const std::uint64_t seed : seeds_of(TreeClass::kParameters)) {
    const model::Mechanism mechanism = random_tree(seed);
    EXPECT_GE(mechanism.parameters.size(), 1u) << seed;
    dependent += depends_on_parameters(mechanism);
  }
  EXPECT_GE(dependent, 25);
  for (const std::uint64_t seed : seeds_of(TreeClass::kGeneral))
    EXPECT_TRUE(random_tree(seed).parameters.empty());
}

}  // namespace
}  // namespace jourdain::tests
