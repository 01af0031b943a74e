// A rotation in space solved from constraints: where two points of the body are, then how it turns about the
// line between them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "loops/closed_form/dyad.hpp"

namespace jourdain::loops {

/// A row |Δ|² = l², rather than by its square.
struct RodRow {
  std::array<Polynomial, 3> difference;
  Scalar length;
};

struct RotationRow {
  Polynomial value;
  std::optional<RodRow> rod = {};
};

/// Solves `rows` = 0 for a rotation matrix R and at most one scalar unknown. The forms, up to a regular matrix:
///
///   R c = d          three rows: a ball joint. c is fixed; d on a circle or a line by the scalar unknown
///                    (a wishbone, a slide), or d is known and c moves along a line of the body (a strut);
///                    or the scalar unknown turns what carries the body
///   a₁·Rᵀd, a₂·Rᵀd   two rows: a known point on a line of the body (a strut without a coordinate of its own)
///
/// and one row n·R t = γ with t fixed in the body: a rod, a point in a plane. Unknowns of the solution: the
/// scalar one, if any, and the entries w x y z of the quaternion, whose sign is that of the initial one.
/// Otherwise why not, a phrase for the user.
std::variant<Solution, std::string> solve_rotation(ir::Builder& builder, const std::vector<RotationRow>& rows,
                                                   const std::optional<double>& initial_scalar,
                                                   const std::array<double, 4>& initial_quaternion,
                                                   const Samples& samples);

}  // namespace jourdain::loops
