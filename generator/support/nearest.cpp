// "Did you mean": edit distance between names.
#include <algorithm>

#include "support/diagnostics.hpp"

namespace jourdain::support {

namespace {

constexpr std::size_t kLongestWord = 100;

/// Insertions, deletions, substitutions and swaps of neighbours from `a` to `b` (optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() < 2 || word.size() > kLongestWord) return "";
  std::size_t bound = std::max<std::size_t>(1, word.size() / 3);
  std::string best;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > word.size() + bound || word.size() > candidate.size() + bound) continue;
    const std::size_t edits = distance(word, candidate);
    if (edits > bound || (!best.empty() && edits == bound)) continue;
    best = candidate;
    bound = edits;
  }
  return best;
}

}  // namespace jourdain::support
