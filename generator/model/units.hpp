// Units of measurement as they stand in model files: "mm", "N m s/rad", "kg m^2", "rpm".
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace jourdain::model {

/// Exponents of m, kg, s, A; an angle has none.
using Dimension = std::array<int, 4>;

struct Unit {
  long double factor = 1;  ///< SI units in one of it
  Dimension dimension{};
  std::string si;  ///< the same with each symbol replaced by the SI unit of its kind
};

struct UnitError {
  std::size_t offset = 0, length = 1;  ///< of what is wrong
  std::string message, hint;
};

/// Symbols with exponents (m^2, s^-1), multiplied by blanks, '*' or '·', divided by '/'. Only one factor or a
/// pair of parentheses may follow a '/': what comes after that would be read one way by some and the other by
/// others. Empty, "1" and "-" are one.
std::variant<Unit, UnitError> parse_unit(std::string_view text);

/// All symbols, of one kind after the other.
std::vector<std::string_view> unit_symbols();

/// A number and the text after it, which is no operator ("120 rpm", "-2.5e3 N/m", "30deg"); nothing where the text is
/// not that.
std::optional<std::pair<double, std::string>> split_quantity(std::string_view text);

/// In SI units; computed in long double, infinite where that is beyond double.
double in_si(double value, const Unit& unit);

/// Of a rate: "rad/s" of "rad", "m/s^2" of "m/s", "(N/m)/s" of "N/m"; none where the unit is none.
std::string unit_per_second(const std::string& unit);

}  // namespace jourdain::model
