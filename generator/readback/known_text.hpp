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

struct KnownText {
  std::string_view scope;  ///< namespace within the outer one, or empty
  std::string_view type;   ///< name of a struct template that stands for the type of its numbers; or empty
  std::unique_ptr<std::string> text;
  Tokens tokens;                       ///< of `text`
  std::optional<Tokens> meaning = {};  ///< what is read in its place
  bool is_own_sines = false;
};

/// A second copy, apart from the templates: what is written must be this, token by token. What it computes in
/// double and float is tested in tests/steppers, for packs in tests/embed.
const std::vector<KnownText>& known_texts(bool packs);

}  // namespace jourdain::readback
