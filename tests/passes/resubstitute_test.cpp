// Values that are equal although they are written differently: what is found, and what must not be.
#include "passes/resubstitute.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ir/builder.hpp"
#include "ir/prime_field.hpp"
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
using tests::random_program;

constexpr std::uint64_t kPrograms = 300;

std::size_t operations(const Program& program) { return ir::count_operations(program).arithmetic(); }

/// A builder with some leaves: angles or lengths x, y, z, w.
struct Scene {
  Builder builder;
  Signed x = builder.leaf(LeafKind::kPosition, 0), y = builder.leaf(LeafKind::kPosition, 1),
         z = builder.leaf(LeafKind::kPosition, 2), w = builder.leaf(LeafKind::kPosition, 3);
  int outputs = 0;

  Signed times(Signed a, Signed b) { return builder.multiply(a, b); }
  Signed plus(Signed a, Signed b) { return builder.add(a, b); }
  Signed number(double value) { return builder.literal(value); }
  void give(Signed value) { builder.output("r", outputs++, -1, value); }
  Program finish() { return builder.finish("p"); }
};

ir::LeafValues<ScaledReal> exact_leaves() {
  ir::LeafValues<ScaledReal> leaves;
  leaves[LeafKind::kPosition] = {0.7, -1.3, 2.9, 0.1};
  leaves[LeafKind::kParameter] = {1.1, 0.6, -0.4};
  return leaves;
}

/// Are the results of both the same to 60 digits?
void expect_same_values(const Program& a, const Program& b) {
  const auto expected = ir::interpret(a, exact_leaves()), actual = ir::interpret(b, exact_leaves());
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const ScaledReal difference = actual[i] - expected[i];
    EXPECT_LE(std::fabs(static_cast<double>(difference)), 1e-60 * double(difference.scale())) << print(b);
  }
}

/// Resubstituted, with the same values and so many operations.
Program expect_operations(Scene& scene, std::size_t count) {
  const Program before = scene.finish(), after = resubstitute(before);
  EXPECT_EQ(operations(after), count) << print(after);
  expect_same_values(before, after);
  return after;
}

TEST(Resubstitute, FindsValuesThatAreWrittenDifferently) {
  Scene s;
  s.give(s.times(s.plus(s.x, s.y), s.plus(s.x, -s.y)));
  s.give(s.plus(s.times(s.x, s.x), -s.times(s.y, s.y)));
  const Program found = expect_operations(s, 3);
  EXPECT_EQ(found.outputs[0].value, found.outputs[1].value);
}

TEST(Resubstitute, FindsThemWithTheOtherSign) {
  Scene s;
  s.give(s.times(s.plus(s.x, -s.y), s.z));
  s.give(s.plus(s.times(s.y, s.z), -s.times(s.x, s.z)));
  expect_operations(s, 2);
}

TEST(Resubstitute, FindsSumsOfTwoValues) {
  Scene s;
  const Signed xy = s.times(s.x, s.y), xw = s.times(s.x, s.w);
  s.give(s.plus(xy, s.z));
  s.give(xw);
  s.give(s.plus(s.plus(xy, xw), s.z));
  expect_operations(s, 4);
}

TEST(Resubstitute, FindsProductsOfTwoValues) {
  Scene s;
  s.give(s.plus(s.x, s.y));
  s.give(s.plus(s.z, s.w));
  s.give(s.plus(s.times(s.x, s.plus(s.z, s.w)), s.plus(s.times(s.y, s.z), s.times(s.y, s.w))));
  expect_operations(s, 3);
}

TEST(Resubstitute, KnowsThatSquaresOfSineAndCosineAddUpToOne) {
  Scene s;
  const Signed sine = s.builder.unary(Op::kSin, s.x), cosine = s.builder.unary(Op::kCos, -s.x);
  s.give(s.times(s.y, s.plus(s.times(sine, sine), s.times(cosine, cosine))));
  expect_operations(s, 0);
}

TEST(Resubstitute, TellsNumbersApartThatAreTheSameInItsField) {
  constexpr double kSize = 0x1p61;
  Scene s;
  s.give(s.plus(s.x, s.number(kSize)));
  s.give(s.plus(s.x, s.number(kSize - double(ir::Residue::kPrime))));
  expect_operations(s, 2);
}

TEST(Resubstitute, TakesConstantsOut) {
  Scene s;
  const Signed product = s.times(s.x, s.y);
  s.give(product);
  s.give(s.times(s.times(s.x, s.number(0.1)), s.plus(s.times(s.y, s.number(0.3)), s.y)));  // 0.13 x y
  s.give(s.plus(s.plus(product, s.number(0.1)), s.number(0.7)));
  expect_operations(s, 3);
}

TEST(Resubstitute, FindsNumbers) {
  Scene s;
  const Signed sum = s.plus(s.x, s.y), square = s.times(sum, sum);
  const Signed mixed = s.times(s.number(2), s.times(s.x, s.y));
  const Signed zero = s.plus(s.plus(square, -mixed), -s.plus(s.times(s.x, s.x), s.times(s.y, s.y)));
  s.give(zero);
  s.give(s.plus(zero, s.number(0.1)));
  const Program found = expect_operations(s, 0);
  EXPECT_EQ(found[found.outputs[0].value].literal, 0);
  EXPECT_EQ(found[found.outputs[1].value].literal, 0.1);
}

TEST(Resubstitute, WritesTwiceAValueInOneWay) {
  Scene s;
  s.give(s.times(s.number(2), s.times(s.x, s.y)));
  s.give(s.plus(s.times(s.x, s.y), s.times(s.x, s.y)));
  expect_operations(s, 2);
}

// 0.1 + 0.2 is not 0.3, in double or as the fractions that these doubles are.
TEST(Resubstitute, LeavesWhatIsOnlyNearlyEqual) {
  Scene s;
  const Signed a = s.times(s.x, s.y), b = s.times(s.x, s.z);
  s.give(s.plus(s.times(a, s.number(0.1)), s.times(a, s.number(0.2))));
  s.give(s.times(a, s.number(0.3)));
  s.give(s.plus(s.times(b, s.number(0.1)), s.times(b, s.number(0.2))));
  const Program found = expect_operations(s, 5);
  EXPECT_NE(found.outputs[0].value, found.outputs[1].value);
}

// (x − y) z has all its digits where x and y are close; x z − y z has not.
TEST(Resubstitute, RefusesDifferencesThatCancel) {
  Scene s;
  s.give(s.times(s.x, s.z));
  s.give(s.times(s.y, s.z));
  s.give(s.times(s.plus(s.x, -s.y), s.z));
  expect_operations(s, 4);
}

// x y / y is x, but no number where y is 0.
TEST(Resubstitute, RefusesReciprocalsOfWhatMayBeZero) {
  Scene s;
  const Signed inverse = s.builder.divide(s.number(1), s.y), quotient = s.times(s.x, inverse);
  s.give(inverse);
  s.give(quotient);
  s.give(s.times(s.y, s.y));
  s.give(s.plus(s.times(s.plus(s.x, s.z), s.y), -s.times(s.z, s.y)));  // x / y times y y
  const Program after = resubstitute(s.finish());
  ir::LeafValues<double> leaves;
  leaves[LeafKind::kPosition] = {0.5, 0, 0.25, 0};
  EXPECT_EQ(ir::interpret(after, leaves)[3], 0) << print(after);
}

// A faulty pass would know that quaternions have unit length.
TEST(Resubstitute, DoesNotKnowTheLengthOfQuaternions) {
  Scene s;
  const Signed square =
      s.plus(s.plus(s.times(s.x, s.x), s.times(s.y, s.y)), s.plus(s.times(s.z, s.z), s.times(s.w, s.w)));
  s.give(s.times(s.x, square));
  s.give(s.times(s.y, square));
  expect_operations(s, 9);
}

// Or that a loop is closed: two bars that always end in the same point.
TEST(Resubstitute, DoesNotKnowThatLoopsAreClosed) {
  Scene s;
  const auto cosine = [&](Signed angle, double length) {
    return s.times(s.number(length), s.builder.unary(Op::kCos, angle));
  };
  const Signed gap = s.plus(s.plus(cosine(s.x, 0.3), cosine(s.y, 0.5)), -cosine(s.z, 0.7));
  s.give(s.times(s.w, gap));
  expect_operations(s, 6);
}

TEST(Resubstitute, TakesRootsAndAnglesForUnknownFunctions) {
  Scene s;
  const Signed square = s.times(s.x, s.x), root = s.builder.unary(Op::kSqrt, square);
  s.give(s.times(root, s.y));
  s.give(s.times(s.x, s.y));
  s.give(s.builder.atan2(s.times(s.x, s.z), s.times(s.y, s.z)));
  s.give(s.builder.atan2(s.x, s.y));
  expect_operations(s, 6);
}

TEST(Resubstitute, LeavesProgramsThatAlwaysDivideByZero) {
  Scene s;
  const Signed sum = s.plus(s.x, s.y), square = s.times(sum, sum);
  const Signed zero = s.plus(s.plus(square, -s.times(s.number(2), s.times(s.x, s.y))),
                             -s.plus(s.times(s.x, s.x), s.times(s.y, s.y)));
  s.give(s.builder.divide(s.z, zero));
  const Program program = s.finish();
  EXPECT_EQ(print(resubstitute(program)), print(remove_dead_code(program)));
}

// What parameters alone decide is computed with the model.
TEST(Resubstitute, PrefersOperationsOnParameters) {
  Scene s;
  const Signed p = s.builder.leaf(LeafKind::kParameter, 0), q = s.builder.leaf(LeafKind::kParameter, 1);
  const Signed fixed = s.plus(s.times(p, p), s.times(q, p));
  s.give(s.times(s.x, fixed));
  s.give(s.times(s.x, s.plus(p, q)));
  s.give(s.times(p, s.y));
  const Program before = s.finish(), after = resubstitute(before);
  EXPECT_EQ(print(after),
            print(remove_dead_code(before)));  // p times the second result would save two on parameters
}

TEST(Resubstitute, KeepsValuesOfRandomProgramsAndComesToRest) {
  std::size_t saved = 0;
  for (std::uint64_t seed = 0; seed < kPrograms; ++seed) {
    const Program before = remove_dead_code(random_program(seed)), after = resubstitute(before);
    ASSERT_LE(operations(after), operations(before)) << print(before);
    saved += operations(before) - operations(after);
    expect_same_values(before, after);
    EXPECT_EQ(print(resubstitute(after)), print(after)) << seed;
    EXPECT_EQ(print(resubstitute(before)), print(after)) << seed;
  }
  EXPECT_GT(saved, 0u);
}

}  // namespace
}  // namespace jourdain::passes
