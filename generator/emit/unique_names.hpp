// C++ names for values, unique within one function.
#pragma once

#include <set>
#include <string>

namespace jourdain::emit {

/// Hands out identifiers that differ from each other and from the reserved ones.
class Names {
 public:
  explicit Names(std::set<std::string> reserved) : taken_(std::move(reserved)) {}

  /// `wanted` with characters that no identifier has replaced by '_', and with a number appended if it is taken.
  /// Empty names become `fallback`.
  std::string unique(const std::string& wanted, const std::string& fallback);

 private:
  std::set<std::string> taken_;
};

/// Text for a `//` comment of the emitted code: printable ASCII on one line, no trailing backslash.
std::string comment_text(const std::string& text);

/// Text between double quotes of a C++ or JSON string literal. Bytes of valid UTF-8 stay; controls are escaped.
std::string quoted_text(const std::string& text);

}  // namespace jourdain::emit
