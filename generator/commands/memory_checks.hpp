// What memories ask of steps and of what takes a model further.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::commands {

/// Why methods, or functions that are their steps, cannot be had: those of several steps would go on with rates from
/// before a sample. Empty: they can.
std::string check_multistep(const std::vector<std::string>& functions, const model::Mechanism& mechanism);

/// Why runs with steps of length `h`, s, sample unevenly; empty: they do not. `parameters` in the mechanism's order.
std::string check_sampling(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                           double h);

}  // namespace jourdain::commands
