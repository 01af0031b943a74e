// Dense algebra in 77 digits.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "reference/plain_products.hpp"
#include "reference/scaled_scalar.hpp"

namespace jourdain::reference {

using ExactMatrix = Eigen::Matrix<support::ScaledReal, Eigen::Dynamic, Eigen::Dynamic>;
using ExactVector = Eigen::Matrix<support::ScaledReal, Eigen::Dynamic, 1>;

/// A⁻¹ B by elimination with partial pivoting; not numbers where A is singular.
ExactMatrix solved(ExactMatrix A, ExactMatrix B);
support::ScaledReal determinant(ExactMatrix A);

ExactVector to_exact(const std::vector<support::ScaledReal>& values);
/// From rows of `columns` entries each.
ExactMatrix to_exact(const std::vector<std::vector<support::ScaledReal>>& rows, std::size_t columns);
std::vector<support::ScaledReal> to_list(const ExactVector& values);

}  // namespace jourdain::reference
