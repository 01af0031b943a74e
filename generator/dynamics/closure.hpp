// The constraint functions g(y, t) of the loop joints, row by row as model::Loop defines them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "dynamics/scene.hpp"

namespace jourdain::dynamics {

/// Gradient of a row that belongs to two frames, in W of the link of their carrier: by displacement of the
/// origin of `to` (minus it by that of `from`), and by rotation of the bodies, each about its frame's origin;
/// of the carrier about any point.
struct RowGradient {
  Vector3 place = kinematics::zero_vector();
  Vector3 turn_from = kinematics::zero_vector(), turn_to = kinematics::zero_vector(),
          turn_carrier = kinematics::zero_vector();
};

/// Of a rod: from one end to the other in W of the link of the carrier, and how long that is where it is closed.
struct Span {
  Vector3 difference;
  Ex length;
};

/// A point of a plane that is looked for, where two numbers are zero. Rows have its coordinates as numbers that are
/// held: it moves as the two numbers stay at zero, and where g is zero it does not change with them.
struct Search {
  std::array<Ex, 2> found;                   ///< held, m
  std::array<Ex, 2> misfit;                  ///< of the held ones
  std::array<std::array<Ex, 2>, 2> inverse;  ///< −(∂misfit/∂found)⁻¹
  Ex missed;                                 ///< square of the last step of the search, m²
  /// Of −∂misfit/∂found: both positive where the point is nearer than those around it.
  Ex determinant, trace;
};

/// Of one loop.
struct LoopClosure {
  std::vector<Ex>
      rows;  ///< g: zero where the loop is closed. Lengths in m, products of unit vectors without unit
  std::vector<Ex>
      senses;  ///< products of unit vectors that are 1 where it is closed, and −1 where it is closed the wrong way
  std::vector<RowGradient> gradients;  ///< by row; none of a residual
  /// By row, as far as asked for; none of a residual: G by entry of z, without entries that are 0, g_t, ġ, and
  /// γ = g̈ at ż = 0.
  std::vector<std::map<std::size_t, Ex>> slopes;
  std::vector<Ex> time_slopes, rates, biases;
  std::optional<Span> span;  ///< of the one row of a rod
  /// Points that are looked for in it.
  std::vector<Search> searches;
  /// Of rows that bind velocities alone, whose g is 0: what is kept at zero, linear in z.
  std::map<std::size_t, Ex> velocities;
};

enum class ClosureRates { kNone, kGiven };

/// By loop.
std::vector<LoopClosure> derive_closure(const Scene& scene, ClosureRates rates);

}  // namespace jourdain::dynamics
