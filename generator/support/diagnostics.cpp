#include "support/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

#include "support/line_index.hpp"
#include "support/utf8.hpp"

namespace jourdain::support {

namespace {

constexpr int kShownBefore = 60;  ///< characters of a long line before the underlined part
constexpr int kShownAfter = 40;   ///< and behind its beginning

/// Printable characters as they are, tabs as a blank, all others as '?'.
std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const Utf8Character character = utf8_at(text, i);
    if (character.printable)
      out += text.substr(i, character.bytes);
    else
      out += text[i] == '\t' ? ' ' : '?';
    i += character.bytes;
  }
  return out;
}

std::string_view severity_name(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kNote:
      return "note";
  }
  return "";
}

bool before(const Diagnostic& a, const Diagnostic& b) {
  return std::tie(a.where.file, a.where.line, a.where.column) <
         std::tie(b.where.file, b.where.line, b.where.column);
}

/// Bytes of `line` from the character at `first` up to the one at `last` (from 1, inclusive).
std::string_view characters_between(std::string_view line, int first, int last) {
  std::size_t i = 0;
  int column = 1;
  for (; column < first && i < line.size(); ++column) i += utf8_at(line, i).bytes;
  const std::size_t begin = i;
  for (; column <= last && i < line.size(); ++column) i += utf8_at(line, i).bytes;
  return line.substr(begin, i - begin);
}

/// The source line with what is wrong underlined.
std::string excerpt(std::string_view line, const Diagnostic& diagnostic) {
  const int column = std::max(1, diagnostic.where.column);
  const int first = column > kShownBefore + kShownAfter ? column - kShownBefore : 1;
  const int last = std::max(first + kShownBefore + kShownAfter, column + kShownAfter);
  const std::string_view visible = characters_between(line, first, last);
  const std::string_view head = characters_between(visible, 1, column - first);
  const std::string_view marked = characters_between(visible, column - first + 1, last);
  const bool cut_left = first > 1;
  const bool cut_right =
      visible.empty() ? false : visible.data() + visible.size() < line.data() + line.size();

  int room = 0;
  for (std::size_t i = 0; i < marked.size(); i += utf8_at(marked, i).bytes) ++room;
  const int underlined = std::max(1, std::min(diagnostic.where.length, room));
  std::size_t indent = cut_left ? 3 : 0;
  for (std::size_t i = 0; i < head.size(); i += utf8_at(head, i).bytes) ++indent;
  return fmt::format("{:>5} | {}{}{}\n{:>5} | {}^{}{}{}\n", diagnostic.where.line, cut_left ? "..." : "",
                     printable(visible), cut_right ? "..." : "", "", std::string(indent, ' '),
                     std::string(static_cast<std::size_t>(underlined - 1), '~'),
                     diagnostic.hint.empty() ? "" : " ", printable(diagnostic.hint));
}

}  // namespace

void Diagnostics::error(SourceRange where, std::string message, std::string hint) {
  all_.push_back({Severity::kError, where, std::move(message), std::move(hint)});
}

void Diagnostics::warning(SourceRange where, std::string message, std::string hint) {
  all_.push_back({Severity::kWarning, where, std::move(message), std::move(hint)});
}

void Diagnostics::note(SourceRange where, std::string message, std::string hint) {
  all_.push_back({Severity::kNote, where, std::move(message), std::move(hint)});
}

bool Diagnostics::has_errors() const {
  return std::any_of(all_.begin(), all_.end(),
                     [](const Diagnostic& d) { return d.severity == Severity::kError; });
}

int Diagnostics::absorb(Diagnostics imported, SourceRange where) {
  const int shift = static_cast<int>(files_.size());
  imported.files_[0].imported_at = where;
  for (std::size_t i = 1; i < imported.files_.size(); ++i) imported.files_[i].imported_at.file += shift;
  for (Diagnostic& diagnostic : imported.all_) diagnostic.where.file += shift;
  std::move(imported.files_.begin(), imported.files_.end(), std::back_inserter(files_));
  std::move(imported.all_.begin(), imported.all_.end(), std::back_inserter(all_));
  return shift;
}

std::string Diagnostics::line_in_words(const SourceRange& where, const SourceRange& from) const {
  const std::string line = fmt::format("line {}", where.line);
  return where.file == from.file ? line : fmt::format("{} of {}", line, shown(file(where).path));
}

/// A file that is imported twice says everything once.
std::vector<Diagnostic> Diagnostics::sorted_and_unique() const {
  std::vector<Diagnostic> sorted = all_;
  std::stable_sort(sorted.begin(), sorted.end(), before);
  std::set<std::tuple<std::string_view, int, int, Severity, std::string>> seen;
  std::vector<Diagnostic> unique;
  for (Diagnostic& diagnostic : sorted) {
    const SourceRange& where = diagnostic.where;
    if (seen.emplace(file(where).path, where.line, where.column, diagnostic.severity, diagnostic.message)
            .second)
      unique.push_back(std::move(diagnostic));
  }
  return unique;
}

/// A line for each import that leads to the file of `where`, outermost last.
std::string Diagnostics::imports_of(SourceRange where) const {
  std::string lines;
  while (where.file != 0) {
    where = file(where).imported_at;
    lines += fmt::format("{:>5} | imported at {}:{}:{}\n", "", printable(file(where).path), where.line,
                         where.column);
  }
  return lines;
}

std::string Diagnostics::format(std::size_t limit) const {
  std::vector<LineIndex> lines;
  for (const SourceFile& source : files_) lines.emplace_back(source.text);
  std::string out;
  std::size_t errors = 0;
  std::size_t others = 0;
  for (const Diagnostic& diagnostic : sorted_and_unique()) {
    std::size_t& count = diagnostic.severity == Severity::kError ? errors : others;
    if (++count > limit) continue;
    const SourceRange& where = diagnostic.where;
    const std::string& path = file(where).path;
    const std::string message = printable(diagnostic.message);
    if (where.line == 0) {
      out += fmt::format("{}: {}: {}\n", path, severity_name(diagnostic.severity), message);
      if (!diagnostic.hint.empty()) out += fmt::format("{:>5} | {}\n", "", printable(diagnostic.hint));
    } else {
      out += fmt::format("{}:{}:{}: {}: {}\n", path, where.line, where.column,
                         severity_name(diagnostic.severity), message);
      out += excerpt(lines[static_cast<std::size_t>(where.file)].line(where.line), diagnostic);
    }
    out += imports_of(where);
  }
  if (errors > limit) out += fmt::format("{}: {} more errors are not shown\n", path(), errors - limit);
  if (others > limit)
    out += fmt::format("{}: {} more warnings and notes are not shown\n", path(), others - limit);
  return out;
}

std::string shown(std::string_view text) {
  constexpr int kLongest = 60;
  const std::string_view beginning = characters_between(text, 1, kLongest);
  return printable(beginning) + (beginning.size() < text.size() ? "..." : "");
}

}  // namespace jourdain::support
