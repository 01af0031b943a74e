// [[repeat]]
#include "model/read/toml_repeat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "model/names.hpp"
#include "model/read/keys.hpp"
#include "model/read/read.hpp"

namespace jourdain::model {

namespace {

using support::shown;

constexpr std::int64_t kLargestIndex = 1'000'000;
constexpr const char* kIndexHint = "an index is written {i}, {i+1}, {i-1}";

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// What stands between braces: the index, and an integer that is added. Nothing where it is something else.
std::optional<std::int64_t> value_of(std::string_view inside, const Repetition& repetition) {
  const std::size_t sign = inside.find_first_of("+-");
  if (without_blanks(inside.substr(0, sign)) != repetition.index) return {};
  if (sign == std::string_view::npos) return repetition.value;
  const std::string_view digits = without_blanks(inside.substr(sign + 1));
  std::int64_t added = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), added);
  const bool sound =
      error == std::errc() && stop == digits.data() + digits.size() && added >= 0 && added <= kLargestIndex;
  if (!sound) return {};
  return repetition.value + (inside[sign] == '+' ? added : -added);
}

}  // namespace

void TomlFile::repeat(const std::optional<Repetition>& repetition) { repetition_ = repetition; }

std::string TomlFile::text(const toml::value<std::string>& written) {
  return text(written.get(), range(written.source()));
}

std::string TomlFile::text(const std::string& text, const SourceRange& where) {
  if (!repetition_ || text.find('{') == std::string::npos) return text;
  std::string meant;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t open = std::min(text.find('{', i), text.size());
    meant += text.substr(i, open - i);
    if (open == text.size()) break;
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) {
      error(where, "'{' has no '}' behind it", kIndexHint);
      return text;
    }
    const std::string inside = text.substr(open + 1, close - open - 1);
    const std::optional<std::int64_t> value = value_of(inside, *repetition_);
    if (!value) {
      error(
          where,
          fmt::format("'{{{}}}' is not the index '{}' of the [[repeat]]", shown(inside), repetition_->index),
          kIndexHint);
      return text;
    }
    meant += fmt::format("{}", *value);
    i = close + 1;
  }
  return meant;
}

std::string TomlFile::text_or(const toml::table& table, std::string_view key, std::string otherwise) {
  const toml::node* node = table.get(key);
  const toml::value<std::string>* written = node ? node->as_string() : nullptr;
  return written ? text(*written) : std::move(otherwise);
}

const toml::node& TomlTables::Iterator::operator*() const {
  const Item& item = tables_.items_[position_];
  tables_.file_.repeat(item.repetition);
  return *item.table;
}

TomlTables::Iterator& TomlTables::Iterator::operator++() {
  tables_.file_.repeat({});
  ++position_;
  return *this;
}

Repeats::Repeats(TomlFile& file, const toml::table& root, const std::vector<std::string>& sections)
    : file_(file), root_(root) {
  if (const toml::array* array = array_of(root, "repeat"))
    for (const toml::node& node : *array) read(node, sections);
}

std::int64_t Repeats::integer(const TomlTable& table, std::string_view key, std::int64_t otherwise) const {
  if (!table.has(key)) return otherwise;
  const toml::value<std::int64_t>* number = table.find(key)->as_integer();
  if (number && std::abs(number->get()) <= kLargestIndex) return number->get();
  table.error(key, fmt::format("{} must be an integer within ±{}", table.quoted(key), kLargestIndex));
  file_.complete().structure = false;
  return otherwise;
}

void Repeats::read(const toml::node& node, const std::vector<std::string>& sections) {
  std::vector<std::string> known = keys_of("repeat");
  known.insert(known.end(), sections.begin(), sections.end());
  const TomlTable table(file_, *node.as_table(), "a repeat", file_.range(node.source()), known);
  Repeat repeat{node.as_table(), line_of(node), table.text("index").value_or("i")};
  repeat.first = integer(table, "first", 1);
  repeat.count = integer(table, "count", 0);
  if (!table.has("count")) {
    table.missing("count", "how often its tables are made");
    file_.complete().structure = false;
  } else if (repeat.count < 0 || repeat.count > static_cast<std::int64_t>(kMaximumBodies)) {
    table.error("count", fmt::format("{} is {}, not from 0 to {}", table.quoted("count"), repeat.count,
                                     kMaximumBodies));
    file_.complete().structure = false;
    return;
  }
  if (!is_identifier(repeat.index)) {
    file_.complete().structure = false;
    return table.error(
        "index", fmt::format("{} '{}' is not an identifier", table.quoted("index"), shown(repeat.index)),
        "letters, digits and '_' only, and no digit first");
  }
  repeats_.push_back(std::move(repeat));
}

const toml::array* Repeats::array_of(const toml::table& table, const std::string& key) const {
  const toml::node* node = table.get(key);
  if (!node) return nullptr;
  const toml::array* array = node->as_array();
  if (array && (array->empty() || array->is_homogeneous(toml::node_type::table))) return array;
  file_.complete().structure = false;
  file_.error(file_.range(node->source()), fmt::format("'{}' must be a list of tables", key),
              fmt::format("write [[{}]] for each one", key));
  return nullptr;
}

TomlTables Repeats::tables(const std::string& key, bool is_single) const {
  std::vector<TomlTables::Item> items;
  const toml::node* own = root_.get(key);
  const bool single = is_single && own && own->is_table();
  if (single) items.push_back({own});
  if (const toml::array* array = single ? nullptr : array_of(root_, key))
    for (const toml::node& node : *array) items.push_back({&node});
  std::size_t count = items.size();
  const toml::node* where = own;
  for (const Repeat& repeat : repeats_) {
    const auto before = std::find_if(items.begin(), items.end(), [&](const TomlTables::Item& item) {
      return line_of(*item.table) > repeat.line;
    });
    const toml::array* array = array_of(*repeat.table, key);
    if (!array) continue;
    where = array;
    count += array->size() * static_cast<std::size_t>(repeat.count);
    if (count > kMaximumBodies) break;
    std::vector<TomlTables::Item> made;
    for (std::int64_t i = 0; i < repeat.count; ++i)
      for (const toml::node& node : *array)
        made.push_back({&node, Repetition{repeat.index, repeat.first + i}});
    items.insert(before, made.begin(), made.end());
  }
  if (count <= kMaximumBodies) return {file_, std::move(items)};
  file_.complete().structure = false;
  file_.error(file_.range(where->source()),
              fmt::format("the file has {} [[{}]] tables, more than {}", count, key, kMaximumBodies));
  return {file_, {}};
}

}  // namespace jourdain::model
