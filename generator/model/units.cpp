#include "model/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "support/diagnostics.hpp"

namespace jourdain::model {

namespace {

struct Symbol {
  std::string_view name;
  long double factor;
  Dimension dimension;
  std::string_view si;
};

constexpr long double kPi = 3.14159265358979323846264338327950288L;
constexpr Dimension kNone{}, kLength{1, 0, 0, 0}, kMass{0, 1, 0, 0}, kTime{0, 0, 1, 0}, kRate{0, 0, -1, 0},
    kForce{1, 1, -2, 0}, kMoment{2, 1, -2, 0}, kPower{2, 1, -3, 0}, kPressure{-1, 1, -2, 0},
    kCurrent{0, 0, 0, 1}, kVoltage{2, 1, -3, -1};

constexpr std::array kSymbols{Symbol{"m", 1, kLength, "m"},
                              Symbol{"km", 1e3L, kLength, "m"},
                              Symbol{"dm", 1e-1L, kLength, "m"},
                              Symbol{"cm", 1e-2L, kLength, "m"},
                              Symbol{"mm", 1e-3L, kLength, "m"},
                              Symbol{"um", 1e-6L, kLength, "m"},
                              Symbol{"µm", 1e-6L, kLength, "m"},
                              Symbol{"in", 0.0254L, kLength, "m"},
                              Symbol{"ft", 0.3048L, kLength, "m"},
                              Symbol{"kg", 1, kMass, "kg"},
                              Symbol{"g", 1e-3L, kMass, "kg"},
                              Symbol{"mg", 1e-6L, kMass, "kg"},
                              Symbol{"t", 1e3L, kMass, "kg"},
                              Symbol{"lb", 0.45359237L, kMass, "kg"},
                              Symbol{"s", 1, kTime, "s"},
                              Symbol{"ms", 1e-3L, kTime, "s"},
                              Symbol{"us", 1e-6L, kTime, "s"},
                              Symbol{"µs", 1e-6L, kTime, "s"},
                              Symbol{"min", 60, kTime, "s"},
                              Symbol{"h", 3600, kTime, "s"},
                              Symbol{"rad", 1, kNone, "rad"},
                              Symbol{"mrad", 1e-3L, kNone, "rad"},
                              Symbol{"deg", kPi / 180, kNone, "rad"},
                              Symbol{"°", kPi / 180, kNone, "rad"},
                              Symbol{"rev", 2 * kPi, kNone, "rad"},
                              Symbol{"rpm", kPi / 30, kRate, "rad/s"},
                              Symbol{"Hz", 1, kRate, "Hz"},
                              Symbol{"N", 1, kForce, "N"},
                              Symbol{"mN", 1e-3L, kForce, "N"},
                              Symbol{"kN", 1e3L, kForce, "N"},
                              Symbol{"MN", 1e6L, kForce, "N"},
                              Symbol{"lbf", 4.4482216152605L, kForce, "N"},
                              Symbol{"Nm", 1, kMoment, "Nm"},
                              Symbol{"mNm", 1e-3L, kMoment, "Nm"},
                              Symbol{"Nmm", 1e-3L, kMoment, "Nm"},
                              Symbol{"kNm", 1e3L, kMoment, "Nm"},
                              Symbol{"J", 1, kMoment, "J"},
                              Symbol{"kJ", 1e3L, kMoment, "J"},
                              Symbol{"W", 1, kPower, "W"},
                              Symbol{"kW", 1e3L, kPower, "W"},
                              Symbol{"Pa", 1, kPressure, "Pa"},
                              Symbol{"kPa", 1e3L, kPressure, "Pa"},
                              Symbol{"MPa", 1e6L, kPressure, "Pa"},
                              Symbol{"GPa", 1e9L, kPressure, "Pa"},
                              Symbol{"bar", 1e5L, kPressure, "Pa"},
                              Symbol{"A", 1, kCurrent, "A"},
                              Symbol{"mA", 1e-3L, kCurrent, "A"},
                              Symbol{"V", 1, kVoltage, "V"},
                              Symbol{"mV", 1e-3L, kVoltage, "V"},
                              Symbol{"%", 1e-2L, kNone, "1"},
                              Symbol{"1", 1, kNone, "1"}};

bool is_sensible(const Unit& unit) {
  constexpr int kLargest = 99;
  return std::isfinite(unit.factor) && unit.factor > 0 &&
         std::all_of(unit.dimension.begin(), unit.dimension.end(),
                     [](int exponent) { return std::abs(exponent) <= kLargest; });
}

/// A symbol's quotient in parentheses.
std::string as_factor(const std::string& si) {
  return si.starts_with('(') || si.find('/') == std::string::npos ? si : "(" + si + ")";
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Unit parse() {
    skip_blanks();
    if (at_end() || text_ == "-") return {};
    Unit unit = product(0);
    if (!at_end()) fail(position_, "')' without '('");
    return unit;
  }

 private:
  [[noreturn]] void fail(std::size_t offset, std::string message, std::string hint = "",
                         std::size_t length = 1) const {
    throw UnitError{offset, length, std::move(message), std::move(hint)};
  }
  bool at_end() const { return position_ == text_.size(); }
  void skip_blanks() {
    while (!at_end() && text_[position_] == ' ') ++position_;
  }
  bool accept(std::string_view token) {
    skip_blanks();
    if (text_.substr(position_, token.size()) != token) return false;
    position_ += token.size();
    skip_blanks();
    return true;
  }

  Unit product(int depth) {
    constexpr int kDeepest = 8;
    if (depth > kDeepest) fail(position_, "the unit's parentheses are nested too deep");
    Unit result = factor(depth);
    if (skip_blanks(), !at_end() && text_[position_] != ')') result.si = as_factor(result.si);
    for (bool divided = false; skip_blanks(), !at_end() && text_[position_] != ')';) {
      const bool divides = accept("/");
      const bool marked = !divides && (accept("*") || accept("·"));
      if (divided)
        fail(position_, "more follows after the unit's '/'",
             "put all that divides into one pair of parentheses: \"N/(m s)\"");
      divided = divides;
      const Unit next = factor(depth);
      const int sign = divides ? -1 : 1;
      result.factor = divides ? result.factor / next.factor : result.factor * next.factor;
      for (std::size_t i = 0; i < result.dimension.size(); ++i)
        result.dimension[i] += sign * next.dimension[i];
      if (!is_sensible(result)) fail(position_ - 1, "the unit's exponents are too large");
      result.si += (divides ? "/" : marked ? "*" : " ") + as_factor(next.si);
    }
    return result;
  }

  Unit factor(int depth) {
    skip_blanks();
    if (at_end()) fail(text_.empty() ? 0 : text_.size() - 1, "the unit ends too early");
    if (accept("(")) {
      Unit inside = product(depth + 1);
      if (!accept(")")) fail(position_ == 0 ? 0 : position_ - 1, "'(' without ')'");
      inside.si = "(" + inside.si + ")";
      return raised(std::move(inside));
    }
    return raised(symbol());
  }

  Unit symbol() {
    const std::size_t begin = position_;
    const auto ends = [](char c) { return std::string_view(" */^()").find(c) != std::string_view::npos; };
    while (!at_end() && !ends(text_[position_]) && text_.substr(position_, 2) != "·") ++position_;
    const std::string_view name = text_.substr(begin, position_ - begin);
    for (const Symbol& known : kSymbols)
      if (known.name == name) return {known.factor, known.dimension, std::string(known.si)};
    const std::vector<std::string_view> symbols = unit_symbols();
    const std::string near = support::nearest(name, std::vector<std::string>(symbols.begin(), symbols.end()));
    fail(begin, fmt::format("'{}' is not a unit", support::shown(name)),
         near.empty() ? "such as m, mm, kg, s, rad, deg, rpm, N, Nm, Hz, Pa" : fmt::format("'{}'?", near),
         std::max<std::size_t>(1, name.size()));
  }

  Unit raised(Unit base) {
    if (!accept("^")) return base;
    constexpr int kLargest = 9;
    int exponent = 0;
    const char *begin = text_.data() + position_, *end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(begin, end, exponent);
    if (error != std::errc() || std::abs(exponent) > kLargest || exponent == 0)
      fail(std::min(position_, text_.size() - 1), "a unit's exponent is a whole number from -9 to 9, not 0");
    position_ += static_cast<std::size_t>(stop - begin);
    base.factor = std::pow(base.factor, static_cast<long double>(exponent));
    for (int& entry : base.dimension) entry *= exponent;
    base.si = as_factor(base.si) + fmt::format("^{}", exponent);
    if (!is_sensible(base)) fail(position_ - 1, "the unit's exponents are too large");
    return base;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace

std::vector<std::string_view> unit_symbols() {
  std::vector<std::string_view> names;
  for (const Symbol& symbol : kSymbols) names.push_back(symbol.name);
  return names;
}

std::variant<Unit, UnitError> parse_unit(std::string_view text) {
  try {
    return Parser(text).parse();
  } catch (const UnitError& error) {
    return error;
  }
}

std::optional<std::pair<double, std::string>> split_quantity(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::size_t digit = text.starts_with('-') ? 1 : 0;
  if (digit >= text.size() || std::string_view("0123456789.").find(text[digit]) == std::string_view::npos)
    return {};
  double value = 0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(stop - begin));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.empty() || std::string_view("+-*/^().0123456789").find(text[0]) != std::string_view::npos)
    return {};
  return std::pair(value, std::string(text));
}

std::string unit_per_second(const std::string& unit) {
  if (unit.empty()) return "";
  if (unit == "-") return "1/s";
  if (unit.ends_with("/s")) return unit + "^2";
  return unit.find('/') == std::string::npos ? unit + "/s" : "(" + unit + ")/s";
}

double in_si(double value, const Unit& unit) {
  if (unit.factor == 1) return value;
  return static_cast<double>(static_cast<long double>(value) * unit.factor);
}

}  // namespace jourdain::model
