// Mechanisms back to text, so that one that fails a property test can be saved, compiled and looked at.
#pragma once

#include <string>

#include "model/mechanism.hpp"

namespace jourdain::tests {

/// The mechanism as a model file, numbers in shortest round-trip form: reading it gives the same mechanism
/// (but for `snap`, which a file does not say, and options of loops that their treatment does not use). Equal
/// texts mean equal mechanisms.
std::string to_toml(const model::Mechanism& mechanism);

}  // namespace jourdain::tests
