// [parameters]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/expression_functions.hpp"
#include "model/read/keys.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_sections.hpp"

namespace jourdain::model {

namespace {

void check_parameter_name(TomlFile& file, const Parameter& parameter) {
  const std::string& name = parameter.name;
  check_identifier(file, parameter.where, "parameter", name);
  if (is_expression_word(name))
    file.error(parameter.where,
               fmt::format("parameter '{}' would hide what '{}' means in expressions", name, name));
  else if (is_reserved(name))
    file.error(parameter.where,
               fmt::format("parameter name '{}' is reserved in C++ or in the emitted code", name),
               is_reserved(name + "_value") ? "" : fmt::format("'{}_value' would do", name));
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

/// A parameter as the section has it, and those that its value names.
struct Entry {
  const toml::node* node = nullptr;
  Parameter parameter;
  std::vector<std::size_t> names = {};  ///< other entries; none: tunable
  std::size_t waits_for = 0;            ///< of those the ones that have no value yet
};

/// Where the value stands, itself or in a table.
const toml::node* value_node(const toml::node& node) {
  const toml::table* details = node.as_table();
  return details ? details->get("value") : &node;
}

/// The entries that the value of one names; none where it is no expression.
std::vector<std::size_t> named_entries(const toml::node& node,
                                       const std::vector<DeclaredParameter>& declared) {
  const toml::node* value = value_node(node);
  const toml::value<std::string>* text = value ? value->as_string() : nullptr;
  if (!text) return {};
  const auto result = parse_expression(text->get(), declared);
  const auto* measured = std::get_if<MeasuredExpression>(&result);
  std::vector<std::size_t> names;
  for (const Expression::Node& part :
       measured ? measured->expression.nodes() : std::vector<Expression::Node>())
    if (part.op == Expression::Op::kParameter &&
        std::find(names.begin(), names.end(), part.parameter.value) == names.end())
      names.push_back(part.parameter.value);
  return names;
}

/// Whether a parameter with a unit stands in the expression: then bare numbers of another unit make no sense.
bool has_unit(const toml::node& value, const std::vector<DeclaredParameter>& declared) {
  const auto result = parse_expression(value.as_string()->get(), declared);
  const auto* measured = std::get_if<MeasuredExpression>(&result);
  return measured && measured->measure.is_anchored();
}

/// The unit that follows from the expression; empty where it has none that is known.
std::string unit_of(const std::string& text, const std::vector<DeclaredParameter>& declared) {
  const auto result = parse_expression(text, declared);
  const auto* measured = std::get_if<MeasuredExpression>(&result);
  if (!measured || !measured->measure.is_known()) return "";
  return measured->measure.is_pure() ? "1" : measured->measure.unit();
}

/// A unit that is given is one that the expression must have; one that is a multiple of an SI unit says what bare
/// numbers are in. After a diagnostic 1, of any unit.
DerivedParameter read_derived(TomlFile& file, const Entry& entry) {
  DerivedParameter derived{
      .name = entry.parameter.name, .value = 1.0, .unit = "", .where = entry.parameter.where};
  const std::size_t mark = file.error_count();
  Place place{fmt::format("parameter '{}'", support::shown(derived.name)), needed::kAnything};
  std::string written;
  if (const toml::table* details = entry.node->as_table()) {
    const TomlTable table(file, *details, place.what, file.range(entry.node->source()), keys_of("parameter"));
    const std::optional<Unit> unit = table.unit("unit");
    if (table.has("unit") && unit) {
      written = *table.text("unit");
      derived.unit = unit->factor == 1 ? written : unit->si;
      place.needed = {{derived.unit}};
      if (unit->factor != 1) place.unit = unit;
      if (place.unit && has_unit(*value_node(*entry.node), file.declared()))
        table.error("unit", fmt::format("{} has two units", place.what),
                    "the expression has that of its parameters");
    }
    table.text("description");
    if (table.has("range"))
      table.error("range", fmt::format("{} follows from others and has no 'range'", place.what),
                  "it follows from theirs");
  }
  const toml::node& value = *value_node(*entry.node);
  const Expression expression = file.expression(value, place);
  if (file.error_count() != mark) return {derived.name, 1.0, "", derived.where};
  derived.value = expression;
  if (derived.unit.empty()) derived.unit = unit_of(value.as_string()->get(), file.declared());
  return derived;
}

/// Entries that follow from each other in turn; `start` is one that never becomes ready.
std::vector<std::size_t> cycle(const std::vector<Entry>& entries, std::size_t start) {
  std::vector<std::size_t> way;
  std::size_t at = start;
  while (std::find(way.begin(), way.end(), at) == way.end()) {
    way.push_back(at);
    const std::vector<std::size_t>& names = entries[at].names;
    at = *std::find_if(names.begin(), names.end(), [&](std::size_t i) { return entries[i].waits_for > 0; });
  }
  way.erase(way.begin(), std::find(way.begin(), way.end(), at));
  std::rotate(way.begin(), std::min_element(way.begin(), way.end()), way.end());
  return way;
}

void report_cycle(TomlFile& file, const std::vector<Entry>& entries, std::size_t start) {
  const std::vector<std::size_t> members = cycle(entries, start);
  const Parameter& first = entries[members[0]].parameter;
  std::string way = first.name;
  for (std::size_t i = 1; i <= members.size(); ++i)
    way += " from " + entries[members[i % members.size()]].parameter.name;
  file.error(first.where, fmt::format("parameter '{}' follows from itself", support::shown(first.name)),
             support::shown(way));
}

/// Those whose value names others, each behind what it names.
void read_derived(TomlFile& file, std::vector<Entry>& entries, Mechanism& mechanism) {
  std::vector<std::size_t> ready;
  std::vector<std::vector<std::size_t>> waiting(entries.size());
  std::size_t left = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].names.empty())
      ready.push_back(i);
    else
      ++left;
    entries[i].waits_for = entries[i].names.size();
    for (const std::size_t name : entries[i].names) waiting[name].push_back(i);
  }
  for (std::size_t next = 0; next < ready.size(); ++next) {
    const std::size_t i = ready[next];
    if (!entries[i].names.empty()) {
      mechanism.derived.push_back(read_derived(file, entries[i]));
      file.declare(mechanism.derived.back());
      --left;
    }
    for (const std::size_t other : waiting[i])
      if (--entries[other].waits_for == 0) ready.push_back(other);
  }
  const auto stuck =
      std::find_if(entries.begin(), entries.end(), [](const Entry& e) { return e.waits_for > 0; });
  if (left == 0) return;
  report_cycle(file, entries, static_cast<std::size_t>(stuck - entries.begin()));
  for (const Entry& entry : entries)
    if (entry.waits_for > 0)
      mechanism.derived.push_back({entry.parameter.name, 1.0, "", entry.parameter.where});
}

std::vector<Entry> entries_of(TomlFile& file, const toml::table& section) {
  std::vector<std::pair<const toml::key*, const toml::node*>> nodes;
  for (const auto& [key, node] : section) nodes.emplace_back(&key, &node);
  std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) {
    const auto &left = a.first->source().begin, &right = b.first->source().begin;
    return std::pair(left.line, left.column) < std::pair(right.line, right.column);
  });
  std::vector<Entry> entries;
  for (const auto& [key, node] : nodes) {
    Parameter parameter{.name = std::string(key->str()), .unit = "", .description = ""};
    parameter.where = file.range(key->source());
    check_parameter_name(file, parameter);
    entries.push_back({node, std::move(parameter)});
  }
  return entries;
}

}  // namespace

void read_parameters(TomlFile& file, const toml::table& section, Mechanism& mechanism) {
  std::vector<Entry> entries = entries_of(file, section);
  std::vector<Parameter> all;
  for (const Entry& entry : entries) all.push_back(entry.parameter);
  // That all names are known makes for a better message where a number must be constant.
  file.declare(all);
  const std::vector<DeclaredParameter> declared = file.declared();
  std::size_t derived = 0;
  for (Entry& entry : entries) {
    entry.names = named_entries(*entry.node, declared);
    derived += !entry.names.empty();
    if (derived > kMaximumBodies) {
      file.error(entry.parameter.where,
                 fmt::format("more than {} parameters follow from others", kMaximumBodies));
      return;
    }
    if (!entry.names.empty()) continue;
    read_value(file, *entry.node, entry.parameter);
    mechanism.parameters.push_back(entry.parameter);
  }
  file.declare(mechanism);
  read_derived(file, entries, mechanism);
}

}  // namespace jourdain::model
