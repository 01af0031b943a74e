// What tells one text from another.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace jourdain::commands {

/// SHA-256 of a text, 64 hexadecimal digits.
std::string sha256_of(std::string_view text);

/// SHA-256 of a file but for its first `skipped` bytes. Throws EnvironmentError naming the path where it cannot be
/// read.
std::string sha256_of_file(const std::string& path, std::uint64_t skipped);

}  // namespace jourdain::commands
