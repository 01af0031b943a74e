// Tables of text with aligned columns.
#pragma once

#include <string>
#include <vector>

namespace jourdain::commands {

/// A title over a first column and further ones; what has no cell is left out.
class TextTable {
 public:
  /// `heads`: of the columns, the first is the table's title. Columns with a head that begins with '>' are aligned at their right ends.
  explicit TextTable(std::vector<std::string> heads) : heads_(std::move(heads)) {}

  /// As many cells as heads; further lines and tabs in them become blanks.
  void add(std::vector<std::string> cells);

  /// Empty without rows. Columns in which all cells are empty are left out.
  std::string text() const;

 private:
  std::vector<std::string> heads_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace jourdain::commands
