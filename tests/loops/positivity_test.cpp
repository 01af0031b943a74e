#include "loops/intervals/positivity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "loops/closed_form/scalar.hpp"

namespace jourdain::loops {
namespace {

using ir::LeafKind;
using support::Interval;

Region region(std::vector<Interval> sides) {
  Region result;
  for (std::size_t k = 0; k < sides.size(); ++k) result.entries.push_back({LeafKind::kPosition, k});
  result.leaves[LeafKind::kPosition] = std::move(sides);
  return result;
}

class Positivity : public ::testing::Test {
 protected:
  Scalar y(std::size_t k) { return {&builder_, builder_.leaf(LeafKind::kPosition, k)}; }

  std::variant<std::vector<double>, Counterexample> prove(const std::vector<Scalar>& values,
                                                          const Region& where, double least = 0) {
    std::vector<Bound> bounds;
    for (const Scalar& value : values) bounds.push_back({value.value, least});
    return prove_bounds(builder_, bounds, where);
  }

  ir::Builder builder_;
};

TEST_F(Positivity, IsProvenWithBoundsOfHalfTheLeastValueOrBetter) {
  const auto proof = prove({sine(y(0)) * sine(y(0)) + cosine(y(0)) * cosine(y(0)), 1.1 * y(1) - sine(y(0))},
                           region({{-4, 4}, {1, 2}}));
  const auto& bounds = std::get<std::vector<double>>(proof);
  EXPECT_GE(bounds[0], 0.5);
  EXPECT_LE(bounds[0], 1);
  EXPECT_GE(bounds[1], 0.05);
  EXPECT_LE(bounds[1], 0.1 + 1e-12);
}

TEST_F(Positivity, IsRefutedByAPoint) {
  const auto proof = prove({cosine(y(0)) + 0.9}, region({{-4, 4}}));
  const Counterexample& found = std::get<Counterexample>(proof);
  EXPECT_TRUE(found.violated);
  EXPECT_LE(std::cos(found.position[0]) + 0.9, 0);
}

TEST_F(Positivity, IsNotProvenWhereAValueTouchesZero) {
  const Scalar off = y(0) - 1.0 / 3;
  const auto proof = prove({off * off}, region({{0, 1}}));
  EXPECT_NEAR(std::get<Counterexample>(proof).position[0], 1.0 / 3, 1e-6);
}

TEST_F(Positivity, IsNotProvenOfWhatMayNotExist) {
  const auto root = prove({square_root(y(0)) + 1}, region({{-1, 1}}));
  EXPECT_TRUE(std::holds_alternative<Counterexample>(root));
  const Scalar two = {&builder_, builder_.literal(2)};
  const auto quotient = prove({two - y(0) / (y(0) * y(0))}, region({{-2, -1}, {0, 0}}));
  EXPECT_TRUE(std::holds_alternative<std::vector<double>>(quotient));
}

TEST_F(Positivity, IsProvenForParametersThatVary) {
  const Scalar length = {&builder_, builder_.leaf(LeafKind::kParameter, 0)};
  Region where = region({{-4, 4}});
  where.entries.push_back({LeafKind::kParameter, 0});
  where.leaves[LeafKind::kParameter] = {{1.1, 2}};
  const auto proof = prove({length - sine(y(0))}, where);
  EXPECT_NEAR(std::get<std::vector<double>>(proof)[0], 0.075, 0.026);
  where.leaves[LeafKind::kParameter] = {{0.9, 2}};
  EXPECT_LT(std::get<Counterexample>(prove({length - sine(y(0))}, where)).position[1], 1.001);
}

TEST_F(Positivity, NeedsNoRegionForConstants) {
  const Scalar two = {&builder_, builder_.literal(2)};
  EXPECT_EQ(std::get<std::vector<double>>(prove({two}, {})), std::vector<double>{2});
  EXPECT_TRUE(std::holds_alternative<Counterexample>(prove({-two}, {})));
}

}  // namespace
}  // namespace jourdain::loops
