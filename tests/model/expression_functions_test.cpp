// What functions of expressions are worth, how they are differentiated, and which dimensions they ask for.
#include "model/expression_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "model/taylor.hpp"

namespace jourdain::model {
namespace {

const Scope kScope = {{"x", {Variable::Kind::kTime}, Measure::open()},
                      {"y", {Variable::Kind::kInput}, Measure::open()}};

std::variant<MeasuredExpression, ExpressionError> parse(const std::string& text) {
  return parse_expression(text, {{"l", Measure::parameter("m")}, {"m", Measure::parameter("kg")}}, kScope);
}

Expression parsed(const std::string& text) {
  const auto result = parse(text);
  if (const auto* error = std::get_if<ExpressionError>(&result))
    ADD_FAILURE() << text << ": " << error->message;
  const auto* parsed = std::get_if<MeasuredExpression>(&result);
  return parsed ? parsed->expression : Expression();
}

template <class T>
T value(const std::string& text, const T& x, const T& y) {
  const std::vector<T> parameters(2);
  return parsed(text).evaluate<T>(
      parameters, [](double v) { return T{v}; },
      [&](const Variable& v) { return v.kind == Variable::Kind::kTime ? x : y; });
}

double at(const std::string& text, double x, double y = 0) { return value<double>(text, x, y); }

TEST(ExpressionFunctions, HaveTheValuesOfTheirNames) {
  for (const double x : {-2.5, -1.0, -0.3, 0.0, 0.4, 1.0, 3.5}) {
    EXPECT_EQ(at("exp(x)", x), std::exp(x));
    EXPECT_EQ(at("sinh(x)", x), std::sinh(x));
    EXPECT_EQ(at("cosh(x)", x), std::cosh(x));
    EXPECT_EQ(at("tanh(x)", x), std::tanh(x));
    EXPECT_EQ(at("log(x^2 + 1)", x), std::log(x * x + 1));
    EXPECT_EQ(at("pow(x^2 + 1, 1.5)", x), std::pow(x * x + 1, 1.5));
    EXPECT_EQ(at("(x^2 + 1)^y", x, 0.3), std::pow(x * x + 1, 0.3));
    EXPECT_EQ(at("pow(x, 3)", x), x * x * x);
    EXPECT_NEAR(at("atan(x)", x), std::atan(x), 2e-16);
    EXPECT_EQ(at("atan2(x, y)", x, -0.5), std::atan2(x, -0.5));
    EXPECT_EQ(at("abs(x)", x), std::fabs(x));
    EXPECT_EQ(at("floor(x)", x), std::floor(x));
    EXPECT_EQ(at("min(x, y)", x, 0.2), std::min(x, 0.2));
    EXPECT_EQ(at("max(x, y)", x, 0.2), std::max(x, 0.2));
    EXPECT_EQ(at("sign(x)", x), double(x > 0) - double(x < 0));
    EXPECT_NEAR(at("mod(x, y)", x, 0.7), x - 0.7 * std::floor(x / 0.7), 1e-15);
    EXPECT_EQ(at("smooth_abs(x, y)", x, 0.1), std::sqrt(x * x + 0.1 * 0.1));
    EXPECT_EQ(at("smooth_sign(x, y)", x, 0.1), x / std::sqrt(x * x + 0.1 * 0.1));
    EXPECT_NEAR(at("smooth_step(x, y)", x, 0.1), 0.5 + 0.5 * x / std::sqrt(x * x + 0.1 * 0.1), 1e-16);
    EXPECT_NEAR(at("smooth_max(x, 1, y)", x, 0.1), 0.5 * (x + 1 + std::hypot(x - 1, 0.1)), 1e-15);
    EXPECT_NEAR(at("smooth_min(x, 1, y)", x, 0.1), 0.5 * (x + 1 - std::hypot(x - 1, 0.1)), 1e-15);
  }
  for (const double x : {-1.0, -0.9999999, -0.5, 0.0, 1e-9, 0.7, 1.0}) {
    EXPECT_NEAR(at("asin(x)", x), std::asin(x), 3e-16);
    EXPECT_NEAR(at("acos(x)", x), std::acos(x), 5e-16);
  }
}

TEST(ExpressionFunctions, CompareAsTheySay) {
  for (const double x : {-1.0, 0.0, 1.0}) {
    EXPECT_EQ(at("if(x < 0, 2, 3)", x), x < 0 ? 2 : 3);
    EXPECT_EQ(at("if(x <= 0, 2, 3)", x), x <= 0 ? 2 : 3);
    EXPECT_EQ(at("if(x > 0, 2, 3)", x), x > 0 ? 2 : 3);
    EXPECT_EQ(at("if(x >= 0, 2, 3)", x), x >= 0 ? 2 : 3);
    EXPECT_EQ(at("if(x >= y, if(x > y, 1, 2), 3)", x, 0), x > 0 ? 1 : x == 0 ? 2 : 3);
    EXPECT_EQ(at("if(0 < 1, x, 1/(x - x))", x + 5), x + 5);
  }
}

TEST(ExpressionFunctions, TakeNothingFromTheOtherBranch) {
  EXPECT_EQ(at("if(x > 0, sqrt(x), 0)", -1), 0);
  EXPECT_EQ(at("if(x > 0, log(x), -x)", -3), 3);
  const auto moving = [](double x) { return Taylor<double>{x, 1, 0}; };
  const auto root = value<Taylor<double>>("if(x > 0, sqrt(x), 0)", moving(-1), {});
  EXPECT_EQ(root.value, 0);
  EXPECT_EQ(root.first, 0);
  EXPECT_EQ(root.second, 0);
}

/// Derivatives by one variable against differences, away from kinks.
TEST(ExpressionFunctions, AreDifferentiatedTwice) {
  const char* kTexts[] = {
      "exp(x*y)",    "log(x)",      "sinh(x)",          "cosh(x)",           "tanh(x)",
      "pow(x, 2.5)", "x^y",         "pow(2, x)",        "atan2(x, y*x*x)",   "atan(x)",
      "asin(x/3)",   "acos(x/3)",   "abs(-x)*x",        "min(x, x^2)",       "max(x, x^2)",
      "mod(x, 0.8)", "sign(x)*x^2", "smooth_abs(x, y)", "smooth_step(x, y)", "if(x > 1, x^3, x)"};
  constexpr double h = 1e-4;
  for (const std::string text : kTexts)
    for (const double x : {0.55, 1.3}) {
      const auto f = [&](double dx) { return value<long double>(text, x + dx, 0.3L); };
      const auto found = value<Taylor<double>>(text, {x, 1, 0}, {0.3});
      EXPECT_NEAR(found.value, double(f(0)), 1e-15 * (1 + std::fabs(found.value))) << text << " at " << x;
      EXPECT_NEAR(found.first, double((f(h) - f(-h)) / (2 * h)), 3e-7) << text << " at " << x;
      EXPECT_NEAR(found.second, double((f(h) - 2 * f(0) + f(-h)) / (h * h)), 2e-6) << text << " at " << x;
    }
}

TEST(ExpressionFunctions, DoNotGrowWhereTheyAreNested) {
  std::string text = "x";
  for (int i = 0; i < 40; ++i) text = "asin(" + text + ")";
  const auto result = parse(text);
  ASSERT_TRUE(std::holds_alternative<ExpressionError>(result));
  EXPECT_NE(std::get<ExpressionError>(result).message.find("more than 1000000 operations"),
            std::string::npos);
}

TEST(ExpressionFunctions, AreFoldedWhereEverythingIsKnown) {
  for (const char* text :
       {"exp(1)", "max(1, 2)", "if(1 < 2, 3, 4)", "asin(0.5)", "smooth_max(1, 2, 0.1)", "mod(7, 3)"})
    EXPECT_TRUE(parsed(text).is_constant()) << text;
  for (const char* text : {"if(1 < 2, x, y)", "if(1 <= 1, x, y)", "if(2 > 1, x, 0)", "if(1 < 1, y, x)"})
    EXPECT_TRUE(parsed(text).nodes().size() == 1 && at(text, 3, 4) == 3) << text;
}

TEST(ExpressionFunctions, KeepDimensions) {
  const auto unit = [](const std::string& text) {
    const auto result = parse(text);
    const auto* measured = std::get_if<MeasuredExpression>(&result);
    return measured ? measured->measure.unit() : std::get<ExpressionError>(result).message;
  };
  EXPECT_EQ(unit("abs(l)"), "m");
  EXPECT_EQ(unit("max(l, 2*l)*m"), "kg m");
  EXPECT_EQ(unit("if(m > 2*m, l, 3*l)"), "m");
  EXPECT_EQ(unit("smooth_max(l, l, l)"), "m");
  EXPECT_EQ(unit("pow(l, 1.5)"), "m^(3/2)");
  EXPECT_EQ(unit("atan2(l, l)"), "rad or 1");
  EXPECT_EQ(unit("smooth_step(l, l)"), "rad or 1");
  EXPECT_EQ(unit("atan2(l, m)"), "atan2 needs arguments of one unit, but 'l, m' are in m and kg");
  EXPECT_EQ(unit("tanh(m)"), "tanh needs a pure number, but 'm' is in kg");
}

}  // namespace
}  // namespace jourdain::model
