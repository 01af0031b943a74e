// Kinks, jumps and poles of what is composed of smooth functions alone, as |x| = sqrt(x^2) and asin(sin(x)).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "model/expression.hpp"
#include "model/expression_ranges.hpp"

namespace jourdain::model {

/// A part that may have no derivative, by what it needs.
struct HiddenKink {
  enum class Kind {
    kRoot,       ///< a root, or a power of less than 2, of what may be zero
    kQuotient,   ///< a divisor that may be zero
    kLogarithm,  ///< the logarithm of what may be zero
    kAngle       ///< the angle of a point that may pass behind the origin, or through it
  };
  Kind kind = Kind::kRoot;
  std::optional<double> time = {};  ///< s, about when; nothing where it does not follow from the time alone
};

/// The first part of the expression for which it cannot be proven by interval arithmetic, at these parameters, that
/// there is none for all times from 0 to 1e9 s, or up to where roots and logarithms of the time have no value any more,
/// and all values of states and inputs up to 1e30 in SI units. Of
/// coordinates, frames and arguments, which need not come to where there is one, only what is surely one: a root of a
/// square; of what has one variable a root, or a logarithm, of what touches zero, an angle that passes π, and a pole
/// that what follows from it hides.
std::optional<HiddenKink> hidden_kink(const Expression& expression, std::span<const double> parameters);

/// As wide as any proof here asks: of the time from 0 to 1e9 s, of what else moves up to 1e30 in SI units.
support::Interval widest_range(const Variable& variable);

/// The first part that may have no value, or no derivative, somewhere in these ranges: a quotient, a logarithm or,
/// where roots are asked for, a root.
std::optional<HiddenKink> undefined_part(const Expression& expression, const ExpressionRanges& ranges,
                                         bool with_roots);

/// "a root of what may be zero, near t = 1 s"
std::string in_words(const HiddenKink& kink);

/// What to write instead.
std::string hint_of(const HiddenKink& kink);

}  // namespace jourdain::model
