#include "support/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace jourdain::support {

namespace {

/// What spreadsheets write before UTF-8.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::vector<CsvField> fields_of(std::string_view line) {
  std::vector<CsvField> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
    fields.push_back({std::string(line.substr(first, last - first)), static_cast<int>(first) + 1});
    begin = end + 1;
  }
  return fields;
}

}  // namespace

std::vector<CsvRow> csv_rows(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<CsvRow> rows;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number;
    if (!line.empty()) rows.push_back({number, fields_of(line)});
    begin = end + 1;
  }
  return rows;
}

std::optional<double> number_in(const CsvField& field) {
  double value = 0;
  const char* end = field.text.data() + field.text.size();
  const auto [rest, code] = std::from_chars(field.text.data(), end, value);
  if (code == std::errc() && rest == end && std::isfinite(value)) return value;
  return {};
}

}  // namespace jourdain::support
