// Sines and cosines of several angles at once, as they are written.
#pragma once

#include <string>
#include <vector>

namespace jourdain::readback {

/// A second copy of the texts, apart from the templates: of two, three and four doubles and floats, inlined or not, and
/// what they share. What they compute is compared with single angles in tests/embed.
std::vector<std::string> own_sine_blocks();

}  // namespace jourdain::readback
