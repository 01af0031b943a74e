// Rows of a constraint as polynomials in what a block of it determines.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "loops/closed_form/scalar.hpp"

namespace jourdain::loops {

/// Scalar coordinates that a block determines at most; beside them a rotation in space.
inline constexpr std::size_t kScalars = 3;

/// Powers of cos, sin and the plain value of each unknown scalar, c₀, s₀, v₀, c₁ …, of which sin occurs once
/// at most: s² is 1 − c²; of the entries w x y z of an unknown quaternion, and of those of its rotation matrix
/// R, row by row.
using Monomial = std::array<int, 3 * kScalars + 4 + 9>;

inline constexpr Monomial kConstant{};
constexpr Monomial power(std::size_t variable) {
  Monomial monomial{};
  monomial[variable] = 1;
  return monomial;
}
constexpr Monomial cos_of(std::size_t unknown) { return power(3 * unknown); }
constexpr Monomial sin_of(std::size_t unknown) { return power(3 * unknown + 1); }
constexpr Monomial value_of(std::size_t unknown) { return power(3 * unknown + 2); }
constexpr Monomial quaternion_entry(std::size_t k) { return power(3 * kScalars + k); }
constexpr Monomial rotation_entry(std::size_t i, std::size_t j) {
  return power(3 * kScalars + 4 + 3 * i + j);
}
constexpr int rotation_power(const Monomial& powers, std::size_t i, std::size_t j) {
  return powers[3 * kScalars + 4 + 3 * i + j];
}
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

/// The polynomial once one of its unknowns is found; those after it move up.
Polynomial substituted(const Polynomial& row, std::size_t unknown, const Known& found);

/// What the coordinates of a constraint are to a block of it.
struct Roles {
  std::vector<std::size_t> unknowns;         ///< entries of y, kScalars at most
  std::optional<std::size_t> rotation = {};  ///< entry of y of the w of a quaternion that is unknown
  std::map<std::size_t, Known> known;        ///< by entry of y
  std::set<std::size_t> later;               ///< entries of y that later blocks determine
  std::vector<std::string> names;            ///< of the entries of y, for messages
};

/// Those values of `program`, in the builder's values; sines and cosines of sums with dependent coordinates
/// are split by the addition theorem. Otherwise why one is no such polynomial, a phrase for the user.
std::variant<std::vector<Polynomial>, std::string> polynomials_of(ir::Builder& builder,
                                                                  const ir::Program& program,
                                                                  const std::vector<ir::ValueId>& values,
                                                                  const Roles& roles);

}  // namespace jourdain::loops
