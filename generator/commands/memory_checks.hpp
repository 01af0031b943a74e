// What memories ask of steps and of what takes a model further.
#pragma once

#include <cstddef>
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

/// Whether a memory samples at every step, so that shorter steps are another controller.
bool samples_at_steps(const model::Mechanism& mechanism);

/// Why the parameter `entry` may not be drawn, which is to be up to `width` off: a memory's period follows from it, and
/// whatever is drawn is no whole number of steps. Empty: none does.
std::string check_drawn_sampling(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                 std::size_t entry, double width);

}  // namespace jourdain::commands
