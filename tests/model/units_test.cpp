#include "model/units.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "model/read/read.hpp"
#include "support/files.hpp"

namespace jourdain::model {
namespace {

Unit unit(const std::string& text) {
  const auto result = parse_unit(text);
  if (const auto* error = std::get_if<UnitError>(&result)) ADD_FAILURE() << text << ": " << error->message;
  const auto* unit = std::get_if<Unit>(&result);
  return unit ? *unit : Unit();
}

TEST(Units, HaveTheirFactorsDimensionsAndSpellingsInSi) {
  struct Case {
    const char* text;
    double one;
    Dimension dimension;
    const char* si;
  };
  for (const Case& c : {Case{"", 1, {}, ""},
                        {"1", 1, {}, "1"},
                        {"-", 1, {}, ""},
                        {"mm", 1e-3, {1, 0, 0, 0}, "m"},
                        {"mm^2", 1e-6, {2, 0, 0, 0}, "m^2"},
                        {"1/s", 1, {0, 0, -1, 0}, "1/s"},
                        {"s^-1", 1, {0, 0, -1, 0}, "s^-1"},
                        {"rpm", std::numbers::pi / 30, {0, 0, -1, 0}, "rad/s"},
                        {"(rpm)", std::numbers::pi / 30, {0, 0, -1, 0}, "(rad/s)"},
                        {"rpm/rpm", 1, {}, "(rad/s)/(rad/s)"},
                        {"rpm^2", std::pow(std::numbers::pi / 30, 2), {0, 0, -2, 0}, "(rad/s)^2"},
                        {"N m/rpm", 30 / std::numbers::pi, {2, 1, -1, 0}, "N m/(rad/s)"},
                        {"deg", std::numbers::pi / 180, {}, "rad"},
                        {"N m s/rad", 1, {2, 1, -1, 0}, "N m s/rad"},
                        {"N*mm/deg", 0.18 / std::numbers::pi, {2, 1, -2, 0}, "N*m/rad"},
                        {"kg mm^2", 1e-6, {2, 1, 0, 0}, "kg m^2"},
                        {"kg/(m s^2)", 1, {-1, 1, -2, 0}, "kg/(m s^2)"},
                        {"m/(mm/s)^2", 1e6, {-1, 0, 2, 0}, "m/(m/s)^2"},
                        {"mNm/mA", 1, {2, 1, -2, -1}, "Nm/A"},
                        {"N·m", 1, {2, 1, -2, 0}, "N*m"},
                        {"V s/rad", 1, {2, 1, -2, -1}, "V s/rad"}}) {
    const Unit found = unit(c.text);
    EXPECT_DOUBLE_EQ(in_si(1, found), c.one) << c.text;
    EXPECT_EQ(found.dimension, c.dimension) << c.text;
    EXPECT_EQ(found.si, c.si) << c.text;
  }
  EXPECT_EQ(in_si(100, unit("mm")), 0.1);
  EXPECT_EQ(in_si(180, unit("deg")), std::numbers::pi);
}

TEST(Units, AreListedOnThePageOfExpressions) {
  const std::string page = support::read_file(JOURDAIN_SOURCE_DIR "/models/expressions.md");
  const std::size_t begin = page.find("    m km"), end = page.find("\n\n", begin);
  ASSERT_LT(begin, page.size());
  std::string list = page.substr(begin, end - begin);
  std::erase(list, ',');
  std::istringstream words(list);
  std::vector<std::string> listed;
  for (std::string word; words >> word;) listed.push_back(word);
  const std::vector<std::string_view> known = unit_symbols();
  EXPECT_EQ(listed, std::vector<std::string>(known.begin(), known.end()));
}

TEST(Units, AreRefusedAtThePlaceWhereTheyAreNone) {
  struct Case {
    const char* text;
    std::size_t offset;
    const char* message;
  };
  for (const Case& c : {Case{"banana", 0, "'banana' is not a unit"},
                        {"N fathom", 2, "'fathom' is not a unit"},
                        {"N/m s", 4, "more follows after the unit's '/'"},
                        {"N/m/s", 4, "more follows after the unit's '/'"},
                        {"N/", 1, "the unit ends too early"},
                        {"(N m", 3, "'(' without ')'"},
                        {"N)", 1, "')' without '('"},
                        {"m^x", 2, "a unit's exponent is a whole number from -9 to 9, not 0"},
                        {"m^0", 2, "a unit's exponent is a whole number from -9 to 9, not 0"},
                        {"m^99999999999", 2, "a unit's exponent is a whole number from -9 to 9, not 0"},
                        {"((m^9)^9)^9", 10, "the unit's exponents are too large"},
                        {"m**2", 2, "'' is not a unit"},
                        {"((((((((((m))))))))))", 9, "the unit's parentheses are nested too deep"}}) {
    const auto result = parse_unit(c.text);
    const auto* error = std::get_if<UnitError>(&result);
    ASSERT_TRUE(error) << c.text;
    EXPECT_EQ(error->message, c.message) << c.text;
    EXPECT_EQ(error->offset, c.offset) << c.text;
    EXPECT_LE(error->offset, std::string(c.text).size()) << c.text;
  }
}

TEST(Units, AreToldFromExpressions) {
  EXPECT_EQ(split_quantity("120 rpm"), std::pair(120.0, std::string("rpm")));
  EXPECT_EQ(split_quantity("-2.5e3 N/m"), std::pair(-2500.0, std::string("N/m")));
  EXPECT_EQ(split_quantity(" +30deg"), std::pair(30.0, std::string("deg")));
  EXPECT_EQ(split_quantity(".5  °"), std::pair(0.5, std::string("°")));
  for (const char* text : {"3 - 2", "3 * 2", "3*pi", "3", "pi", "3 ", "(3) m", "3 (2)", "1e999 m", "inf m",
                           "nan", "-inf m", "- 3 m", "", "+", "3 .5"})
    EXPECT_FALSE(split_quantity(text)) << text;
}

struct Read {
  std::vector<Parameter> parameters;
  std::string messages;
};

Read read(const std::string& parameters) {
  support::Diagnostics diagnostics("f",
                                   "[model]\nname = \"m\"\n[parameters]\n" + parameters +
                                       "[[body]]\nname = \"b\"\nmass = 1\n[[joint]]\nname = \"j\"\ntype = "
                                       "\"prismatic\"\nparent = \"world\"\nchild = \"b\"\n");
  auto mechanism = read_mechanism(diagnostics, {});
  return {mechanism ? mechanism->parameters : std::vector<Parameter>(), diagnostics.format()};
}

TEST(Units, OfParametersAreConverted) {
  const Read read_ = read(
      "a = { value = 100, unit = \"mm\", range = [10, 200] }\nb = \"120 rpm\"\nc = { value = \"30 deg\" }\n"
      "d = { value = 2, unit = \"N m\" }\n");
  EXPECT_EQ(read_.messages, "");
  ASSERT_EQ(read_.parameters.size(), 4u);
  EXPECT_EQ(read_.parameters[0].value, 0.1);
  EXPECT_EQ(read_.parameters[0].unit, "m");
  EXPECT_EQ((*read_.parameters[0].range)[0], 0.01);
  EXPECT_EQ((*read_.parameters[0].range)[1], 0.2);
  EXPECT_DOUBLE_EQ(read_.parameters[1].value, 4 * std::numbers::pi);
  EXPECT_EQ(read_.parameters[1].unit, "rad/s");
  EXPECT_DOUBLE_EQ(read_.parameters[2].value, std::numbers::pi / 6);
  EXPECT_EQ(read_.parameters[3].value, 2);
  EXPECT_EQ(read_.parameters[3].unit, "N m");
}

TEST(Units, OfRangesAreConvertedOneByOne) {
  const Read read_ = read("a = { value = 100, unit = \"mm\", range = [\"1 cm\", 200] }\n");
  EXPECT_EQ(read_.messages, "");
  ASSERT_EQ(read_.parameters.size(), 1u);
  EXPECT_EQ((*read_.parameters[0].range)[0], 0.01);
  EXPECT_EQ((*read_.parameters[0].range)[1], 0.2);
}

TEST(Units, AreSaidOnce) {
  EXPECT_EQ(read("a = { value = \"30*deg\", unit = \"rad\" }\n").messages, "");
  EXPECT_NE(read("a = { value = \"30*deg\", unit = \"deg\" }\n").messages.find("has two units"),
            std::string::npos);
}

TEST(Units, ThatAreNoneAreErrorsOfTheFile) {
  EXPECT_NE(
      read("a = { value = 1, unit = \"banana\" }\n").messages.find("f:4:26: error: 'banana' is not a unit"),
      std::string::npos);
  EXPECT_NE(read("a = \"3 furlong\"\n").messages.find("f:4:8: error: 'furlong' is not a unit"),
            std::string::npos);
  EXPECT_NE(read("a = { value = \"2 mm\", unit = \"m\" }\n").messages.find("has two units"),
            std::string::npos);
  EXPECT_NE(
      read("a = { value = 20, unit = \"mm\", range = [0.01, 0.03] }\n").messages.find("outside its range"),
      std::string::npos);
}

TEST(Units, ThatTakeAValueBeyondDoubleAreErrors) {
  EXPECT_NE(read("a = { value = 1e308, unit = \"km\" }\n").messages.find("is not finite"), std::string::npos);
  EXPECT_NE(read("a = \"1e308 km\"\n").messages.find("is not finite"), std::string::npos);
}

}  // namespace
}  // namespace jourdain::model
