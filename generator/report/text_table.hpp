// Tables of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace jourdain::report {

/// Rows under a line of heads, the first of which is the table's title; rows are indented below it.
class TextTable {
 public:
  /// Columns with a head that begins with '>' are aligned at their right ends.
  explicit TextTable(std::vector<std::string> heads) : heads_(std::move(heads)) {}

  /// As many cells as heads; further lines and tabs in them become blanks.
  void add(std::vector<std::string> cells);

  /// Empty without rows. Columns in which all cells are empty are left out.
  std::string text() const;

 private:
  std::vector<std::string> heads_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace jourdain::report
