// Names for values, unique within one function, and quoted text.
#pragma once

#include <set>
#include <string>
#include <vector>

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

/// `prefix` and a name for each of `names`, all different.
std::vector<std::string> unique_names(const std::string& prefix, const std::vector<std::string>& names);

/// Text between double quotes of a string literal, as C++ and JSON have them. Bytes of valid UTF-8 stay, controls
/// do not.
std::string quoted_text(const std::string& text);

}  // namespace jourdain::emit
