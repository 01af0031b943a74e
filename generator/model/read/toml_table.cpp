#include "model/read/toml_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/utf8.hpp"

namespace jourdain::model {

using support::shown;

namespace {

/// A quaternion written with a few digits is meant to have unit length.
constexpr double kQuaternionTolerance = 1e-6;

/// Line breaks and tabs count as printable.
bool is_printable(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const support::Utf8Character character = support::utf8_at(text, i);
    if (!character.printable && std::string_view("\n\r\t").find(text[i]) == std::string_view::npos)
      return false;
    i += character.bytes;
  }
  return true;
}

}  // namespace

std::string_view type_in_words(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::none:
      return "nothing";
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a truth value";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time";
    case toml::node_type::date_time:
      return "a date";
  }
  return "something else";
}

TomlTable::TomlTable(TomlFile& file, const toml::table& table, std::string what, SourceRange where,
                     const std::vector<std::string>& known, const std::vector<std::string>& shown_keys)
    : file_(file), table_(table), what_(std::move(what)), where_(where) {
  for (const auto& [key, value] : table_) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string close = support::nearest(name, known);
    file_.error(file_.range(key.source()), fmt::format("unknown key '{}' in {}", shown(name), what_),
                close.empty()
                    ? fmt::format("known are {}", fmt::join(shown_keys.empty() ? known : shown_keys, ", "))
                    : fmt::format("did you mean '{}'?", close));
  }
}

SourceRange TomlTable::where(std::string_view key) const {
  const toml::node* node = find(key);
  return node ? file_.range(node->source()) : where_;
}

std::string TomlTable::quoted(std::string_view key) const { return fmt::format("'{}' of {}", key, what_); }

void TomlTable::missing(std::string_view key, std::string hint) const {
  file_.error(where_, fmt::format("{} needs '{}'", what_, key), std::move(hint));
}

void TomlTable::error(std::string_view key, std::string message, std::string hint) const {
  file_.error(where(key), std::move(message), std::move(hint));
}

void TomlTable::wrong_type(std::string_view key, std::string_view expected) const {
  error(key, fmt::format("{} must be {}, not {}", quoted(key), expected, type_in_words(*find(key))));
}

std::optional<Unit> TomlTable::unit(std::string_view key) const {
  if (!has(key)) return Unit();
  if (!text(key)) return {};
  return file_.unit(*find(key)->as_string());
}

std::optional<std::string> TomlTable::text(std::string_view key) const {
  if (!has(key)) return {};
  const auto* written = find(key)->as_string();
  if (!written) {
    wrong_type(key, "a string");
    return {};
  }
  const std::size_t mark = file_.error_count();
  std::string text = file_.text(*written);
  if (file_.error_count() != mark) return {};
  if (is_printable(text)) return text;
  error(key, fmt::format("{} has characters that cannot be printed", quoted(key)));
  return {};
}

std::optional<std::string> TomlTable::required_text(std::string_view key) const {
  if (!has(key)) missing(key);
  std::optional<std::string> found = text(key);
  if (!found || !found->empty()) return found;
  error(key, fmt::format("{} is empty", quoted(key)));
  return {};
}

std::optional<std::size_t> TomlTable::choice(std::string_view key,
                                             const std::vector<std::string>& allowed) const {
  if (!has(key)) return 0;
  const std::optional<std::string> word = text(key);
  if (!word) return {};
  for (std::size_t i = 0; i < allowed.size(); ++i)
    if (allowed[i] == *word) return i;
  const std::string close = support::nearest(*word, allowed);
  error(key, fmt::format("{} cannot be '{}'", quoted(key), shown(*word)),
        close.empty() ? fmt::format("known are {}", fmt::join(allowed, ", "))
                      : fmt::format("did you mean '{}'?", close));
  return {};
}

Expression TomlTable::number(std::string_view key, const Needed& needed, const Expression& otherwise) const {
  return has(key) ? file_.expression(*find(key), place(key, needed)) : otherwise;
}

Expression TomlTable::not_negative(std::string_view key, const Needed& needed) const {
  Expression value = number(key, needed);
  if (file_.value(value) < 0) error(key, fmt::format("{} is negative", quoted(key)));
  return value;
}

Expression TomlTable::positive(std::string_view key, const Needed& needed) const {
  if (!has(key)) {
    missing(key);
    file_.complete().numbers = false;
    return 1.0;
  }
  const std::size_t mark = file_.error_count();
  Expression result = number(key, needed);
  if (file_.error_count() == mark && !(file_.value(result) > 0)) {
    error(key, fmt::format("{} must be positive, not {}", quoted(key), file_.value(result)));
    file_.complete().numbers = false;
  }
  return result;
}

/// `count`: two to four.
const toml::array* TomlTable::numbers(std::string_view key, std::size_t count, Place& place) const {
  constexpr const char* kWords[] = {"two", "three", "four"};
  const toml::node* node = find(key);
  if (const toml::table* apart = node->as_table(); apart && apart->contains("value")) {
    const std::size_t mark = file_.error_count();
    if (const std::optional<Unit> unit = file_.unit_apart(*apart, place)) place.unit = *unit;
    if (file_.error_count() != mark) return nullptr;
    node = apart->get("value");
  }
  const toml::array* array = node->as_array();
  if (!array) {
    wrong_type(key, fmt::format("an array of {} numbers", kWords[count - 2]));
  } else if (array->size() != count) {
    error(key, fmt::format("{} needs {} numbers, found {}", quoted(key), count, array->size()));
    array = nullptr;
  }
  if (!array) file_.complete().numbers = false;
  return array;
}

Expression TomlTable::function(std::string_view key, const Needed& needed, const Scope& scope) const {
  return has(key) ? file_.expression(*find(key), place(key, needed), scope) : Expression(0.0);
}

Vector3 TomlTable::functions(std::string_view key, const Needed& needed, const Scope& scope) const {
  Vector3 result;
  Place where = place(key, needed);
  const toml::array* array = has(key) ? numbers(key, 3, where) : nullptr;
  for (std::size_t i = 0; array && i < 3; ++i) result[i] = file_.expression((*array)[i], where, scope);
  return result;
}

std::array<Expression, 4> TomlTable::quaternion(std::string_view key) const {
  std::array<Expression, 4> result{1.0, 0.0, 0.0, 0.0};
  Place where = place(key, needed::kPure);
  const toml::array* array = has(key) ? numbers(key, 4, where) : nullptr;
  if (!array) return result;
  const std::size_t mark = file_.error_count();
  double square = 0;
  bool constant = true;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = file_.expression((*array)[i], where);
    constant = constant && result[i].is_constant();
    square += file_.value(result[i]) * file_.value(result[i]);
  }
  if (file_.error_count() != mark) return result;
  const double length = std::sqrt(square);
  if (!(std::abs(length - 1) <= kQuaternionTolerance))
    error(key, fmt::format("{} is a quaternion of length {:.6g}, not 1", quoted(key), length),
          "write w, x, y, z of a unit quaternion");
  for (Expression& component : result)
    if (constant) component = component.constant() / length;
  return result;
}

Vector3 TomlTable::vector(std::string_view key, const Needed& needed, const Vector3& otherwise) const {
  if (!has(key)) return otherwise;
  Place where = place(key, needed);
  const toml::array* array = numbers(key, 3, where);
  if (!array) return otherwise;
  Vector3 result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = file_.expression((*array)[i], where);
  return result;
}

std::optional<std::array<Expression, 2>> TomlTable::pair(std::string_view key, const Needed& needed) const {
  Place where = place(key, needed);
  const toml::array* array = has(key) ? numbers(key, 2, where) : nullptr;
  if (!array) return {};
  const std::size_t mark = file_.error_count();
  std::array<Expression, 2> result;
  for (std::size_t i = 0; i < 2; ++i) result[i] = file_.expression((*array)[i], where);
  return file_.error_count() == mark ? std::optional(result) : std::nullopt;
}

std::array<double, 3> TomlTable::direction(std::string_view key,
                                           const std::array<double, 3>& otherwise) const {
  if (!has(key)) return otherwise;
  Place where = place(key, needed::kPure);
  const toml::array* array = numbers(key, 3, where);
  if (!array) return otherwise;
  const std::size_t mark = file_.error_count();
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = file_.constant((*array)[i], where);
  return file_.error_count() == mark ? result : otherwise;
}

std::optional<std::array<double, 2>> TomlTable::constant_pair(std::string_view key, const Needed& needed,
                                                              const std::optional<Unit>& unit) const {
  Place where{quoted(key), needed, unit};
  const toml::array* array = has(key) ? numbers(key, 2, where) : nullptr;
  if (!array) return {};
  const std::size_t mark = file_.error_count();
  std::array<double, 2> result{};
  for (std::size_t i = 0; i < 2; ++i) result[i] = file_.constant((*array)[i], where);
  return file_.error_count() == mark ? std::optional(result) : std::nullopt;
}

Rotation TomlTable::rotation(std::string_view key) const {
  return {vector(key, needed::kAngle), has(key) ? where(key) : SourceRange{}};
}

const toml::array* TomlTable::array(std::string_view key, std::string_view expected) const {
  if (!has(key)) {
    missing(key);
    return nullptr;
  }
  const toml::array* found = find(key)->as_array();
  if (!found) wrong_type(key, expected);
  return found;
}

const toml::table* TomlTable::table(std::string_view key) const {
  if (!has(key)) return nullptr;
  if (const auto* found = find(key)->as_table()) return found;
  wrong_type(key, "a table");
  return nullptr;
}

}  // namespace jourdain::model
