// Sines and cosines of several angles in one call, for number types that compute them side by side.
#pragma once

#include <optional>

#include "emit/tree.hpp"

namespace jourdain::emit {

/// The same values: pairs of angles that are known when a body begins are computed first, by `sine_cosine4` and
/// `sine_cosine2`; what is left over stays where it is. Nothing where there are no two.
std::optional<Statements> in_sine_blocks(const Statements& body);

}  // namespace jourdain::emit
