// Functions beside arithmetic, roots, sines and cosines, in expressions, symbols and programs alike.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "support/called_function.hpp"
#include "support/check.hpp"
#include "support/constant_array.hpp"

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
  kMin,               ///< b < a ? b : a
  kMax,               ///< a < b ? b : a
  kWhereNegative,     ///< a < 0 ? b : 0, whatever b is where it is not taken, not a number too
  kWhereNotNegative,  ///< a < 0 ? 0 : b, likewise
  kEntry,  ///< entry a, rounded down, of the array whose number is b, a constant; that at the end where a is beyond it
  kArgument,  ///< arguments of a call: a behind those that b is made of, or behind none where b is no such
  kCall  ///< of the function whose number is b, a constant, with the arguments a: see support/called_function.hpp
};
inline constexpr std::size_t kFunctions = 16;

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
                                                                          {"where_not_negative", 2, true},
                                                                          {"entry", 2, true},
                                                                          {"argument", 2},
                                                                          {"call", 2}}};

/// Stands for itself, whatever it is called with: a value of its own would be that of a stand-in.
constexpr bool is_opaque(Function function) {
  return function == Function::kArgument || function == Function::kCall;
}

constexpr const FunctionFacts& facts_of(Function function) {
  return kFunctionFacts[static_cast<std::size_t>(function)];
}

template <class Real>
Real number_in(double x) {
  if constexpr (requires(Real number) { number.value + number.value; })  // which carries more, here nothing
    return Real{number_in<decltype(Real::value)>(x)};
  else
    return Real(x);
}

/// The largest whole number up to x of 0 … most; 0 where there is none.
template <class Real>
std::uint32_t whole_part(const Real& x, std::uint32_t most) {
  std::uint32_t whole = 0;
  for (std::uint32_t step = std::bit_floor(most); step > 0; step /= 2)
    if (whole + step <= most && !(x < number_in<Real>(whole + step))) whole += step;
  return whole;
}

/// Entry a, rounded down, of the array with the number b; the first or last one where a is beyond them.
template <class Real>
Real entry_of(const Real& a, const Real& b) {
  const std::vector<double>& values = array_of(whole_part(b, kLargestArrayNumber));
  return number_in<Real>(values[whole_part(a, static_cast<std::uint32_t>(values.size() - 1))]);
}

inline const CalledFunction& called_by(double number) {
  return called_function(static_cast<std::uint32_t>(number));
}

/// Of what stands in for the function with the number b, or its derivative by s of order `more`.
template <class Real>
Real stand_in_of(const Real& s, const Real& b, std::size_t more) {
  using std::sin, std::cos;
  const CalledFunction& function = called_function(whole_part(b, kLargestArrayNumber));
  const Real at = s + number_in<Real>(phase_of_called(function));
  return stand_in<Real>(function, more, sin(at), cos(at), [](double x) { return number_in<Real>(x); });
}

template <std::floating_point Real>
Real finite_or_nan(Real x) {
  return std::isfinite(x) ? x : std::numeric_limits<Real>::quiet_NaN();
}

/// Whether what it is decided by is not a number, so that either side would be taken by chance.
template <std::floating_point Real>
bool is_undecided(Function function, const Real& a, const Real& b) {
  const bool compares = function == Function::kMin || function == Function::kMax;
  return std::isnan(a) || (compares && std::isnan(b));
}

/// Of functions with kinks, for any type with <, fabs and floor that is made from doubles, and whose Real{} is zero.
template <class Real>
Real value_with_kinks(Function function, const Real& a, const Real& b) {
  using std::fabs, std::floor;
  if constexpr (std::is_floating_point_v<Real>)
    if (is_undecided(function, a, b)) return std::numeric_limits<Real>::quiet_NaN();
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
    case Function::kEntry:
      return entry_of(a, b);
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
    case Function::kArgument:
      return a + number_in<Real>(kShareOfEarlierArguments) * b;
    case Function::kCall:
      return stand_in_of(a, b, 0);
    default:
      return value_with_kinks(function, a, b);
  }
}

}  // namespace jourdain::support
