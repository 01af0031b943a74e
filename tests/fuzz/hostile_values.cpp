#include "fuzz/hostile_values.hpp"

#include <fmt/format.h>

#include <cmath>

namespace jourdain::tests {

namespace {

std::string operand(const std::vector<std::string>& names, Random& random) {
  static const std::vector<std::string> kWords = {"pi", "deg", "t", "1e-3", "2", "0.5", "0", "1"};
  if (random.chance(0.05)) return hostile_name(random);
  if (random.chance(0.05)) return hostile_number(random);
  if (!names.empty() && random.chance(0.5)) return one_of(names, random);
  return random.chance(0.3) ? any_number(random) : one_of(kWords, random);
}

/// What a slip of the hand makes of a text.
std::string slipped(std::string text, Random& random) {
  static const std::vector<std::string> kSlips = {"(",   ")", "+",  "**", "^",  ",", " ",   "<",   ".",
                                                  "sin", "e", "\t", "µ",  "\"", "=", "if(", "max("};
  const std::size_t at = random.below(text.size() + 1);
  if (random.chance(0.5)) return text.insert(at, one_of(kSlips, random));
  return at < text.size() ? text.erase(at, 1 + random.below(3)) : text;
}

std::string grown(const std::vector<std::string>& names, int depth, Random& random) {
  static const std::vector<std::string> kFunctions = {"sqrt", "sin",  "cos",  "tan",  "-",    "",
                                                      "exp",  "log",  "sinh", "cosh", "tanh", "asin",
                                                      "acos", "atan", "abs",  "sign", "floor"};
  static const std::vector<std::string> kOfTwo = {"atan2", "pow",        "min",         "max",
                                                  "mod",   "smooth_abs", "smooth_sign", "smooth_step"};
  static const std::vector<std::string> kOperators = {" + ", " - ", "*", "/"};
  static const std::vector<std::string> kExponents = {"2",  "3",   "-1", "0",   "0.5",
                                                      "64", "-64", "65", "1.5", "x"};
  if (depth == 0 || random.chance(0.2)) return operand(names, random);
  const std::string left = grown(names, depth - 1, random);
  if (random.chance(0.3)) return fmt::format("{}({})", one_of(kFunctions, random), left);
  if (random.chance(0.15))
    return fmt::format("{}({}, {})", one_of(kOfTwo, random), left, grown(names, depth - 1, random));
  if (random.chance(0.1))
    return fmt::format("if({} {} {}, {}, {})", left, random.chance(0.5) ? "<" : ">=", operand(names, random),
                       grown(names, depth - 1, random), grown(names, depth - 1, random));
  if (random.chance(0.15)) return fmt::format("({})^{}", left, one_of(kExponents, random));
  return fmt::format("({}{}{})", left, one_of(kOperators, random), grown(names, depth - 1, random));
}

}  // namespace

std::string hostile_number(Random& random) {
  static const std::vector<std::string> kNumbers = {"0",
                                                    "-0.0",
                                                    "-1",
                                                    "1",
                                                    "1e308",
                                                    "-1e308",
                                                    "1.7976931348623157e308",
                                                    "1e-308",
                                                    "2.2250738585072014e-308",
                                                    "5e-324",
                                                    "1e-320",
                                                    "nan",
                                                    "-nan",
                                                    "inf",
                                                    "-inf",
                                                    "+inf",
                                                    "9223372036854775807",
                                                    "-9223372036854775808",
                                                    "9223372036854775808",
                                                    "99999999999999999999999",
                                                    "0x7fffffff",
                                                    "0b101",
                                                    "0o17",
                                                    "1_000",
                                                    "1e400",
                                                    "1e-400",
                                                    "1e154",
                                                    "1e-154",
                                                    "1e100",
                                                    "1e-100",
                                                    "1e30",
                                                    "1e-30",
                                                    "1e17",
                                                    "1e9",
                                                    "1e-9",
                                                    "1.5707963267948966",
                                                    "1.5707963268",
                                                    "3.141592653589793",
                                                    "1e6",
                                                    "1e-6",
                                                    "4294967296",
                                                    "2147483648",
                                                    "007",
                                                    "1.",
                                                    ".5",
                                                    "1e",
                                                    "+1"};
  return one_of(kNumbers, random);
}

std::string any_number(Random& random) {
  if (random.chance(0.5)) return hostile_number(random);
  const double value = random.uniform(-1, 1) * std::pow(10, random.uniform(-3, 3));
  return random.chance(0.3) ? fmt::format("{:.1f}", value) : fmt::format("{}", value);
}

std::string hostile_name(Random& random) {
  static const std::vector<std::string> kNames = {"",
                                                  " ",
                                                  "world",
                                                  "t",
                                                  "pi",
                                                  "deg",
                                                  "sin",
                                                  "cos",
                                                  "sqrt",
                                                  "tan",
                                                  "class",
                                                  "int",
                                                  "double",
                                                  "float",
                                                  "template",
                                                  "operator",
                                                  "namespace",
                                                  "and",
                                                  "xor",
                                                  "NULL",
                                                  "INFINITY",
                                                  "NAN",
                                                  "EOF",
                                                  "true",
                                                  "errno",
                                                  "main",
                                                  "std",
                                                  "jourdain",
                                                  "Model",
                                                  "State",
                                                  "Parameters",
                                                  "Outputs",
                                                  "Real",
                                                  "Time",
                                                  "model",
                                                  "state",
                                                  "input",
                                                  "parameters",
                                                  "zdot",
                                                  "tau",
                                                  "h",
                                                  "y",
                                                  "z",
                                                  "M",
                                                  "k",
                                                  "q",
                                                  "y0",
                                                  "j1",
                                                  "jn",
                                                  "gamma",
                                                  "signgam",
                                                  "isnan",
                                                  "fabs",
                                                  "exp",
                                                  "div",
                                                  "rk4_step",
                                                  "_",
                                                  "__x",
                                                  "_X",
                                                  "x_",
                                                  "a__b",
                                                  "0",
                                                  "1a",
                                                  "a-b",
                                                  "a.b",
                                                  "a b",
                                                  "a\nb",
                                                  "a\tb",
                                                  std::string("a\0b", 3),
                                                  "\x1b[31m",
                                                  "µ",
                                                  "ä",
                                                  "名前",
                                                  "\xe2\x80\xae"
                                                  "x",
                                                  "e\xcc\x81",
                                                  "a;b",
                                                  "*/",
                                                  "//",
                                                  "\\",
                                                  "\\u0041",
                                                  "\"",
                                                  "'",
                                                  "%s%n",
                                                  "{}",
                                                  "@MODEL@",
                                                  "../x",
                                                  "/etc",
                                                  "-o",
                                                  "angle",
                                                  "first",
                                                  "x",
                                                  "y.z",
                                                  "hinge.rate",
                                                  "rate",
                                                  "initial_state",
                                                  "close_loops",
                                                  "u",
                                                  "n",
                                                  "_t",
                                                  "static_assert"};
  if (random.chance(0.06)) return std::string(1 + random.below(300), 'n');
  if (random.chance(0.02)) return std::string(100'000, 'n');
  return one_of(kNames, random);
}

std::string any_expression(const std::vector<std::string>& names, int depth, Random& random) {
  if (random.chance(0.01)) return std::string(1 + random.below(3000), '(');
  const std::string text = grown(names, depth, random);
  return random.chance(0.15) ? slipped(text, random) : text;
}

}  // namespace jourdain::tests
