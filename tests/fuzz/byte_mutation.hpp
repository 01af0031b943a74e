// Files whose bytes were changed without a look at what they say.
#pragma once

#include <string>

#include "properties/random.hpp"

namespace jourdain::tests {

/// One change: a flipped bit, bytes that are gone, doubled, moved or come from `donor`, a truncated file, bytes that
/// are no text.
std::string mutated_bytes(std::string text, const std::string& donor, Random& random);

}  // namespace jourdain::tests
