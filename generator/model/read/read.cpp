#include "model/read/read.hpp"

#include <fmt/format.h>

#include "model/read/finish.hpp"
#include "model/read/format.hpp"
#include "support/line_index.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

namespace {

using support::Diagnostics;

/// Reports the first byte that no text has; false if there is one.
bool is_text(Diagnostics& diagnostics) {
  const std::string& text = diagnostics.text();
  for (std::size_t i = 0; i < text.size();) {
    const support::Utf8Character character = support::utf8_at(text, i);
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool control = byte == 0x7f || (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r');
    if (!character.valid || control) {
      const std::string message = control
                                      ? fmt::format("the file is not text: control character 0x{:02x}", byte)
                                      : fmt::format("the file is not UTF-8: byte 0x{:02x}", byte);
      diagnostics.error(support::LineIndex(text).range(i, 1), message);
      return false;
    }
    i += character.bytes;
  }
  return true;
}

bool is_readable(Diagnostics& diagnostics) {
  const std::string& text = diagnostics.text();
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    diagnostics.error({}, "the file is empty");
    return false;
  }
  if (text.size() > kMaximumFileSize) {
    diagnostics.error({}, fmt::format("the file has {} bytes, more than the {} that are read", text.size(),
                                      kMaximumFileSize));
    return false;
  }
  return is_text(diagnostics);
}

}  // namespace

std::optional<Part> read_part(Diagnostics& diagnostics, const ReadOptions& options) {
  if (!is_readable(diagnostics)) return {};
  switch (format_of(diagnostics.path(), diagnostics.text())) {
    case Format::kSdf:
      return read_sdf(diagnostics, options);
    case Format::kMjcf:
      return read_mjcf(diagnostics, options);
    case Format::kUrdf:
      return read_urdf(diagnostics, options);
    case Format::kToml:
      break;
  }
  return read_toml(diagnostics, options);
}

std::optional<Mechanism> read_mechanism(Diagnostics& diagnostics, const ReadOptions& options) {
  std::optional<Part> part = read_part(diagnostics, options);
  if (!part) return {};
  return finish_reading(std::move(*part), options, diagnostics);
}

}  // namespace jourdain::model
