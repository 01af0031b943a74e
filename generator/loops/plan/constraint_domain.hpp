// Have the expressions of constraints a value wherever coordinates may go?
#pragma once

#include <string>

#include "model/mechanism.hpp"

namespace jourdain::loops {

/// Why it is not proven that residuals and constraints of velocities have values over the declared ranges of
/// coordinates and parameters, at all times; empty where it is. Without `with_roots` nothing is said of roots,
/// whose domain the proof of a branch sees itself.
std::string why_undefined(const model::Mechanism& mechanism, bool with_roots);

}  // namespace jourdain::loops
