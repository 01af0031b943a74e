// The random loops themselves: repeatable, varied, closed at all their states.
#include "properties/random_loops.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "model/coordinates.hpp"
#include "properties/consistent_state.hpp"
#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

using model::LoopType;
using Long = long double;

constexpr std::uint64_t kMechanisms = 120;
constexpr Long kAssembled =
    1e-13L;  // the model's numbers are rounded to double, lengths and angles are of order 1

bool is_quaternion_joint(const model::Joint& joint) {
  return joint.type == model::JointType::kSpherical || joint.type == model::JointType::kFree;
}

/// Drawn once for all tests.
const std::vector<model::Mechanism>& drawn() {
  static const std::vector<model::Mechanism> mechanisms = [] {
    std::vector<model::Mechanism> result;
    for (std::uint64_t seed = 0; seed < cases(kMechanisms); ++seed) result.push_back(random_loops(seed));
    return result;
  }();
  return mechanisms;
}

TEST(RandomLoops, AreClosedAtAllTheirStates) {
  Long position = 0, rate = 0;
  for (std::uint64_t seed = 0; seed < cases(kMechanisms); ++seed) {
    const model::Mechanism& mechanism = drawn()[seed];
    const reference::DescriptorReference<Long> form(mechanism);
    const auto states = consistent_states(mechanism, seed, kLoopStates);
    ASSERT_TRUE(states) << seed;
    for (const LoopState& state : *states) {
      const auto constraints = form.loop_constraints(state.t, state.y, state.z);
      position = std::max(position, constraints.g.lpNorm<Eigen::Infinity>());
      rate = std::max(rate, constraints.rate.lpNorm<Eigen::Infinity>());
      EXPECT_LE(constraints.g.lpNorm<Eigen::Infinity>(), kAssembled) << seed;
      EXPECT_LE(constraints.rate.lpNorm<Eigen::Infinity>(), kAssembled * (1 + state.z.norm())) << seed;
      EXPECT_GT(state.z.norm(), 0) << seed;
    }
    EXPECT_GT((states->front().y - states->back().y).norm(), 1e-6L) << seed;
  }
  fmt::print("largest g {:.1e}, largest rate {:.1e}\n", double(position), double(rate));
}

// The initial positions are closed as the file has them, at rest, before any Newton step.
TEST(RandomLoops, AreAssembledAtRestInitially) {
  for (std::uint64_t seed = 0; seed < cases(kMechanisms); ++seed) {
    const model::Mechanism& mechanism = drawn()[seed];
    const LoopState start = reference::Reference<Long>(mechanism).initial_state();
    const auto constraints =
        reference::DescriptorReference<Long>(mechanism).loop_constraints(0, start.y, start.z);
    EXPECT_LE(constraints.g.lpNorm<Eigen::Infinity>(), kAssembled) << seed;
    EXPECT_LE(constraints.rate.lpNorm<Eigen::Infinity>(), kAssembled) << seed;
  }
}

TEST(RandomLoops, KeepTheirRankAndSomeFreedomAndCoverEverything) {
  std::map<LoopType, int> types;
  int planar = 0, redundant = 0, spatial_redundant = 0, quaternions = 0, motions = 0, lengths = 0,
      springs = 0, driven = 0, tunable = 0, moving_carriers = 0, by_loops[3] = {}, by_freedom[4] = {};
  for (std::uint64_t seed = 0; seed < cases(kMechanisms); ++seed) {
    const model::Mechanism& mechanism = drawn()[seed];
    const LoopState start = reference::Reference<Long>(mechanism).initial_state();
    const LoopFreedom freedom =
        loop_freedom(reference::DescriptorReference<Long>(mechanism).loop_constraints(0, start.y, start.z));
    EXPECT_GE(freedom.motions.cols(), 1) << seed;
    EXPECT_GE(freedom.weakest, kWeakestConstraint) << seed;
    const LoopClass kind = loop_class(seed);
    const bool overconstrained = freedom.rank < freedom.rows;
    const bool meant = kind == LoopClass::kOverconstrained || kind == LoopClass::kParallelogram;
    EXPECT_TRUE(kind == LoopClass::kSpatial || overconstrained == meant) << seed;
    ASSERT_EQ(mechanism.loops.size(), 1 + seed / 8 % 3);
    planar += kind != LoopClass::kSpatial;
    redundant += overconstrained;
    spatial_redundant += overconstrained && kind == LoopClass::kSpatial;
    ++by_loops[mechanism.loops.size() - 1];
    ++by_freedom[std::min<Eigen::Index>(freedom.motions.cols(), 4) - 1];
    springs += !mechanism.springs.empty();
    driven += !mechanism.actuators.empty();
    tunable += !mechanism.parameters.empty();
    quaternions += std::any_of(mechanism.joints.begin(), mechanism.joints.end(), is_quaternion_joint);
    for (const model::Loop& loop : mechanism.loops) {
      ++types[loop.type];
      lengths += !loop.length.has_no_variable();
      if (loop.type == LoopType::kResidual) continue;
      const auto body = [&](model::FrameIndex frame) { return mechanism.frames[frame.value].body; };
      moving_carriers += model::carrier(mechanism, body(loop.from), body(loop.to)).has_value();
    }
    for (const model::Joint& joint : mechanism.joints)
      for (const model::Coordinate& coordinate : joint.coordinates) motions += coordinate.motion.has_value();
  }
  fmt::print(
      "{} mechanisms: {} planar, {} spatial; {} overconstrained ({} spatial); 1/2/3 loops {}/{}/{}; freedom "
      "1/2/3/more "
      "{}/{}/{}/{}\nquaternion joints {}, motions {}, changing rods {}, carriers that move {}, springs {}, "
      "actuators {}, "
      "parameters {}\n",
      cases(kMechanisms), planar, cases(kMechanisms) - std::uint64_t(planar), redundant, spatial_redundant,
      by_loops[0], by_loops[1], by_loops[2], by_freedom[0], by_freedom[1], by_freedom[2], by_freedom[3],
      quaternions, motions, lengths, moving_carriers, springs, driven, tunable);
  fmt::print("loop joints by type:");
  for (const auto& [type, count] : types) fmt::print(" {}", count);
  fmt::print("\n");
  if (cases(kMechanisms) < kMechanisms) return;
  EXPECT_EQ(types.size(), 10u);
  for (const int count :
       {quaternions, motions, lengths, springs, driven, tunable, moving_carriers, by_freedom[0]})
    EXPECT_GE(count, 5);
  EXPECT_GE(redundant, 25);
}

TEST(RandomLoops, AreTheSameForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const model::Mechanism one = random_loops(seed), other = random_loops(seed);
    const auto a = consistent_states(one, seed, 2), b = consistent_states(other, seed, 2);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->back().y, b->back().y);
    EXPECT_EQ(a->back().z, b->back().z);
    EXPECT_NE(a->back().z, consistent_states(one, seed + 1, 2)->back().z);
  }
}

}  // namespace
}  // namespace jourdain::tests
