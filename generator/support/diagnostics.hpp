// Diagnostics with source positions: all problems of a model are collected and shown in one run.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jourdain::support {

/// Where something stands in a text file. Lines and columns count from 1, columns in Unicode characters; line
/// 0 means "the file as a whole". `length` is the number of columns to underline.
struct SourceRange {
  int line = 0;
  int column = 0;
  int length = 1;
};

enum class Severity { kError, kWarning, kNote };

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceRange where;
  std::string message;
  std::string hint;  ///< printed after the caret line; may be empty
};

/// The diagnostics of one file, in the order found. Holds the file's text so that lines can be shown.
class Diagnostics {
 public:
  Diagnostics(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {}

  void error(SourceRange where, std::string message, std::string hint = "");
  void warning(SourceRange where, std::string message, std::string hint = "");
  void note(SourceRange where, std::string message, std::string hint = "");

  bool has_errors() const;
  const std::vector<Diagnostic>& all() const { return all_; }
  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }

  /// `path:line:column: error: message`, the source line with a caret, the hint. Sorted by position, duplicates
  /// dropped; control characters in source lines are shown as '?', long lines are cut around the caret. At most
  /// `limit` errors and `limit` warnings and notes are shown, the rest is counted.
  std::string format(std::size_t limit = 50) const;

 private:
  std::string path_;
  std::string text_;
  std::vector<Diagnostic> all_;
};

/// Text from a file as it may stand in a message: control characters and invalid UTF-8 become '?', what exceeds 60
/// characters becomes "...".
std::string shown(std::string_view text);

/// The candidate nearest to `word` by edit distance, a swap of neighbours counting as one edit (at most a third of
/// its length, at least 1, and less than its length), or "".
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace jourdain::support
