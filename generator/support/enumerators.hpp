// Tables of kinds with one row for each entry of an enum, which is asked at compile time.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::support {

namespace detail {

/// Compilers print a value of an enum by its name where it has one, otherwise as a cast: "(Colour)7".
template <auto kValue>
constexpr bool has_name() {
  constexpr std::string_view kText = __PRETTY_FUNCTION__;
  return kText[kText.rfind('=') + 2] != '(';
}

}  // namespace detail

/// Of an enum whose entries count from zero.
template <class Enum, std::size_t kFound = 0>
constexpr std::size_t entry_count() {
  if constexpr (detail::has_name<static_cast<Enum>(kFound)>())
    return entry_count<Enum, kFound + 1>();
  else
    return kFound;
}

/// All entries, in order.
template <class Enum>
constexpr std::array<Enum, entry_count<Enum>()> entries_of() {
  std::array<Enum, entry_count<Enum>()> entries{};
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = static_cast<Enum>(i);
  return entries;
}

/// Whether the rows, each with its entry of the enum in `key`, are those of all entries, in their order.
template <class Row, std::size_t kRows, class Enum>
constexpr bool is_complete(const std::array<Row, kRows>& table, Enum Row::*key) {
  for (std::size_t i = 0; i < kRows; ++i)
    if (table[i].*key != static_cast<Enum>(i)) return false;
  return kRows == entry_count<Enum>();
}

/// The rows' names, in order.
template <class Row, std::size_t kRows>
std::vector<std::string> names_of(const std::array<Row, kRows>& table) {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  return names;
}

}  // namespace jourdain::support
