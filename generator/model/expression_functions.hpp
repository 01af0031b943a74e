// The functions that an expression may call: what they are made of, and the dimensions that they ask for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"

namespace jourdain::model {

struct NamedFunction {
  enum class Dimensions {
    kRoot,    ///< sqrt(x)
    kAngle,   ///< of rad, a pure number
    kPure,    ///< of a pure number, one too
    kKept,    ///< of anything, the same
    kSign,    ///< of anything, a pure number
    kCommon,  ///< of arguments of one dimension, that one
    kRatio,   ///< of arguments of one dimension, a pure number
    kPower,   ///< pow(x, p)
  };
  std::string_view name;
  std::string_view arguments;  ///< as messages show them: "x, width"
  std::size_t count = 1;       ///< of arguments
  Dimensions dimensions = Dimensions::kPure;
  Expression (*of)(std::span<const Expression> arguments) = nullptr;
};

/// Nothing where there is no such function. `if` is none: it compares.
const NamedFunction* find_function(std::string_view name);

/// Means something in every expression: a function, `if`, `pi`, `deg`.
bool is_expression_word(std::string_view word);

/// sqrt, sin, …, if
std::vector<std::string> function_names();

/// x where a < b, otherwise y; both may be anything, not numbers too, where they are not taken. `or_equal`: a ≤ b.
Expression where_less(const Expression& a, const Expression& b, bool or_equal, const Expression& x,
                      const Expression& y);

/// x^p for real p.
Expression real_power(const Expression& base, const Expression& exponent);

/// Of a function of arguments of one dimension; not of a power.
Measure measure_of(NamedFunction::Dimensions dimensions, const Measure& argument);
/// Of x^p.
Measure measure_of_power(const Measure& base, const Expression& exponent, const Measure& of_exponent);

}  // namespace jourdain::model
