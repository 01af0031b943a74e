#include "commands/printable.hpp"

#include "support/utf8.hpp"

namespace jourdain::commands {

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const support::Utf8Character character = support::utf8_at(text, i);
    const bool shown = character.printable || text[i] == '\n';
    out += shown ? text.substr(i, character.bytes) : "?";
    i += character.bytes;
  }
  return out;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace jourdain::commands
