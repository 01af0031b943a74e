// Programs of the functions that hold derivatives: Jacobians of the equations of motion, by elimination on the program.
#pragma once

#include <vector>

#include "programs/derivative_sources.hpp"
#include "programs/functions.hpp"

namespace jourdain::programs {

/// Which terms the derivatives of the residual hold. W-methods keep their order with any of them.
enum class DerivativeTerms {
  kAll,
  kApplied,  ///< those of springs, dampers and other applied forces: where stiffness comes from
};

/// One program for each of `functions` that holds derivatives or is made for them; the others are passed over.
/// Positions are differentiated by the displacements of model::Tangent. With r(y, z, a, u, t) = M a − k̄ + q̄
/// and a = ż, ∂ż = −M⁻¹ ∂r at a = ż: no derivative of the factorisation is taken. Orders of
/// elimination are looked for that take few operations.
std::vector<ir::Program> derivative_programs(const DerivativeSources& sources,
                                             const std::vector<FunctionInfo>& functions,
                                             DerivativeTerms terms);

bool any_derivatives(const std::vector<FunctionInfo>& functions);

}  // namespace jourdain::programs
