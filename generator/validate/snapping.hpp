// What reading nearly right angles as right angles does to a mechanism.
#pragma once

#include <optional>
#include <string>

#include "model/mechanism.hpp"

namespace jourdain::validate {

/// Largest change of the accelerations by snapping at a few sampled states, relative to the sizes of the terms
/// that they are added up from, by the numeric reference. Nothing where there is none: with loops, and where M
/// is singular.
std::optional<double> snapping_effect(const model::Mechanism& mechanism);

/// The same in a sentence; empty where nothing was snapped.
std::string snapping_sentence(const model::Mechanism& mechanism);

}  // namespace jourdain::validate
