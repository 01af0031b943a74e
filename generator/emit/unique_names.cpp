#include "emit/unique_names.hpp"

#include <fmt/format.h>

#include "emit/constant_tables.hpp"
#include "model/names.hpp"

namespace jourdain::emit {

namespace {

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

}  // namespace

std::string Names::unique(const std::string& wanted, const std::string& fallback) {
  std::string name;
  for (char c : wanted) {
    const char next = is_letter_or_digit(c) ? c : '_';
    if (next != '_' || name.empty() || name.back() != '_') name += next;
  }
  if (name.empty() || name == "_") name = fallback;
  if (!(name[0] >= 'a' && name[0] <= 'z') && !(name[0] >= 'A' && name[0] <= 'Z')) name = "v" + name;
  if (model::is_reserved(name) || is_table_function(name)) name += "_value";
  std::string candidate = name;
  for (int i = 2; !taken_.insert(candidate).second; ++i)
    candidate = fmt::format("{}{}{}", name, name.back() == '_' ? "" : "_", i);
  return candidate;
}

std::vector<std::string> unique_names(const std::string& prefix, const std::vector<std::string>& names) {
  Names taken({});
  std::vector<std::string> found;
  for (const std::string& name : names) found.push_back(taken.unique(prefix + name, prefix));
  return found;
}

std::string quoted_text(const std::string& text) {
  std::string safe;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      safe += {'\\', c};
    else if (byte < 0x20 || byte == 0x7f)
      safe += '?';
    else
      safe += c;
  }
  return safe;
}

}  // namespace jourdain::emit
