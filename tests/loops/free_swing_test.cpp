// A few random linkages of each class swing free for half a second: what the compiler makes of them by
// default, and what the judge sees. A thousand of them: ./dev bench.
#include "loops/free_swing.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "loops/compiled_swing.hpp"
#include "loops/plan/plan_text.hpp"
#include "properties/consistent_state.hpp"
#include "properties/effort.hpp"
#include "properties/to_toml.hpp"

namespace jourdain::tests {
namespace {

// By what their remainders choose: at rest and off a dead position; tunable, moving and near one; an axis tilted.
constexpr std::uint64_t kSeeds[] = {6, 9, 14};
const std::size_t kSeedCount = draws_all_cases() ? std::size(kSeeds) : 1;
constexpr Looks kHalfASecond{0.05, 10};
// m; numbers of a mechanism are rounded, and lengths are of order 1.
constexpr double kClosedAtStart = 1e-15;

const LinkageKind& kind_of(LinkageClass wanted) { return linkage_kinds()[static_cast<std::size_t>(wanted)]; }

/// The first seeds of each class. Platforms take seconds each: they are left to the bench.
template <class Check>
void for_some(std::size_t seeds, Check&& check) {
  for (const LinkageKind& kind : linkage_kinds())
    for (std::size_t i = 0; i < seeds && kind.kind != LinkageClass::kStewart; ++i) {
      SCOPED_TRACE(fmt::format("{}, seed {}", kind.name, kSeeds[i]));
      check(random_linkage(kind, kSeeds[i]));
    }
}

void expect_none_wrong(std::size_t seeds, std::optional<model::LoopTreatment> treatment) {
  std::size_t counts[kOutcomes] = {};
  for_some(seeds, [&](const RandomLinkage& linkage) {
    const KnownMotion known = known_motion(linkage.ideal, linkage.size, kHalfASecond);
    const Judgement judgement = judge(linkage, known, kHalfASecond, treatment);
    ++counts[static_cast<std::size_t>(judgement.outcome)];
    EXPECT_FALSE(judgement.outcome == Outcome::kWrong) << judgement.why;
  });
  fmt::print("right {}, flagged {}, refused {}, wrong {}, without reference {}\n", counts[0], counts[1],
             counts[2], counts[3], counts[4]);
}

TEST(FreeSwing, IsRightOrRefusedByDefault) { expect_none_wrong(kSeedCount, {}); }

TEST(FreeSwing, IsRightOrRefusedWithMultipliers) { expect_none_wrong(1, model::LoopTreatment::kMultipliers); }

Outcome outcome_of(LinkageClass wanted, std::uint64_t seed) {
  const RandomLinkage linkage = random_linkage(kind_of(wanted), seed);
  const Judgement judgement =
      judge(linkage, known_motion(linkage.ideal, linkage.size, kHalfASecond), kHalfASecond);
  EXPECT_EQ(judgement.why, "");
  return judgement.outcome;
}

TEST(FreeSwing, GoesOnWhereRedundantRowsTakeTurns) {
  EXPECT_EQ(outcome_of(LinkageClass::kSarrus, 7), Outcome::kRight);
  EXPECT_EQ(outcome_of(LinkageClass::kSarrus, 8), Outcome::kRight);
}

TEST(RandomLinkages, SayWhichRowsTakeTurns) {
  const RandomLinkage linkage = random_linkage(kind_of(LinkageClass::kSarrus), 7);
  const auto compiled = compiled_or_refused(linkage.mechanism);
  EXPECT_THAT(loops::sentences(linkage.mechanism, std::get<CompiledLinkage>(compiled).plan),
              testing::Contains(testing::HasSubstr("redundant in turn")));
}

TEST(FreeSwing, GoesOnAlthoughAxesAreAskew) {
  EXPECT_EQ(outcome_of(LinkageClass::kBennett, 0), Outcome::kRight);  // four decimals
  EXPECT_EQ(outcome_of(LinkageClass::kBennett, 5), Outcome::kRight);  // 1e-13 rad
}

TEST(FreeSwing, IsWrongBesideTheMotionOfAnotherMechanism) {
  const RandomLinkage linkage = random_linkage(kind_of(LinkageClass::kGrashof), 7);
  model::Mechanism heavier = linkage.ideal;
  heavier.bodies[0].mass = heavier.bodies[0].mass.constant() * (1 + 1e-4);
  const KnownMotion known = known_motion(heavier, linkage.size, kHalfASecond);
  EXPECT_EQ(judge(linkage, known, kHalfASecond).outcome, Outcome::kWrong);
}

TEST(FreeSwing, IsLeftOutWhereTheReferenceDoubtsItself) {
  const RandomLinkage linkage = random_linkage(kind_of(LinkageClass::kGrashof), 7);
  KnownMotion known = known_motion(linkage.ideal, linkage.size, kHalfASecond);
  known.doubt[2] = 2 * kAgreement;
  EXPECT_EQ(judge(linkage, known, kHalfASecond).outcome, Outcome::kLeftOut);
}

TEST(RandomLinkages, AreClosedAtTheStartUnlessPerturbed) {
  for_some(kSeedCount, [](const RandomLinkage& linkage) {
    const reference::DescriptorReference<long double> form(linkage.ideal);
    const LoopState start = reference::Reference<long double>(linkage.ideal).initial_state();
    const auto constraints = form.loop_constraints(0, start.y, start.z);
    EXPECT_LE(constraints.g.lpNorm<Eigen::Infinity>(), kClosedAtStart);
    EXPECT_LE(constraints.rate.lpNorm<Eigen::Infinity>(), kClosedAtStart * 10);
    EXPECT_GE(loop_freedom(constraints).motions.cols(), 1);
  });
}

TEST(RandomLinkages, AreTheSameForTheSameSeed) {
  const LinkageKind& kind = kind_of(LinkageClass::kWatt);
  EXPECT_EQ(to_toml(random_linkage(kind, 5).mechanism), to_toml(random_linkage(kind, 5).mechanism));
  EXPECT_NE(to_toml(random_linkage(kind, 5).mechanism), to_toml(random_linkage(kind, 6).mechanism));
}

}  // namespace
}  // namespace jourdain::tests
