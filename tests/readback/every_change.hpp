// Faults planted one after the other into a passage of emitted text.
#pragma once

#include <string>

#include "readback/compiled_text.hpp"

namespace jourdain::tests {

/// Changes digits and operators of a file's text from `first` up to `end`, outside of comments, one at a time, of every
/// `stride` the first; each change must be seen. There must be `least` of them.
void expect_every_change_seen(const CompiledText& text, const std::string& file, const std::string& first,
                              const std::string& end, std::size_t stride = 1, std::size_t least = 100);

}  // namespace jourdain::tests
