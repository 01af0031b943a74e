// Functions beside arithmetic, roots, sines and cosines, in expressions, symbols and programs alike.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "support/check.hpp"

namespace jourdain::support {

enum class Function : std::uint8_t {
  kAtan2,  ///< atan2(a, b): the angle of (b, a), in (−π, π]
  kExp,
  kLog,
  kSinh,
  kCosh,
  kTanh,
  kPower,  ///< a^b; a ≥ 0, or b a whole number
  kAbs,
  kFloor,
  kMin,              ///< b < a ? b : a
  kMax,              ///< a < b ? b : a
  kWhereNegative,    ///< a < 0 ? b : 0, whatever b is where it is not taken, not a number too
  kWhereNotNegative  ///< a < 0 ? 0 : b, likewise
};
inline constexpr std::size_t kFunctions = 13;

struct FunctionFacts {
  std::string_view name;  ///< as it is printed
  int operands = 1;
  /// Value or derivative may jump at some arguments: where a sign changes, at whole numbers.
  bool has_kinks = false;
};

inline constexpr std::array<FunctionFacts, kFunctions> kFunctionFacts = {{{"atan2", 2},
                                                                          {"exp"},
                                                                          {"log"},
                                                                          {"sinh"},
                                                                          {"cosh"},
                                                                          {"tanh"},
                                                                          {"pow", 2},
                                                                          {"abs", 1, true},
                                                                          {"floor", 1, true},
                                                                          {"min", 2, true},
                                                                          {"max", 2, true},
                                                                          {"where_negative", 2, true},
                                                                          {"where_not_negative", 2, true}}};

constexpr const FunctionFacts& facts_of(Function function) {
  return kFunctionFacts[static_cast<std::size_t>(function)];
}

/// Of functions with kinks, for any type with <, fabs and floor whose Real{} is zero.
template <class Real>
Real value_with_kinks(Function function, const Real& a, const Real& b) {
  using std::fabs, std::floor;
  switch (function) {
    case Function::kAbs:
      return fabs(a);
    case Function::kFloor:
      return floor(a);
    case Function::kMin:
      return b < a ? b : a;
    case Function::kMax:
      return a < b ? b : a;
    case Function::kWhereNegative:
      return a < Real{} ? b : Real{};
    case Function::kWhereNotNegative:
      return a < Real{} ? Real{} : b;
    default:
      throw InternalError("a function without kinks");
  }
}

/// f(a, b), or f(a), of floating-point numbers, or numbers with functions of the same names in their namespace.
template <class Real>
Real value_of(Function function, const Real& a, const Real& b) {
  using std::atan2, std::cosh, std::exp, std::log, std::pow, std::sinh, std::tanh;
  switch (function) {
    case Function::kAtan2:
      return atan2(a, b);
    case Function::kExp:
      return exp(a);
    case Function::kLog:
      return log(a);
    case Function::kSinh:
      return sinh(a);
    case Function::kCosh:
      return cosh(a);
    case Function::kTanh:
      return tanh(a);
    case Function::kPower:
      return pow(a, b);
    default:
      return value_with_kinks(function, a, b);
  }
}

}  // namespace jourdain::support
