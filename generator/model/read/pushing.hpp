// What readers of elements that push and never pull share.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "model/expression_functions.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_names.hpp"
#include "model/read/toml_repeat.hpp"

namespace jourdain::model {

/// `force` where `depth` is positive, unless it would pull.
inline Expression pushing(const Expression& depth, const Expression& force) {
  return where_less(0.0, depth, false, Expression::function(support::Function::kMax, force, 0.0), 0.0);
}

/// Of unit length; `otherwise` after a diagnostic.
inline std::array<double, 3> unit_direction(const TomlTable& table, std::string_view key,
                                            const std::array<double, 3>& otherwise, std::string hint = "") {
  std::array<double, 3> direction = table.direction(key, otherwise);
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0) || !std::isfinite(length)) {
    table.error(key, fmt::format("{} has no direction", table.quoted(key)), std::move(hint));
    return otherwise;
  }
  for (double& component : direction) component /= length;
  return direction;
}

/// Calls `read` with each table of a section and its name.
template <class Read>
void for_each_table(TomlFile& file, const TomlTables& section, const char* kind, const Read& read) {
  std::size_t number = 0;
  for (const toml::node& node : section) {
    const std::string name = name_or_number(file, *node.as_table(), kind, ++number);
    const TomlTable table(file, *node.as_table(), fmt::format("{} '{}'", kind, support::shown(name)),
                          file.range(node.source()), keys_of(kind));
    read(table, name);
  }
}

}  // namespace jourdain::model
