// Text in comma-separated columns: no quotes, blanks around a field do not count.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::support {

struct CsvField {
  std::string text;
  int column = 1;  ///< of its first character in the line, in bytes
};

struct CsvRow {
  int line = 1;
  std::vector<CsvField> fields;  ///< one or more
};

/// The rows of a text, without empty lines and a byte order mark before the first.
std::vector<CsvRow> csv_rows(std::string_view text);

/// The finite number that all of a field is; nothing where it is none.
std::optional<double> number_in(const CsvField& field);

}  // namespace jourdain::support
