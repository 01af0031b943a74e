// Sizes of a mechanism's constraints: what makes rows of different units alike, and what is small beside them.
#pragma once

#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

/// G M⁻¹ Gᵀ at a configuration, M of the tree.
Matrix schur_matrix(const model::Mechanism& mechanism, const Configuration& configuration, const Matrix& G);

/// Sets row_length and regularisation of the plan from the start, where the Jacobian is `G`; where M of the
/// tree is singular there is nothing to take them from.
void set_scales(const model::Mechanism& mechanism, const Configuration& start, const Matrix& G,
                bool is_regular, LoopPlan& plan);

/// Sets row_length of rows that share from the configurations seen: at the start such a row may be next to nothing.
void set_sharing_lengths(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                         const std::vector<Matrix>& jacobians, LoopPlan& plan);

/// Sets the determinant of what closing solves for, once the treatment is known, from the configurations seen.
/// The first is the start.
void set_determinant(const model::Mechanism& mechanism, const std::vector<Configuration>& configurations,
                     const std::vector<Matrix>& jacobians, LoopPlan& plan);

/// Product of the determinants of the dependent blocks. Those that are solved by orthogonalisation count without sign.
long double block_determinant(const LoopPlan& plan, const Matrix& G);

}  // namespace jourdain::loops
