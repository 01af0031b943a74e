#include "report/text_table.hpp"

#include <algorithm>
#include <string_view>

#include "support/check.hpp"
#include "support/utf8.hpp"

namespace jourdain::report {

namespace {

std::size_t width(const std::string& text) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++characters) i += support::utf8_at(text, i).bytes;
  return characters;
}

std::string on_one_line(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text;
}

struct Column {
  std::string head;
  bool right = false;
  std::size_t width = 0;  ///< 0: left out

  std::string padded(const std::string& cell) const {
    const std::string space(width - report::width(cell), ' ');
    return right ? space + cell : cell + space;
  }
};

}  // namespace

void TextTable::add(std::vector<std::string> cells) {
  JD_CHECK(cells.size() == heads_.size(), "{} cells in {} columns", cells.size(), heads_.size());
  for (std::string& cell : cells) cell = on_one_line(std::move(cell));
  rows_.push_back(std::move(cells));
}

std::string TextTable::text() const {
  if (rows_.empty()) return "";
  std::vector<Column> columns;
  for (std::size_t k = 0; k < heads_.size(); ++k) {
    const bool right = heads_[k].starts_with('>');
    Column& column = columns.emplace_back(Column{heads_[k].substr(right ? 1 : 0), right});
    for (const auto& row : rows_) column.width = std::max(column.width, width(row[k]));
    if (column.width > 0 && k > 0) column.width = std::max(column.width, width(column.head));
  }
  std::string text;
  const auto add_line = [&](const std::string& margin, auto&& cell_of) {
    std::string line;
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (columns[k].width > 0) line += (line.empty() ? margin : "  ") + columns[k].padded(cell_of(k));
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  columns[0].width = std::max(columns[0].width + 2, width(columns[0].head));
  add_line("  ", [&](std::size_t k) { return columns[k].head; });
  columns[0].width -= 2;
  for (const auto& row : rows_) add_line("    ", [&](std::size_t k) { return row[k]; });
  return text;
}

}  // namespace jourdain::report
