// What tells one text from another.
#pragma once

#include <string>
#include <string_view>

namespace jourdain::commands {

/// SHA-256 of a text, 64 hexadecimal digits.
std::string sha256_of(std::string_view text);

}  // namespace jourdain::commands
