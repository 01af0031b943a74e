// Numbers with units of a TOML file, and what does not fit its place.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "model/expression_functions.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool starts_word(std::string_view text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0]));
}

std::string_view first_word(std::string_view text) { return text.substr(0, text.find_first_of(" */^()+-")); }

constexpr const char* kHertz = "Hz may count turns or radians; rev/s and rad/s say which";

bool is_ambiguous(const Unit& unit, const Needed& needed) {
  return unit.si.find("Hz") != std::string::npos && unit.si.find("rad") == std::string::npos &&
         needed.units == needed::kAngularRate.units;
}

}  // namespace

std::optional<Measure> TomlFile::measure_of(std::string_view name, const Scope& scope) const {
  for (const DeclaredParameter& parameter : parameters_)
    if (parameter.name == name) return parameter.measure;
  for (const ScopeEntry& entry : scope)
    if (entry.name == name) return entry.measure;
  return {};
}

/// There are no products without '*': "2 m" is a quantity even where m is a parameter, and so is "2m" where that
/// would not fit. Where the text is none ("2 l" with a parameter l) the expression's own message says more.
std::optional<Quantity> TomlFile::quantity(const toml::value<std::string>& text, const Needed& needed,
                                           const Scope& scope) {
  const std::string meant = this->text(text);
  if (meant.size() > kMaximumExpressionLength) return {};
  const auto split = split_quantity(meant);
  if (!split) return {};
  const std::string& unit_text = split->second;
  const std::size_t offset = meant.size() - unit_text.size();
  const bool apart = kBlanks.find(meant[offset - 1]) != std::string_view::npos;
  const std::string_view word = first_word(unit_text);
  const std::optional<Measure> parameter = measure_of(word, scope);
  if (std::holds_alternative<Unit>(parse_unit(unit_text))) {
    if (parameter && !apart && parameter->fits(needed)) return {};
  } else if (parameter || !apart || !starts_word(word) || is_expression_word(word)) {
    return {};
  }
  return Quantity{split->first, unit(text, offset),
                  unit_text == word && parameter ? "a product needs '*'" : ""};
}

Expression TomlFile::converted(const Quantity& quantity, const toml::value<std::string>& text,
                               const Place& place) {
  if (!quantity.unit) return unread();
  const Measure measure = Measure::parameter(quantity.unit->si);
  if (!measure.fits(place.needed)) return misfit(text, measure, place, quantity.hint);
  if (is_ambiguous(*quantity.unit, place.needed)) return misfit(text, measure, place, kHertz);
  const double value = in_si(quantity.value, *quantity.unit);
  if (std::isfinite(value)) return value;
  return number_error(range(text.source()), fmt::format("{} is not finite in SI units", place.what));
}

Expression TomlFile::value_and_unit(const toml::table& table, const Place& place, const Scope& scope) {
  const std::optional<Unit> unit = unit_apart(table, place);
  const toml::node* value = table.get("value");
  if (!unit || !value) return unread();
  const auto* text = value->as_string();
  if (text && quantity(*text, place.needed, scope))
    return number_error(range(text->source()), fmt::format("{} has two units", place.what), "one says it");
  if (value->is_table())
    return number_error(range(value->source()),
                        fmt::format("{} must be a number or an expression, not a table", place.what));
  return expression(*value, {place.what, place.needed, unit}, scope);
}

std::optional<Unit> TomlFile::unit_apart(const toml::table& table, const Place& place) {
  const std::size_t mark = error_count_;
  const TomlTable apart(*this, table, place.what, range(table.source()), {"value", "unit"});
  for (const char* key : {"value", "unit"})
    if (!apart.has(key)) apart.missing(key);
  std::optional<Unit> unit = apart.unit("unit");
  if (!unit || error_count_ != mark) return {};
  const auto& text = *table.get("unit")->as_string();
  const Measure measure = Measure::parameter(this->text(text));
  const bool is_hertz = is_ambiguous(*unit, place.needed);
  if (measure.fits(place.needed) && !is_hertz) return unit;
  misfit(text, measure, place, is_hertz ? kHertz : "");
  return {};
}

Expression TomlFile::in_unit(const Expression& bare, const Measure& measure, SourceRange where,
                             const Place& place) {
  if (!place.unit) return bare;
  if (measure.is_known() || (measure.has_degrees() && place.unit->factor != 1))
    return number_error(where, fmt::format("{} has two units", place.what), "one says it");
  if (bare.is_constant()) return in_si(bare.constant(), *place.unit);
  return Expression::binary(Expression::Op::kMultiply, bare, static_cast<double>(place.unit->factor));
}

Expression TomlFile::misfit(const toml::value<std::string>& text, const Measure& measure, const Place& place,
                            const std::string& hint) {
  return number_error(inside(text, 0, text.get().size()),
                      fmt::format("{} needs {}, but '{}' is in {}", place.what, in_words(place.needed),
                                  support::shown(this->text(text)), measure.unit()),
                      hint);
}

Expression TomlFile::unread() {
  complete_.numbers = false;
  return 0.0;
}

}  // namespace jourdain::model
