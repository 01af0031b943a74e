// Functions that are called by name and defined where emitted code is used: their numbers in expressions and programs.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace jourdain::support {

/// A function of the name `name`, or a partial derivative of one.
struct CalledFunction {
  std::string name;
  std::vector<std::string> arguments;
  double low = 1, high = 3;          ///< what stands in for the function is between these
  std::vector<std::size_t> by = {};  ///< the arguments that it is differentiated with respect to, rising

  /// "grip", "grip_slip", "grip_slip_load": as code that defines it is called.
  std::string member() const;
  bool operator==(const CalledFunction&) const = default;
};

/// The number of a function, which follows from what it is; where it is that of another one already, the next. It has
/// 24 binary digits, so that a float holds it. Any thread may ask.
std::uint32_t number_of_called(const CalledFunction& function);

/// The function that has this number. It stays where it is.
const CalledFunction& called_function(std::uint32_t number);

/// The number of its partial derivative by one more argument.
std::uint32_t number_of_slope(std::uint32_t number, std::size_t argument);

// What stands in for such functions wherever programs are compared: smooth ones that depend on all arguments and differ
// from each other. Arguments x0, x1, … xn become s = xn + kShare (… + kShare (x1 + kShare x0)); f lies between low and
// high as sin(s + phase) between −1 and 1, and partial derivatives are its.

inline constexpr double kShareOfEarlierArguments = 0.625;

/// Of the sine in the function's stand-in.
double phase_of_called(const CalledFunction& function);

/// A derivative of the stand-in by s, of order `more`, at s + phase with these sine and cosine. `number` makes a Real
/// of a double.
template <class Real, class Number>
Real stand_in(const CalledFunction& function, std::size_t more, const Real& sine, const Real& cosine,
              const Number& number) {
  const double half = 0.5 * function.high - 0.5 * function.low;
  const std::size_t order = function.by.size() + more;
  const Real wave = order % 4 == 0   ? sine
                    : order % 4 == 1 ? cosine
                    : order % 4 == 2 ? Real(-sine)
                                     : Real(-cosine);
  Real value = number(half) * wave;
  if (order == 0) return Real(number(function.low + half) + value);
  for (const std::size_t argument : function.by)
    for (std::size_t later = argument + 1; later < function.arguments.size(); ++later)
      value = Real(value * number(kShareOfEarlierArguments));
  return value;
}

}  // namespace jourdain::support
