// Kinks, jumps and poles of what is composed of smooth functions alone, as |x| = sqrt(x^2) and asin(sin(x)).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "model/expression.hpp"

namespace jourdain::model {

/// A part that may have no derivative, by what it needs.
struct HiddenKink {
  enum class Kind {
    kRoot,       ///< a root, or a power of at most 1, of what may be zero
    kQuotient,   ///< a divisor that may be zero
    kLogarithm,  ///< the logarithm of what may be zero
    kAngle       ///< the angle of a point that may pass behind the origin, or through it
  };
  Kind kind = Kind::kRoot;
  std::optional<double> time = {};  ///< s, about when; nothing where it does not follow from the time alone
};

/// The first part of the expression for which it cannot be proven by interval arithmetic, at these parameters, that
/// there is none for all times from 0 to 1e9 s and all values of states and inputs up to 1e30 in SI units. Of
/// coordinates, frames and arguments, which need not come to where there is one, only what is surely one: a root of a
/// square, or of what has one variable and is zero somewhere without ever being negative.
/// `states_are_given`: states are prescribed as the time is; otherwise they are as coordinates.
std::optional<HiddenKink> hidden_kink(const Expression& expression, std::span<const double> parameters,
                                      bool states_are_given);

/// "a root of what may be zero, near t = 1 s"
std::string in_words(const HiddenKink& kink);

/// What to write instead.
std::string hint_of(const HiddenKink& kink);

}  // namespace jourdain::model
