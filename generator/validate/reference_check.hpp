// The symbolic equations against the numeric reference, both in 77 digits.
#pragma once

#include "dynamics/equations.hpp"
#include "model/mechanism.hpp"
#include "validate/agreement.hpp"
#include "validate/tree_oracle.hpp"

namespace jourdain::validate {

/// M, k̄, q̄, rates, energies, the initial state and outputs at one state. Quaternions must have unit length.
void compare_with_reference(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                            const ir::LeafValues<ScaledReal>& state, const TreeOracle& symbolic,
                            Agreement& agreement);

}  // namespace jourdain::validate
