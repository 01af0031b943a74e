// What is refused and what is not: differences of algebra, whatever the size of the numbers, and never those
// of rounding.
#include "validate/agreement.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace jourdain::validate {
namespace {

bool agree(const ScaledReal& a, const ScaledReal& b) {
  Agreement agreement;
  agreement.same("f", "an oracle", {a}, {b});
  return agreement.failures().empty();
}

/// (x + y) − y, of which little is left where y is large.
ScaledReal cancelled(double x, double y) { return (ScaledReal(x) + ScaledReal(y)) - ScaledReal(y); }

TEST(Agreement, AllowsWhatCancellationLosesIn77Digits) {
  const ScaledReal third = ScaledReal(1) / ScaledReal(3), large = ScaledReal(1e30);
  EXPECT_TRUE(agree((third + large) - large, third));
  EXPECT_TRUE(agree(cancelled(1e-300, 1e-280), 1e-300));
}

TEST(Agreement, RefusesASmallTermThatIsMissingInAnyUnits) {
  for (const double unit : {1e-250, 1e-12, 1.0, 1e24, 1e250}) {
    const ScaledReal whole = ScaledReal(unit), part = whole * (ScaledReal(1) - ScaledReal(1e-39));
    EXPECT_FALSE(agree(part, whole)) << unit;
    EXPECT_TRUE(agree(whole, whole)) << unit;
  }
}

TEST(Agreement, OfZeroWithWhatIsNotTakesItsScale) {
  EXPECT_TRUE(agree(cancelled(0, 9.81), 0));
  EXPECT_FALSE(agree(ScaledReal(1e-20), cancelled(0, 9.81)));
}

TEST(Agreement, OfZeroThroughoutTakesTheScaleOfTheStatesBefore) {
  const ScaledReal left(1e-76);  // of constants that cancel
  EXPECT_FALSE(agree(left, 0));
  Agreement agreement;
  agreement.same("f", "an oracle", {1.0}, {1.0});
  agreement.same("f", "an oracle", {left}, {0});
  agreement.rounded("f", "an oracle", {std::ldexp(1.0, -51)}, {ScaledReal().with_scale(4)}, {0}, 9);
  agreement.rounded("f", "an oracle", {0}, {1e-65}, {left}, 9);
  EXPECT_TRUE(agreement.failures().empty());
  agreement.same("f", "an oracle", {1e-29}, {0});
  EXPECT_FALSE(agreement.failures().empty());
}

TEST(Agreement, NumbersThatDoNotExistAgreeWithEachOtherAlone) {
  const ScaledReal none = ScaledReal(1) / ScaledReal(0);
  EXPECT_FALSE(none.is_number());
  EXPECT_TRUE(agree(none, sqrt(ScaledReal(-1))));
  EXPECT_FALSE(agree(none, 1));
}

/// Constants of that size have few digits in double; what is one there and not here is no such number.
TEST(Agreement, NumbersBelowDoublesAgree) {
  EXPECT_TRUE(agree(ScaledReal(3.60668e-321), ScaledReal(3.60174e-321)));
  EXPECT_FALSE(agree(ScaledReal(3.60668e-321), ScaledReal(3.60174e-300)));
  EXPECT_FALSE(agree(ScaledReal(3.60668e-300), ScaledReal(3.60174e-300)));
}

TEST(Agreement, RoundingIsRefusedBeyondTheDepthOfTheProgram) {
  const auto refused = [](double value, std::size_t depth) {
    Agreement agreement;
    agreement.rounded("f", "an oracle", {value}, {1.0}, {1.0}, depth);
    return !agreement.failures().empty();
  };
  const double unit = std::ldexp(1.0, -53);
  EXPECT_FALSE(refused(1 + 600 * unit, 9));
  EXPECT_TRUE(refused(1 + 700 * unit, 9));
  EXPECT_FALSE(refused(1 + 700 * unit, 20));
  EXPECT_TRUE(refused(NAN, 20));
}

TEST(Agreement, RoundingCountsByTheProgramsOwnScaleUpToTenThousandTimesTheOracles) {
  const auto refused = [](double error, long double own) {
    Agreement agreement;
    agreement.rounded("f", "an oracle", {error, 1.0}, {ScaledReal().with_scale(own), 1.0},
                      {ScaledReal(), 1.0}, 9);
    return !agreement.failures().empty();
  };
  const double limit = 640 * std::ldexp(1.0, -53);
  EXPECT_FALSE(refused(0.9e3 * limit, 1e3L));
  EXPECT_TRUE(refused(1.1e3 * limit, 1e3L));
  EXPECT_FALSE(refused(0.9e4 * limit, 1e9L));
  EXPECT_TRUE(refused(1.1e4 * limit, 1e9L));
  // A product of two zeros is off by rounding to second order.
  EXPECT_FALSE(refused(std::ldexp(1.0, -106), 0));
  EXPECT_TRUE(refused(1e-20, 0));
}

TEST(ScaledReal, ScalesFollowTheRulesOfCalculus) {
  const ScaledReal y = 1e-3;
  EXPECT_NEAR(static_cast<double>(sin(y).scale()), 1e-3, 1e-8);
  EXPECT_NEAR(static_cast<double>(cancelled(1, 1e6).scale()), 1e6 + 1, 1);
  EXPECT_NEAR(static_cast<double>((ScaledReal(2) / cancelled(1, 1e6)).scale()), 2e6, 1e2);
}

}  // namespace
}  // namespace jourdain::validate
