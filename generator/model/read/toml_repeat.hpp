// The tables of a section: those that stand in the file, and those that [[repeat]] makes.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// All tables [[key]] in the order of the file, those of a [[repeat]] once for each value of its index, value by value.
/// While a loop over them looks at one, `file` reads texts with the index of its repetition.
class TomlTables {
 public:
  struct Item {
    const toml::node* table = nullptr;
    std::optional<Repetition> repetition = {};
  };

  class Iterator {
   public:
    Iterator(const TomlTables& tables, std::size_t position) : tables_(tables), position_(position) {}
    const toml::node& operator*() const;
    Iterator& operator++();
    bool operator!=(const Iterator& other) const { return position_ != other.position_; }

   private:
    const TomlTables& tables_;
    std::size_t position_;
  };

  TomlTables(TomlFile& file, std::vector<Item> items) : file_(file), items_(std::move(items)) {}

  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, items_.size()}; }
  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }

 private:
  TomlFile& file_;
  std::vector<Item> items_;
};

/// [[repeat]] as the file has it.
class Repeats {
 public:
  /// Reports what is wrong with the [[repeat]] tables of `root`; `sections` are the names of what they may hold.
  Repeats(TomlFile& file, const toml::table& root, const std::vector<std::string>& sections);

  /// The tables [[key]] of `root` and of its repeats; `is_single`: [key] may stand for one. None after a diagnostic,
  /// which leaves the file's structure incomplete.
  TomlTables tables(const std::string& key, bool is_single = false) const;

 private:
  struct Repeat {
    const toml::table* table = nullptr;
    int line = 0;  ///< of its header
    std::string index;
    std::int64_t first = 1, count = 0;
  };

  void read(const toml::node& node, const std::vector<std::string>& sections);
  std::int64_t integer(const TomlTable& table, std::string_view key, std::int64_t otherwise) const;
  /// The array [[key]] of a table; nothing where it has none, or after a diagnostic.
  const toml::array* array_of(const toml::table& table, const std::string& key) const;

  TomlFile& file_;
  const toml::table& root_;
  std::vector<Repeat> repeats_;
};

}  // namespace jourdain::model
