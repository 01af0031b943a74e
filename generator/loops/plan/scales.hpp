// Sizes of a mechanism's constraints: what makes rows of different units alike, and what is small beside them.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// G M⁻¹ Gᵀ at a configuration, M of the tree.
Matrix schur_matrix(const model::Mechanism& mechanism, const Configuration& configuration, const Matrix& G);

/// Sets row_length and regularisation of the plan from the configurations seen, the first of which is the start; where
/// M of the tree is singular there is nothing to take them from.
void set_scales(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                const std::vector<Matrix>& jacobians, bool is_regular, LoopPlan& plan);

/// Where rows share, sets their row_length from the configurations seen: at the start such a row may be next to
/// nothing. Else makes the regularisation small beside what holds the weakest row, where that is strongest: false
/// after an error where double cannot tell that from nothing.
bool set_scales_of_multipliers(const model::Mechanism& mechanism,
                               const std::vector<Configuration>& configurations,
                               const std::vector<Matrix>& jacobians, LoopPlan& plan,
                               support::Diagnostics& diagnostics);

/// Sets the determinant of what closing solves for, once the treatment is known, from the configurations seen.
/// The first is the start.
void set_determinant(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                     const std::vector<Matrix>& jacobians, LoopPlan& plan);

/// Product of the determinants of the dependent blocks. Those that are solved by orthogonalisation count without sign.
long double block_determinant(const LoopPlan& plan, const Matrix& G);

}  // namespace jourdain::loops
