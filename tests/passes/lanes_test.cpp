// Limbs that are alike, as lanes: what is found, and that values stay what they are.
#include "passes/lanes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "ir/builder.hpp"
#include "ir/verify.hpp"
#include "passes/random_program.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {
namespace {

using ir::Builder;
using ir::LeafKind;
using ir::Op;
using ir::Program;
using ir::Signed;
using support::ScaledReal;

constexpr LeastGain kAny = {0, 0};

LikeLimbs limbs_of(std::size_t count, std::size_t joints) {
  LikeLimbs limbs(count);
  for (std::size_t l = 0; l < count; ++l)
    for (std::size_t j = 0; j < joints; ++j) {
      limbs[l].push_back({LeafKind::kPosition, l * joints + j});
      limbs[l].push_back({LeafKind::kVelocity, l * joints + j});
    }
  return limbs;
}

template <class Real>
ir::LeafValues<Real> leaves() {
  ir::LeafValues<Real> values;
  std::mt19937 random(5);
  for (const LeafKind kind : {LeafKind::kPosition, LeafKind::kVelocity, LeafKind::kParameter})
    for (int i = 0; i < 64; ++i) values[kind].push_back(Real(double(random() % 2001) / 1000 - 1.0004));
  return values;
}

/// The same values to 60 digits, as many operations, nothing that is broken.
void expect_same(const Program& before, const Program& after) {
  ir::LeafCounts counts;
  for (const ir::Node& node : before.nodes)
    if (node.op == Op::kLeaf) counts[node.leaf] = std::max<std::size_t>(counts[node.leaf], node.index + 1);
  EXPECT_EQ(ir::defects(after, counts), std::vector<std::string>());
  EXPECT_EQ(ir::count_operations(after).arithmetic(), ir::count_operations(before).arithmetic());
  ASSERT_EQ(after.outputs.size(), before.outputs.size());
  const auto expected = ir::interpret(before, leaves<ScaledReal>()),
             actual = ir::interpret(after, leaves<ScaledReal>());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(after.outputs[i].name, before.outputs[i].name);
    const ScaledReal difference = actual[i] - expected[i];
    EXPECT_LE(std::fabs(static_cast<double>(difference)), 1e-60 * double(difference.scale())) << i;
  }
}

/// A limb of two joints: of joint angles a, b and rates, mirrored where `side` is −1. Sums take their terms in an order
/// that depends on the limb.
Signed limb(Builder& builder, std::size_t l, double side, double length, std::mt19937& random) {
  const auto leaf = [&](LeafKind kind, std::size_t joint) { return builder.leaf(kind, 2 * l + joint); };
  const auto number = [&](double value) { return builder.literal(value); };
  const auto sum = [&](std::vector<Signed> terms) {
    std::shuffle(terms.begin(), terms.end(), random);
    Signed result = terms[0];
    for (std::size_t i = 1; i < terms.size(); ++i) result = builder.add(result, terms[i]);
    return result;
  };
  const Signed s = builder.unary(Op::kSin, leaf(LeafKind::kPosition, 0)),
               c = builder.unary(Op::kCos, leaf(LeafKind::kPosition, 0)), w = leaf(LeafKind::kVelocity, 0),
               v = leaf(LeafKind::kVelocity, 1), b = leaf(LeafKind::kPosition, 1);
  const Signed y = builder.multiply(s, number(side * length)), x = builder.multiply(c, number(length));
  const Signed t = builder.multiply(sum({y, builder.multiply(number(side * 0.3), b), number(side * 0.7)}), w);
  const Signed u = sum({builder.multiply(t, s), builder.multiply(x, v), builder.multiply(x, x)});
  return builder.divide(sum({u, builder.multiply(t, number(side * 1.1)), number(0.2)}), sum({x, number(9)}));
}

Program limbs_program(std::size_t count, std::uint64_t seed) {
  std::mt19937 random(seed);
  Builder builder;
  Signed total = builder.leaf(LeafKind::kParameter, 0);
  for (std::size_t l = 0; l < count; ++l) {
    const Signed force = limb(builder, l, l % 2 == 0 ? 1 : -1, 0.5 + 0.01 * double(random() % 7), random);
    builder.output("force", static_cast<int>(l), -1,
                   builder.multiply(force, builder.leaf(LeafKind::kParameter, 1)));
    total = builder.add(total, force);
  }
  builder.output("total", -1, -1, total);
  return builder.finish("limbs");
}

TEST(Lanes, TakeMirroredLimbsWhole) {
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    for (const std::size_t count : {2u, 3u, 4u, 5u, 6u}) {
      const Program before = limbs_program(count, seed), after = in_lanes(before, {limbs_of(count, 2)}, kAny);
      expect_same(before, after);
      const std::size_t of_a_limb = (ir::count_operations(before).arithmetic() - count) / count;
      const std::size_t lanes = count % 4 == 1 ? count - 1 : count % 4 == 3 ? 2 : count;
      const std::size_t bundles = count == 6 ? 2 : 1;
      EXPECT_EQ(saved_by_lanes(after), (lanes - bundles) * of_a_limb) << count << " " << seed;
    }
}

/// Bundles are of one operation, next to each other, and no value stands in two of them.
TEST(Lanes, AreBundlesOfOneOperation) {
  const Program program = in_lanes(limbs_program(4, 1), {limbs_of(4, 2)}, kAny);
  std::set<std::size_t> seen;
  for (const std::vector<ir::ValueId>& bundle : program.lanes) {
    ASSERT_EQ(bundle.size(), 4u);
    for (std::size_t l = 0; l < bundle.size(); ++l) {
      EXPECT_EQ(bundle[l].value, bundle[0].value + l);
      EXPECT_EQ(program[bundle[l]].op, program[bundle[0]].op);
      EXPECT_TRUE(seen.insert(bundle[l].value).second);
    }
  }
}

/// What depends on the limb before has to wait for it.
TEST(Lanes, DoNotWaitForEachOther) {
  Builder builder;
  Signed carried = builder.leaf(LeafKind::kParameter, 0);
  for (std::size_t l = 0; l < 4; ++l) {
    const Signed x = builder.leaf(LeafKind::kPosition, l), v = builder.leaf(LeafKind::kVelocity, l);
    carried = builder.add(builder.multiply(builder.multiply(x, x), builder.multiply(v, builder.literal(1.5))),
                          builder.multiply(carried, x));
    builder.output("carried", static_cast<int>(l), -1, carried);
  }
  const Program before = builder.finish("chain"), after = in_lanes(before, {limbs_of(4, 1)}, kAny);
  expect_same(before, after);
  EXPECT_EQ(saved_by_lanes(after), 9u) << print(after);  // x², 1.5 v and their product
}

/// Each sum waits for that of the other limb: a thousand are given up.
TEST(Lanes, GiveUpManyThatWaitForEachOther) {
  constexpr std::size_t kSteps = 1000, kJoints = 8;
  Builder builder;
  Signed carried = builder.leaf(LeafKind::kParameter, 0);
  for (std::size_t step = 0; step < kSteps; ++step)
    for (std::size_t l = 0; l < 2; ++l) {
      const std::size_t joint = l * kJoints + step % kJoints;
      const Signed x = builder.leaf(LeafKind::kPosition, joint), v = builder.leaf(LeafKind::kVelocity, joint),
                   number = builder.literal(1.5 + double(step));
      carried = builder.add(builder.multiply(builder.multiply(x, x), builder.multiply(v, number)),
                            builder.multiply(carried, x));
    }
  builder.output("carried", -1, -1, carried);
  const Program before = builder.finish("chain"), after = in_lanes(before, {limbs_of(2, kJoints)}, kAny);
  expect_same(before, after);
  EXPECT_EQ(saved_by_lanes(after), 2 * kSteps + kJoints);  // numbers times v, these times x², and x²
}

/// Signs that no choice of lane 1 turns into those of lane 0: x a + y b and x a − y b, with a and b in a product too.
TEST(Lanes, LeaveWhatDiffersBySigns) {
  Builder builder;
  for (std::size_t l = 0; l < 2; ++l) {
    const Signed x = builder.leaf(LeafKind::kPosition, l), v = builder.leaf(LeafKind::kVelocity, l);
    const Signed a = builder.multiply(x, x), b = builder.multiply(v, v), ab = builder.multiply(a, b);
    builder.output("a", static_cast<int>(l), -1, builder.add(a, l == 0 ? b : -b));
    builder.output("b", static_cast<int>(l), -1,
                   builder.add(builder.multiply(ab, a), builder.multiply(ab, b)));
  }
  const Program before = builder.finish("signs"), after = in_lanes(before, {limbs_of(2, 1)}, kAny);
  expect_same(before, after);
  EXPECT_EQ(saved_by_lanes(after), 6u) << print(after);
}

/// Of each limb two products and a third that goes with other signs; all are added up, those of some limbs negative.
Program sum_over_limbs(const std::vector<bool>& negative, bool has_odd_signs) {
  Builder builder;
  Signed total = builder.leaf(LeafKind::kParameter, 0);
  for (std::size_t l = 0; l < negative.size(); ++l) {
    const auto leaf = [&](LeafKind kind, std::size_t joint) { return builder.leaf(kind, 2 * l + joint); };
    const Signed x = leaf(LeafKind::kPosition, 0), y = leaf(LeafKind::kPosition, 1),
                 v = leaf(LeafKind::kVelocity, 0), w = leaf(LeafKind::kVelocity, 1);
    const std::vector<Signed> terms = {builder.multiply(x, v), builder.multiply(y, w),
                                       builder.multiply(x, w)};
    for (std::size_t k = 0; k < terms.size(); ++k) {
      builder.output("term", static_cast<int>(l), static_cast<int>(k),
                     builder.multiply(terms[k], builder.leaf(LeafKind::kParameter, 1)));
      const bool sign = negative[l] != (has_odd_signs && k == 2 && l == 3);
      total = builder.add(total, sign ? -terms[k] : terms[k]);
    }
  }
  builder.output("total", -1, -1, total);
  return builder.finish("sum");
}

/// Products, and the sums of three of them: of four limbs three are saved of each operation.
TEST(Lanes, AddUpLimbByLimb) {
  for (const std::vector<bool>& negative : std::vector<std::vector<bool>>{
           {false, false, false, false}, {false, true, false, true}, {true, false, false, false}}) {
    const Program before = sum_over_limbs(negative, false), after = in_lanes(before, {limbs_of(4, 2)}, kAny);
    expect_same(before, after);
    EXPECT_EQ(saved_by_lanes(after), 3u * (6 + 2)) << print(after);
  }
}

/// Where a limb adds one of them with another sign, products take the sign: no operation is lost.
TEST(Lanes, AddUpWithSignsThatAreFree) {
  const Program before = sum_over_limbs({false, true, false, false}, true),
                after = in_lanes(before, {limbs_of(4, 2)}, kAny);
  expect_same(before, after);
  EXPECT_EQ(saved_by_lanes(after), 3u * (6 + 2)) << print(after);
}

TEST(Lanes, KeepValuesOfRandomPrograms) {
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Program before = remove_dead_code(tests::random_program(seed));
    for (const std::size_t joints : {1u, 2u}) {
      const Program after = in_lanes(before, {limbs_of(2, joints)}, kAny);
      expect_same(before, after);
      changed += !after.lanes.empty();
    }
  }
  EXPECT_GT(changed, 20u);
}

TEST(Lanes, LeaveProgramsThatGainLittle) {
  const Program before = limbs_program(2, 0), after = in_lanes(before, {limbs_of(2, 2)});
  EXPECT_EQ(print(after), print(before));
}

}  // namespace
}  // namespace jourdain::passes
