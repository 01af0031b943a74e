// Values of a program under construction at a few states near the initial one, to tell which form an equation has.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "loops/closed_form/scalar.hpp"
#include "support/scaled_real.hpp"

namespace jourdain::loops {

/// States that formulas are evaluated at; the first is the initial one. What holds at all of them to rounding
/// is taken to hold.
using Samples = std::vector<ir::LeafValues<double>>;

/// `count` states: the entries of y that `varied` marks and the time are off by up to 0.3, parameters with a
/// range by up to half of it, later ones by less.
Samples samples_near(const std::vector<double>& initial_y, const std::vector<bool>& varied,
                     const std::vector<double>& parameters,
                     const std::vector<std::optional<std::array<double, 2>>>& parameter_range,
                     std::size_t count);

/// By state, then by value. Values that do not exist at a state are not numbers.
std::vector<std::vector<double>> evaluated(const std::vector<Scalar>& values, const Samples& samples);

/// The same with 60 digits.
std::vector<std::vector<support::ScaledReal>> exactly_evaluated(const std::vector<Scalar>& values,
                                                                const Samples& samples);

/// The value at the initial state.
double initial(Scalar value, const Samples& samples);

/// Do the two agree, or is the one zero, at every state at which they exist, in units of `scale`?
bool agree(Scalar a, Scalar b, Scalar scale, const Samples& samples);
bool vanishes(Scalar a, Scalar scale, const Samples& samples);

}  // namespace jourdain::loops
