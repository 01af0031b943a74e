#include "support/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
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
  return std::tie(a.where.line, a.where.column) < std::tie(b.where.line, b.where.column);
}

bool same(const Diagnostic& a, const Diagnostic& b) {
  return a.severity == b.severity && a.where.line == b.where.line && a.where.column == b.where.column &&
         a.message == b.message;
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

std::string Diagnostics::format(std::size_t limit) const {
  std::vector<Diagnostic> sorted = all_;
  std::stable_sort(sorted.begin(), sorted.end(), before);
  std::vector<Diagnostic> unique;
  for (Diagnostic& diagnostic : sorted) {
    const auto seen = [&](const Diagnostic& other) { return same(other, diagnostic); };
    const auto first = std::lower_bound(unique.begin(), unique.end(), diagnostic, before);
    if (std::none_of(first, unique.end(), seen)) unique.push_back(std::move(diagnostic));
  }

  const LineIndex lines(text_);
  std::string out;
  std::size_t errors = 0;
  std::size_t others = 0;
  for (const Diagnostic& diagnostic : unique) {
    std::size_t& count = diagnostic.severity == Severity::kError ? errors : others;
    if (++count > limit) continue;
    const std::string message = printable(diagnostic.message);
    if (diagnostic.where.line == 0) {
      out += fmt::format("{}: {}: {}\n", path_, severity_name(diagnostic.severity), message);
      if (!diagnostic.hint.empty()) out += fmt::format("{:>5} | {}\n", "", printable(diagnostic.hint));
      continue;
    }
    out += fmt::format("{}:{}:{}: {}: {}\n", path_, diagnostic.where.line, diagnostic.where.column,
                       severity_name(diagnostic.severity), message);
    out += excerpt(lines.line(diagnostic.where.line), diagnostic);
  }
  if (errors > limit) out += fmt::format("{}: {} more errors are not shown\n", path_, errors - limit);
  if (others > limit)
    out += fmt::format("{}: {} more warnings and notes are not shown\n", path_, others - limit);
  return out;
}

std::string shown(std::string_view text) {
  constexpr int kLongest = 60;
  const std::string_view beginning = characters_between(text, 1, kLongest);
  return printable(beginning) + (beginning.size() < text.size() ? "..." : "");
}

}  // namespace jourdain::support
