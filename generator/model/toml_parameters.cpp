// [parameters]
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "model/toml_names.hpp"
#include "model/toml_sections.hpp"

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

/// The default value must lie in the range.
void read_range(const TomlTable& table, Parameter& parameter) {
  const std::optional<std::array<double, 2>> range = table.constant_pair("range");
  if (!range || !table.has("value")) return;
  const auto [least, greatest] = *range;
  if (!(least < greatest))
    table.error("range",
                fmt::format("{} is empty: {} is not below {}", table.quoted("range"), least, greatest),
                "write the smaller number first");
  else if (!(least <= parameter.value && parameter.value <= greatest))
    table.error("range", fmt::format("{} is {}, outside its range from {} to {}", table.what(),
                                     parameter.value, least, greatest));
  parameter.range = range;
}

/// The value is the number itself, or stands in a table with unit, description and range.
void read_value(TomlFile& file, const toml::node& node, Parameter& parameter) {
  const std::string what = fmt::format("parameter '{}'", support::shown(parameter.name));
  const toml::table* details = node.as_table();
  if (!details) {
    parameter.value = file.constant(node, what);
    return;
  }
  const TomlTable table(file, *details, what, file.range(node.source()),
                        {"value", "unit", "description", "range"});
  parameter.unit = table.text("unit").value_or("");
  parameter.description = table.text("description").value_or("");
  if (const toml::node* value = table.find("value"))
    parameter.value = file.constant(*value, what);
  else
    table.missing("value");
  read_range(table, parameter);
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
