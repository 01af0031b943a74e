#include "model/expression.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace jourdain::model {
namespace {

const std::vector<DeclaredParameter> kNames{{"m", Measure::open()}, {"l", Measure::open()}};

Expression parsed(const std::string& text) {
  const auto result = parse_expression(text, kNames);
  if (const auto* error = std::get_if<ExpressionError>(&result))
    ADD_FAILURE() << text << ": " << error->message << " at " << error->offset;
  const auto* parsed = std::get_if<MeasuredExpression>(&result);
  return parsed ? parsed->expression : Expression();
}

double value(const std::string& text, double m = 2, double l = 3) {
  const std::vector<double> values{m, l};
  return parsed(text).evaluate<double>(values);
}

ExpressionError error_of(const std::string& text) {
  const auto result = parse_expression(text, kNames);
  EXPECT_TRUE(std::holds_alternative<ExpressionError>(result)) << text;
  const auto* error = std::get_if<ExpressionError>(&result);
  return error ? *error : ExpressionError{};
}

TEST(Expression, OfNestedTangentsIsRefusedBySize) {
  const auto tangents = [](int count) {
    std::string text = "m";
    for (int i = 0; i < count; ++i) text = "tan(" + text + ")";
    return text;
  };
  EXPECT_EQ(parsed(tangents(10)).nodes().size(), 1 + 3 * 10u);
  for (const int count : {19, 25, 60, 99})
    EXPECT_NE(error_of(tangents(count)).message.find("more than 1000000 operations"), std::string::npos)
        << count;
}

TEST(Expression, FollowsTheUsualPrecedence) {
  EXPECT_EQ(value("1 + 2*3"), 7);
  EXPECT_EQ(value("-2^2"), -4);
  EXPECT_EQ(value("2^3^2"), 512);
  EXPECT_EQ(value("2^-1"), 0.5);
  EXPECT_EQ(value("6/3/2"), 1);
  EXPECT_EQ(value("1 - 2 - 3"), -4);
  EXPECT_EQ(value("2*-3"), -6);
  EXPECT_EQ(value("m/3*l^2"), 2.0 / 3 * 9);
  EXPECT_EQ(value("(m + l)^2"), 25);
  EXPECT_EQ(value("9^0.5"), 3);
  EXPECT_EQ(value(" \t2\n+ .5e1 "), 7);
}

TEST(Expression, KnowsConstantsAndFunctions) {
  EXPECT_EQ(value("pi"), std::numbers::pi);
  EXPECT_EQ(value("180*deg"), std::numbers::pi);
  EXPECT_EQ(value("sqrt(16) + sin(0) + cos(0)"), 5);
  EXPECT_DOUBLE_EQ(value("tan(m)"), std::tan(2.0));
  EXPECT_DOUBLE_EQ(value("tan(2)"), std::tan(2.0));
}

TEST(Expression, FoldsWhatDependsOnNoParameter) {
  EXPECT_TRUE(parsed("2*3 + sqrt(4)").is_constant());
  EXPECT_FALSE(parsed("m + 1").is_constant());
  EXPECT_EQ(parsed("m*(1 + 2)").nodes().size(), 3u);
}

TEST(Expression, AppliesExactIdentities) {
  for (const char* text : {"m*1", "1*m", "m + 0", "0 + m", "m - 0", "m/1", "-(-m)", "m^1"})
    EXPECT_EQ(parsed(text).nodes().size(), 1u) << text;
  for (const char* text : {"0*m", "m*0", "0/m"}) EXPECT_TRUE(parsed(text).is_zero()) << text;
  EXPECT_EQ(parsed("m^0").constant(), 1);
  EXPECT_EQ(parsed("0 - m").nodes().back().op, Expression::Op::kNegate);
  EXPECT_EQ(value("-(-m + l)"), -1);
  EXPECT_EQ(value("-(-(m + l))"), 5);
}

TEST(Expression, EvaluatesInOtherArithmetic) {
  const std::vector<long double> values{2, 3};
  EXPECT_EQ(parsed("m*l^-2").evaluate<long double>(values), 2 * (1.0L / 9));
}

TEST(Expression, DoesNotGrowWithNestedTangents) {
  std::string text = "m";
  for (int i = 0; i < 10; ++i) text = "tan(" + text + ")";
  EXPECT_EQ(parsed(text).nodes().size(), 1u + 3 * 10);
}

TEST(ParseExpression, PointsToWhatIsWrong) {
  EXPECT_EQ(error_of("2*mm").offset, 2u);
  EXPECT_EQ(error_of("1 + )").offset, 4u);
  EXPECT_EQ(error_of("1/(m - m*1 + 0)/0").offset, 16u);
  EXPECT_EQ(error_of("m m").offset, 2u);
  EXPECT_EQ(error_of("").message, "expected a number or a name, found the end");
  EXPECT_EQ(error_of("3 & 4").message, "expected an operator, found '&'");
  EXPECT_EQ(error_of(".").message, "'.' is not a number");
  EXPECT_EQ(error_of("1e-999").message, "the number is out of the range of double precision");
}

TEST(ParseExpression, SuggestsNames) {
  const auto result = parse_expression("mas*2", {{"mass", Measure::open()}});
  EXPECT_EQ(std::get<ExpressionError>(result).hint, "did you mean 'mass'?");
}

TEST(ParseExpression, BoundsLengthAndDepth) {
  EXPECT_NE(error_of(std::string(1'000'000, '(')).message.find("longer than 2000"), std::string::npos);
  EXPECT_NE(error_of(std::string(1'900, '(')).message.find("nested deeper"), std::string::npos);
  EXPECT_NE(error_of(std::string(1'900, '-')).message.find("nested deeper"), std::string::npos);
  std::string powers = "2";
  for (int i = 0; i < 500; ++i) powers += "^1";
  EXPECT_NE(error_of(powers).message.find("nested deeper"), std::string::npos);
  std::string sum = "m";
  while (sum.size() < kMaximumExpressionLength - 2) sum += "+l";
  EXPECT_EQ(value(sum, 0, 1), (static_cast<double>(sum.size()) - 1) / 2);
}

}  // namespace
}  // namespace jourdain::model
