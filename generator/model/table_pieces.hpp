// Polynomials between the points of a table, and what is beyond them.
#pragma once

#include <array>
#include <vector>

#include "model/composition.hpp"
#include "model/lookup_table.hpp"

namespace jourdain::model {

/// c_0 + d (c_1 + d (c_2 + d c_3))
using Cubic = std::array<double, 4>;

/// By Hermite's formula: values and slopes where d is 0 and where it is `width`.
inline Cubic cubic_of(double value, double slope, double next_value, double next_slope, double width) {
  const double chord = (next_value - value) / width, bend = (slope - 2 * chord + next_slope) / width;
  return {value, slope, (chord - slope) / width - bend, bend / width};
}

std::vector<double> constant_values(const LookupTable& table);

/// An argument within the points of an axis.
std::size_t clamped(Composition& make, std::size_t argument, std::span<const double> points);

/// Is a curve's value that of its argument held at the ends, but for straight lines?
bool is_held(const LookupTable& table);
/// Are there such lines? Straight pieces go on by themselves.
bool goes_on_straight(const LookupTable& table);

/// The value of a curve of cubics, which is `held` beyond the ends, going on straight there.
std::size_t with_straight_ends(Composition& make, std::size_t held, const LookupTable& table);

/// The value as polynomials whose coefficients are entries of arrays: see looked_up. Values are constant.
Expression by_entries(const LookupTable& table, std::span<const Expression> arguments);

}  // namespace jourdain::model
