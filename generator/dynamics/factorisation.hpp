// Solution of M x = b with M = Lᵀ D L factored from the leaves of the tree.
#pragma once

#include <vector>

#include "kinematics/statements.hpp"

namespace jourdain::dynamics {

/// Binds the factorisation M = Lᵀ D L (L unit lower triangular) and the solution of M x = b; no square roots, no
/// pivoting. `parent[i]` < i is the coordinate next towards the root, or kGround: only pairs of a coordinate and its
/// ancestors are visited, which leaves out the zeros between branches (Featherstone, Rigid Body Dynamics Algorithms,
/// 2008, section 6.5). Entries of M that are the number 0 are skipped as well.
std::vector<kinematics::Ex> solve_mass_matrix(const std::vector<std::vector<kinematics::Ex>>& M,
                                              const std::vector<kinematics::Ex>& b,
                                              const std::vector<std::size_t>& parent,
                                              kinematics::Statements& statements);

}  // namespace jourdain::dynamics
