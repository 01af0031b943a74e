// [parameters]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/read/keys.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

constexpr std::array<std::string_view, 6> kExpressionWords{"pi", "deg", "sqrt", "sin", "cos", "tan"};

void check_parameter_name(TomlFile& file, const Parameter& parameter) {
  const std::string& name = parameter.name;
  check_identifier(file, parameter.where, "parameter", name);
  if (std::find(kExpressionWords.begin(), kExpressionWords.end(), name) != kExpressionWords.end())
    file.error(parameter.where,
               fmt::format("parameter '{}' would hide what '{}' means in expressions", name, name));
  else if (is_reserved(name))
    file.error(parameter.where,
               fmt::format("parameter name '{}' is reserved in C++ or in the emitted code", name),
               fmt::format("'{}_value' would do", name));
  else if (name.find("__") != std::string::npos)
    file.error(parameter.where, fmt::format("parameter name '{}' has two '_' in a row", support::shown(name)),
               "C++ reserves such names");
}

/// A number or an expression in the place's unit, or a number with its own: "120 rpm". In SI units, as the
/// parameter's unit then is.
void read_number(TomlFile& file, const toml::node& node, const Place& place, Parameter& parameter) {
  const auto* text = node.as_string();
  const std::optional<Quantity> quantity = text ? file.quantity(*text, place.needed) : std::nullopt;
  if (!quantity) {
    parameter.value = file.constant(node, place);
    return;
  }
  if (!quantity->unit) return;
  if (!parameter.unit.empty())
    file.error(file.range(node.source()), fmt::format("{} has two units", place.what), "one says it");
  parameter.value = in_si(quantity->value, *quantity->unit);
  parameter.unit = quantity->unit->si;
}

void check_finite(TomlFile& file, const toml::node& node, const std::string& what,
                  const Parameter& parameter) {
  if (!std::isfinite(parameter.value))
    file.error(file.range(node.source()), fmt::format("{} is not finite in SI units", what));
}

/// The default value must lie in the range, which has the same unit.
void read_range(const TomlTable& table, const Unit& unit, Parameter& parameter) {
  const std::optional<std::array<double, 2>> range = table.constant_pair("range", {{parameter.unit}}, unit);
  if (!range || !table.has("value")) return;
  const auto [least, greatest] = *range;
  if (!(least < greatest))
    table.error("range",
                fmt::format("{} is empty: {} is not below {}", table.quoted("range"), least, greatest),
                "write the smaller number first");
  else if (!(least <= parameter.value && parameter.value <= greatest))
    table.error("range", fmt::format("{} is {}, outside its range from {} to {}", table.what(),
                                     parameter.value, least, greatest));
  parameter.range = {least, greatest};
}

/// The value is the number itself, or stands in a table with unit, description and range.
void read_value(TomlFile& file, const toml::node& node, Parameter& parameter) {
  const std::string what = fmt::format("parameter '{}'", support::shown(parameter.name));
  const toml::table* details = node.as_table();
  if (!details) {
    read_number(file, node, {what, needed::kAnything}, parameter);
    check_finite(file, node, what, parameter);
    return;
  }
  const TomlTable table(file, *details, what, file.range(node.source()), keys_of("parameter"));
  const std::optional<Unit> unit = table.unit("unit");
  if (table.has("unit") && unit) parameter.unit = *table.text("unit");
  parameter.description = table.text("description").value_or("");
  if (const toml::node* value = table.find("value"))
    read_number(file, *value, {what, needed::kAnything, unit}, parameter);
  else
    table.missing("value");
  if (!unit) return;
  if (unit->factor != 1) parameter.unit = unit->si;
  check_finite(file, node, what, parameter);
  read_range(table, *unit, parameter);
}

}  // namespace

std::vector<Parameter> read_parameters(TomlFile& file, const toml::table& section) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : section) entries.emplace_back(&key, &node);
  std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto &left = a.first->source().begin, &right = b.first->source().begin;
    return std::pair(left.line, left.column) < std::pair(right.line, right.column);
  });
  std::vector<Parameter> parameters;
  for (const auto& [key, node] : entries) {
    Parameter parameter{.name = std::string(key->str()), .unit = "", .description = ""};
    parameter.where = file.range(key->source());
    check_parameter_name(file, parameter);
    parameters.push_back(std::move(parameter));
  }
  // Values cannot use parameters; that their names are known makes for a better message.
  file.declare(parameters);
  for (std::size_t i = 0; i < entries.size(); ++i) read_value(file, *entries[i].second, parameters[i]);
  return parameters;
}

}  // namespace jourdain::model
