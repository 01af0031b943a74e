// Rows of a constraint as polynomials in what a block of it determines.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "loops/scalar.hpp"

namespace jourdain::loops {

/// Powers of cos, sin and the plain value of two unknown coordinates: c₀, s₀, v₀, c₁, s₁, v₁. Of s at most the first: s² is 1 − c².
using Monomial = std::array<int, 6>;

inline constexpr Monomial kConstant{};
constexpr Monomial power(std::size_t variable) {
  Monomial monomial{};
  monomial[variable] = 1;
  return monomial;
}
constexpr Monomial cos_of(std::size_t unknown) { return power(3 * unknown); }
constexpr Monomial sin_of(std::size_t unknown) { return power(3 * unknown + 1); }
constexpr Monomial value_of(std::size_t unknown) { return power(3 * unknown + 2); }
constexpr Monomial operator*(Monomial a, const Monomial& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

/// Coefficients, which depend on everything but the unknowns; absent ones are 0.
using Polynomial = std::map<Monomial, Scalar>;

/// A dependent coordinate that is found already.
struct Known {
  Scalar value;
  std::optional<Vector2> direction;  ///< (cos, sin) of it, where it was found as that
};

/// Does the polynomial depend on that unknown?
bool depends_on(const Polynomial& row, std::size_t unknown);

/// The polynomial once one of its unknowns is found; the other becomes the first.
Polynomial substituted(const Polynomial& row, std::size_t unknown, const Known& found);

/// What the coordinates of a constraint are to a block of it.
struct Roles {
  std::vector<std::size_t> unknowns;   ///< entries of y, two at most
  std::map<std::size_t, Known> known;  ///< by entry of y
  std::set<std::size_t> later;         ///< entries of y that later blocks determine
  std::vector<std::string> names;      ///< of the entries of y, for messages
};

/// The outputs ("g", row) of `g` for each of `rows`, in the builder's values; sines and cosines of sums with dependent coordinates
/// are split by the addition theorem. Otherwise why a row is no such polynomial, a phrase for the user.
std::variant<std::vector<Polynomial>, std::string> polynomials_of(ir::Builder& builder, const ir::Program& g,
                                                                  const std::vector<std::size_t>& rows,
                                                                  const Roles& roles);

}  // namespace jourdain::loops
