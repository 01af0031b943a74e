// Passages that are written as they stand: arithmetic of more than one number, which in exact arithmetic is
// that of one, and what packs of numbers may customize.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "readback/tokens.hpp"

namespace jourdain::readback {

/// The type of numbers that are computed with at once.
inline constexpr const char* kLanesType = "Lanes";

struct KnownText {
  std::string_view scope;  ///< namespace within the outer one, or empty
  /// Name of a template that stands for its numbers, added up or beside each other; or empty.
  std::string_view type;
  std::unique_ptr<std::string> text;
  Tokens tokens;                       ///< of `text`
  std::optional<Tokens> meaning = {};  ///< what is read in its place
  bool is_own_sines = false;
};

/// A second copy, apart from the templates: what is written must be this, token by token. What it computes in
/// double and float is tested in tests/steppers, for packs in tests/embed.
const std::vector<KnownText>& known_texts(bool packs);

}  // namespace jourdain::readback
