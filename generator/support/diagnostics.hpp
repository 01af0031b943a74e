// Diagnostics with source positions: all problems of a model are collected and shown in one run.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace jourdain::support {

/// Where something stands in a text file. Lines and columns count from 1, columns in Unicode characters; line
/// 0 means "the file as a whole". `length` is the number of columns to underline. `file` is that of Diagnostics: 0 is
/// the one that was asked for, the others are imported.
struct SourceRange {
  int line = 0;
  int column = 0;
  int length = 1;
  int file = 0;
};

enum class Severity { kError, kWarning, kNote };

struct Diagnostic {
  Severity severity = Severity::kError;
  SourceRange where;
  std::string message;
  std::string hint;  ///< printed after the caret line; may be empty
};

/// A file that diagnostics are about.
struct SourceFile {
  std::string path;
  std::string text;
  SourceRange imported_at = {};  ///< in the file that imports it; of the first file nothing
};

/// The diagnostics of a file and of those that it imports, in the order found. Holds their texts so that lines can be
/// shown.
class Diagnostics {
 public:
  Diagnostics(std::string path, std::string text) : files_{{std::move(path), std::move(text)}} {}

  void error(SourceRange where, std::string message, std::string hint = "");
  void warning(SourceRange where, std::string message, std::string hint = "");
  void note(SourceRange where, std::string message, std::string hint = "");

  /// Drops what was found; texts stay.
  void forget() { all_.clear(); }
  bool has_errors() const;
  const std::vector<Diagnostic>& all() const { return all_; }
  /// Of the first file.
  const std::string& path() const { return files_[0].path; }
  const std::string& text() const { return files_[0].text; }
  const std::deque<SourceFile>& files() const { return files_; }

  /// Takes over what was found in a file that was read by itself and is imported at `where`, and in those that it
  /// imports. The number of its first file here: what its ranges' `file` grows by.
  int absorb(Diagnostics imported, SourceRange where);

  /// "line 7", as said at `from`; "line 7 of arm.urdf" where that is another file.
  std::string line_in_words(const SourceRange& where, const SourceRange& from) const;

  /// `path:line:column: error: message`, the source line with a caret, the hint, of an imported file a line where that
  /// happens. Sorted by file and position, duplicates dropped (a file may be imported twice); control characters in
  /// source lines are shown as '?', long lines are cut around the caret. At most `limit` errors and `limit` warnings
  /// and notes are shown, the rest is counted.
  std::string format(std::size_t limit = 50) const;

 private:
  const SourceFile& file(const SourceRange& where) const {
    return files_[static_cast<std::size_t>(where.file)];
  }
  std::vector<Diagnostic> sorted_and_unique() const;
  std::string imports_of(SourceRange where) const;

  std::deque<SourceFile> files_;  ///< their texts stay where they are
  std::vector<Diagnostic> all_;
};

/// Text from a file as it may stand in a message: control characters and invalid UTF-8 become '?', what exceeds 60
/// characters becomes "...".
std::string shown(std::string_view text);

/// The candidate nearest to `word` by edit distance, a swap of neighbours counting as one edit (at most a third of
/// its length, at least 1, and less than its length), or "".
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace jourdain::support
