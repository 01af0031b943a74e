// Names in TOML model files: reading them once and finding them again.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "model/names.hpp"
#include "model/read/toml_table.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Reports a name that is not an identifier; `what` it names ("body").
inline void check_identifier(TomlFile& file, SourceRange where, const std::string& what,
                             const std::string& name) {
  if (is_identifier(name)) return;
  file.error(where, fmt::format("{} name '{}' is not an identifier", what, support::shown(name)),
             "letters, digits and '_' only, and no digit first");
}

/// True if no element of `earlier` is called `name`; else a diagnostic at `where`.
template <class Named>
bool is_new_name(TomlFile& file, SourceRange where, const std::string& what, const std::string& name,
                 const std::vector<Named>& earlier) {
  const auto first =
      std::find_if(earlier.begin(), earlier.end(), [&](const Named& n) { return n.name == name; });
  if (first == earlier.end()) return true;
  file.error(where, fmt::format("there are two {} '{}'", what, support::shown(name)),
             "first declared at " + file.line_in_words(first->where));
  return false;
}

/// Position of the element called `name`; a diagnostic "`who` unknown `what` 'name'" with the nearest name
/// otherwise. Where not all elements could be read (`complete` is false), a name that is near to none is
/// passed over.
template <class Named>
std::optional<std::size_t> find_named(TomlFile& file, SourceRange where, const std::string& who,
                                      const std::string& what, const std::string& name,
                                      const std::vector<Named>& elements, bool complete) {
  std::vector<std::string> names;
  for (const Named& element : elements) names.push_back(element.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string close = support::nearest(name, names);
  if (close.empty() && !complete) return {};
  std::string hint;
  if (!close.empty()) {
    const auto index = static_cast<std::size_t>(std::find(names.begin(), names.end(), close) - names.begin());
    hint =
        fmt::format("did you mean '{}', declared at {}?", close, file.line_in_words(elements[index].where));
  }
  file.error(where, fmt::format("{} unknown {} '{}'", who, what, support::shown(name)), hint);
  return {};
}

/// The name that a table gives, or "<what><number>".
inline std::string name_or_number(TomlFile& file, const toml::table& table, const char* what,
                                  std::size_t number) {
  return file.text_or(table, "name", fmt::format("{}{}", what, number));
}

}  // namespace jourdain::model
