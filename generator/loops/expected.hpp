// What mechanisms with loops should do at one state, by dense algebra: what the programs are validated against.
#pragma once

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "loops/configuration.hpp"
#include "loops/plan.hpp"

namespace jourdain::loops {

/// Singular values of G M⁻¹ Gᵀ, rows multiplied by their lengths.
struct Spread {
  long double largest = 0, smallest = 0;  ///< the smallest that is not zero
  bool is_singular = false;               ///< so small that the regularisation shows
  long double lost_share = 0;             ///< what the regularisation takes from the weakest multiplier
};
Spread spread_of(const LoopPlan& plan, const Matrix& G, const Matrix& M);

/// z = B z_i + b and ż = B ż_i + β of the tree, and the multipliers that go with ż.
struct TreeMotion {
  Matrix B;
  Vector b, beta, zdot, lambda;
};

/// Fills in ż and λ of `known`: M ż + Gᵀ λ = forces, G ż + γ = 0. With reduced treatments redundant rows have no multiplier, otherwise
/// multipliers times lengths have the least norm.
TreeMotion tree_motion(const LoopPlan& plan, const Matrix& M, const Matrix& G, const Vector& forces,
                       const Vector& gamma, TreeMotion known);

/// The numbers of the outputs in their order, output by output; `leaf` gives everything but accelerations and multipliers.
std::vector<Vector> expected_outputs(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                                     const LoopPlan& plan, const TreeMotion& motion,
                                     const dynamics::LeafValue& leaf);

}  // namespace jourdain::loops
