// Derivatives of expressions, against derivatives that numbers carry through the same expression.
#include "model/expression_derivative.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/expression_sums.hpp"
#include "model/taylor.hpp"

namespace jourdain::model {
namespace {

constexpr Variable kX{.kind = Variable::Kind::kTime}, kY{.kind = Variable::Kind::kInput};
const std::vector<double> kParameters = {0.7};

Expression parsed(const std::string& text) {
  const Scope scope = {{"x", kX, Measure::open()}, {"y", kY, Measure::open()}};
  const auto result = parse_expression(text, {{"l", Measure::parameter("1")}}, scope);
  if (const auto* error = std::get_if<ExpressionError>(&result))
    ADD_FAILURE() << text << ": " << error->message;
  const auto* found = std::get_if<MeasuredExpression>(&result);
  return found ? found->expression : Expression();
}

double value(const Expression& expression, double x, double y) {
  return expression.evaluate<double>(
      kParameters, [](double v) { return v; }, [&](const Variable& v) { return v == kX ? x : y; });
}

TEST(ExpressionDerivative, OfEachFunctionIsThatOfNumbersThatCarryIt) {
  const char* kTexts[] = {"3",
                          "l*y",
                          "x",
                          "-x*x/(1 + y)",
                          "x^5 - l*x^-2",
                          "sqrt(x)*sin(x*y) + cos(l*x)",
                          "tan(x)",
                          "exp(x*y)",
                          "log(x)/l",
                          "sinh(x)",
                          "cosh(x)",
                          "tanh(x)",
                          "pow(x, 2.5)",
                          "x^y",
                          "pow(2, x)",
                          "atan2(x, y*x*x)",
                          "atan(x)",
                          "asin(x/3)",
                          "abs(-x)*x",
                          "min(x, x^2)",
                          "max(x, x^2)",
                          "floor(x)*x",
                          "mod(x, 0.8)",
                          "sign(x)*x^2",
                          "smooth_max(x, y, 0.1)",
                          "if(x > 1, x^3, sqrt(x))",
                          "if(x > 0, x, sqrt(-x))"};
  for (const std::string text : kTexts) {
    const Expression function = parsed(text), slope = derivative(function, kX);
    for (const double x : {0.55, 1.3}) {
      const std::vector<Taylor<double>> parameters = {{kParameters[0]}};
      const auto number = function.evaluate<Taylor<double>>(
          parameters, [](double v) { return Taylor<double>{v}; },
          [&](const Variable& v) {
            return v == kX ? Taylor<double>{x, 1, 0} : Taylor<double>{0.3};
          });
      EXPECT_NEAR(value(slope, x, 0.3), number.first, 1e-13 * (1 + std::fabs(number.first))) << text << x;
    }
  }
  EXPECT_TRUE(derivative(parsed("l*y + floor(x)"), kX).is_zero());
}

TEST(ExpressionDerivative, AlongRatesIsTheSumOfThoseByEachVariable) {
  const Expression function = parsed("x^2*y + sin(x*y)");
  const Expression rate =
      derivative(function, [](const Variable& v) { return v == kX ? parsed("3*y") : parsed("x - y"); });
  const double x = 0.4, y = -1.2, c = std::cos(x * y);
  EXPECT_NEAR(value(rate, x, y), (2 * x * y + y * c) * 3 * y + (x * x + x * c) * (x - y), 1e-14);
}

/// What is used twice stands once: otherwise this had 2^40 nodes.
TEST(Expression, OfWhatIsUsedTwiceStaysSmall) {
  Expression power = Expression::variable(kX);
  for (int i = 0; i < 40; ++i) power = times(plus(power, 1.0), power);
  EXPECT_EQ(power.nodes().size(), 82u);
  EXPECT_LE(derivative(power, kX).nodes().size(), 82u + 40 * 5);
  EXPECT_EQ(value(times(parsed("x + 1"), parsed("x + 1")), 2, 0), 9);
  EXPECT_EQ(times(parsed("x + 1"), parsed("x + 1")).nodes().size(), 4u);
}

}  // namespace
}  // namespace jourdain::model
