// Equations of scenes that move in planes in closed form: what two links of a run do to each other depends on the
// sum of the angles between them alone, so that no sine of a coordinate comes in that does not matter.
#pragma once

#include <vector>

#include "dynamics/applied_forces.hpp"

namespace jourdain::dynamics {

/// Whether all links slide without ever turning, or turn, each beside its parent, on slides or on the ground; at
/// least one turns, and no motion is prescribed.
bool has_link_equations(const Scene& scene);

/// Σ_j M_ij x_j = f_i by links, with x_i the acceleration of a turn's angle against what the first turn of its run
/// stands in, and that of a slide along its axis. With Δ the angle of link j against link i inward of it, r the
/// place on link i that the links up to j turn about and h the first moment of what turns with link j, both in the
/// axes of their links, M_ij = r · R(Δ) h.
struct LinkEquations {
  std::vector<std::vector<Ex>> M;  ///< entries [j][i] of i inward of j, and the constant diagonal
  std::vector<Ex> inertia;         ///< f of the links' rates: ∓ dM_ij/dΔ times squares of rates
  std::vector<Ex> weight;          ///< f of gravity, by the angles that the other terms take too
  std::vector<Ex> weight_alone;    ///< the same in the fewest operations where nothing else is asked for
  std::vector<Ex> scale;           ///< what the row of a link was multiplied with
};

/// kUnit: rows of links that move each other are divided by the diagonal entry of the last one that turns, so
/// that its row needs no factor.
enum class RowScale { kNone, kUnit };

LinkEquations derive_link_equations(const Scene& scene, RowScale scale);

}  // namespace jourdain::dynamics
