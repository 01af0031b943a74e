// Faults planted in a mechanism as if its reader or a step after it had changed a number or the end of something.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::tests {

struct MechanismMutant {
  std::string fault;  ///< the operator
  std::string where;
  model::Mechanism mechanism;
};

/// Every number times 1 + 1e-9, with the other sign, zero; every zero made 1e-6; axes reversed; parents, ends
/// and frames swapped.
std::vector<MechanismMutant> mechanism_mutants(const model::Mechanism& mechanism);

}  // namespace jourdain::tests
