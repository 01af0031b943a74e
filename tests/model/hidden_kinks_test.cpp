#include "model/hidden_kinks.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jourdain::model {
namespace {

using Hidden = HiddenKink::Kind;

/// Of t, states p and r, an input u, coordinates x and y, and the parameters l = 0.3 and d = 0.09.
std::optional<HiddenKink> hidden_in(const std::string& text) {
  const std::vector<DeclaredParameter> names{{"l", Measure::open()}, {"d", Measure::open()}};
  const std::vector<double> values{0.3, 0.09};
  const Scope scope = {{"t", {.kind = Variable::Kind::kTime}, Measure::open()},
                       {"p", {.kind = Variable::Kind::kState, .index = 0}, Measure::open()},
                       {"r", {.kind = Variable::Kind::kState, .index = 1}, Measure::open()},
                       {"u", {.kind = Variable::Kind::kInput, .index = 0}, Measure::open()},
                       {"x", {.kind = Variable::Kind::kPosition, .index = 0}, Measure::open()},
                       {"y", {.kind = Variable::Kind::kPosition, .index = 1}, Measure::open()}};
  const auto result = parse_expression(text, names, scope);
  if (const auto* error = std::get_if<ExpressionError>(&result)) {
    ADD_FAILURE() << text << ": " << error->message;
    return {};
  }
  return hidden_kink(std::get<MeasuredExpression>(result).expression, values);
}

void expect_hidden(Hidden kind, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const std::optional<HiddenKink> kink = hidden_in(text);
    ASSERT_TRUE(kink) << text;
    EXPECT_EQ(kink->kind, kind) << text << ": " << in_words(*kink);
  }
}

void expect_smooth(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const std::optional<HiddenKink> kink = hidden_in(text);
    EXPECT_FALSE(kink) << text << ": " << in_words(*kink);
  }
}

TEST(HiddenKinks, OfTheTimeAreFound) {
  expect_hidden(Hidden::kRoot, {"sqrt((t - 1)^2)",
                                "((t - 1)^2)^0.5",
                                "pow((t - 1)^2, l)",
                                "asin(sin(t))",
                                "acos(cos(3*t))",
                                "0.1*asin(sin(3*t))",
                                "sqrt(1 - cos(t)^2)",
                                "sqrt(1 - sin(t))",
                                "sqrt(t^2 - 2*t + 1)",
                                "sqrt(t)",
                                "sqrt(d - (l*sin(t))^2)",
                                "sqrt(2*t - t^2)",
                                "sqrt((t - 1)*(t - 2))",
                                "sqrt((t - 1)^2 - 1e-12)",
                                "sqrt(t*t)",
                                "sqrt(2 - sin(t) - cos(t)*1.0001)*0 + sqrt(1 + sin(t))",
                                "sqrt((t - 1e6)^2)",
                                "((t - 0.5)^2)^1.2",
                                "t^1.5",
                                "sqrt(tanh(t - 3)^2)"});
  expect_hidden(Hidden::kQuotient,
                {"tan(t)", "1/(t - 2)", "1/sin(t)", "(2 - t)^-2", "1/(1 + cos(t))", "t/(t - 1e7)"});
  expect_hidden(Hidden::kAngle,
                {"atan2(sin(t), cos(t))", "atan2(l*sin(t), d + cos(t))", "atan2(t - 1, t - 2)"});
  expect_hidden(Hidden::kLogarithm, {"log(t)", "log(1 + sin(t))", "log((t - 1)^2)"});
}

TEST(HiddenKinks, OfWhatIsSmoothAtAllTimesAreNotSuspected) {
  expect_smooth({"sqrt(t + 1)",
                 "sqrt((t - 1)^2 + 1e-6)",
                 "sqrt(1 - (l*sin(t))^2)",
                 "l*cos(t) + sqrt(1 - l^2*sin(t)^2)",
                 "asin(l*sin(t))",
                 "acos(l*cos(t) + 0.1)",
                 "atan(t)",
                 "atan2(d*sin(t), l + d*cos(t))",
                 "1/(1 + t)",
                 "t/(1 + t)",
                 "asin(0.5*t/(1 + t))",
                 "log(1 + t)",
                 "1/(2 + sin(t))",
                 "tan(l*sin(t))",
                 "((t - 1)^2)^2.5",
                 "pow(1 + t^2, l)",
                 "sqrt(2.1 + sin(t) + cos(t)*1.0001)",
                 "sqrt(1 + t*exp(-t))",
                 "sqrt(d)",
                 "sqrt(l - l)",
                 "atan2(0, -l)",
                 "2^t",
                 "sqrt(t^2 - t + 1)",
                 "sinh(t)^3",
                 "smooth_step(t - 1, 0.1)",
                 "smooth_max(t, 1, 0.01)",
                 "smooth_sign(sin(t), 0.01)",
                 "t + atan2((l - 1)*sin(t)*cos(t), cos(t)^2 + l*sin(t)^2)"});
}

/// From then on there is no value, and no run goes on.
TEST(HiddenKinks, OfATimeAtWhichAMotionEndsAreNone) {
  expect_smooth({"sqrt(0.3 - t)", "asin(t)", "log(2 - t)", "(1 - t^3)^1.5"});
  expect_hidden(Hidden::kQuotient, {"1/(0.3 - t)"});
}

/// Anything that they are is said to be possible.
TEST(HiddenKinks, OfStatesAndInputsAreThoseOfAllTheirValuesWhereTheyAreGiven) {
  expect_hidden(Hidden::kRoot,
                {"sqrt(p^2)", "sqrt(p)", "sqrt(1 - p^2)", "sqrt(p^2 + r^2)", "asin(sin(p))", "sqrt(u)"});
  expect_hidden(Hidden::kAngle, {"atan2(sin(p), cos(p))", "atan2(p, r)"});
  expect_hidden(Hidden::kQuotient, {"1/p", "tan(p)", "t/(1 + u)"});
  expect_smooth(
      {"sqrt(p^2 + r^2 + l)", "atan(p)", "1/(1 + p^2)", "asin(l*sin(p + t))", "sqrt(p^2 - 2*p + 2)"});
}

/// They need not come to where there is one; where there is surely one, it is said.
TEST(HiddenKinks, OfCoordinatesAreRootsOfSquaresAndOfWhatTouchesZero) {
  expect_hidden(Hidden::kRoot, {"y - sqrt(x^2)", "y - sqrt((x - 1)*(x - 1))", "sqrt((x - y)^2)",
                                "sqrt(x^2*(1 + y^2))", "(x^2)^0.5", "sqrt(1 - cos(x)^2)", "asin(sin(x))",
                                "sqrt(1 - sin(x + y))", "sqrt(x^2/(1 + t))", "x + sqrt((t - 1)^2)"});
  expect_hidden(Hidden::kQuotient, {"x*tan(t)", "x/(t - 1)"});
  expect_smooth({"sqrt(x^2 + y^2) - l", "sqrt(l^2 - x^2)", "y - l*tan(x)", "atan2(y, x)", "y*log(x)", "1/x",
                 "asin(x)", "sqrt(x)", "sqrt(1 + x^2)", "pow(x^2, 2.5)", "sqrt(x^2 + t) - l",
                 "sqrt(x*(x - 1))", "atan2(x, 1 + x^2)", "atan2(l*sin(x), 1 + l*cos(x))", "acos(x)",
                 "tanh(x)/(2 - x)", "sin(x)/x"});
}

/// Of one variable wherever they are, however they are written.
TEST(HiddenKinks, OfOneCoordinateAreLookedFor) {
  expect_hidden(Hidden::kRoot,
                {"sqrt(x^2 - 2*x + 1)", "y - 0.1*sqrt(x^2 - 2*x + 1)", "sqrt(-(x - 1)*(1 - x))",
                 "sqrt((x - l)*(-l + x))", "sqrt(1 - 2*sin(x)*cos(x))", "sqrt(x^4 - 2*x^2 + 1)",
                 "sqrt(exp(x - l) + exp(l - x) - 2)", "(x^2)^1.5"});
  expect_hidden(Hidden::kLogarithm, {"exp(0.5*log((x - 1)^2))"});
  expect_hidden(Hidden::kAngle, {"atan2(sin(x), cos(x))", "y + atan2(x, x - 5)"});
  expect_hidden(Hidden::kQuotient, {"2*atan(tan(x/2))", "atan(1/(x - 1))", "y*tanh(1/x)"});
}

/// What is looked at near a pole is looked at again where the rest is judged.
TEST(HiddenKinks, BesideAVisiblePoleAreFound) {
  expect_smooth({"exp(1/(x - 2))"});
  expect_hidden(Hidden::kRoot, {"exp((x - 1)*(1/(x - 2))) + sqrt((x - 1)^2*(1 + y^2))"});
}

TEST(HiddenKinks, OfARepeatingTableAreThoseOfItsValues) {
  const auto wrapped = [](const std::string& inner) {
    const std::string within = "(t - 2*floor((t - 0.5)/2))", unit = "(t - floor(t))";
    return std::pair(inner + within, inner + unit);
  };
  for (const char* inner : {"1/(1 + ", "sqrt(0.1 + ", "log(0.2 + "}) {
    const auto [of_two, of_one] = wrapped(inner);
    EXPECT_FALSE(hidden_in(of_two + ")")) << of_two;
    EXPECT_FALSE(hidden_in(of_one + ")")) << of_one;
  }
  EXPECT_TRUE(hidden_in("1/(t - 2*floor((t - 0.5)/2) - 1)"));
  EXPECT_TRUE(hidden_in("sqrt(t - floor(t) - 0.5)"));
}

TEST(HiddenKinks, SayWhenTheTimeIsKnown) {
  EXPECT_EQ(in_words(*hidden_in("sqrt((t - 1)^2)")), "a root of what may be zero, near t = 1 s");
  EXPECT_EQ(in_words(*hidden_in("1/(t - 2.5)")), "a divisor may be zero, near t = 2.5 s");
  EXPECT_EQ(in_words(*hidden_in("asin(sin(t))")), "a root of what may be zero");
  EXPECT_FALSE(hint_of(*hidden_in("tan(t)")).empty());
}

}  // namespace
}  // namespace jourdain::model
