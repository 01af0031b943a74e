#include "commands/ensemble_result.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace jourdain::commands {

namespace {

/// Names and values as they are printed.
using Lines = std::vector<std::pair<std::string, std::string>>;

Lines lines_of(const EnsembleFacts& facts) {
  Lines lines;
  for_each_fact(facts, [&](const char* name, const auto& value) {
    lines.emplace_back(name, fmt::format("{}", value));
  });
  return lines;
}

/// Of the entries of two lists the first that differ.
template <class Value>
std::string difference_of_lists(const char* list, const std::vector<std::pair<std::string, Value>>& of,
                                const std::vector<std::pair<std::string, Value>>& from) {
  const auto entry = [](const auto& entries, std::size_t i) {
    return i < entries.size() ? fmt::format("{} = {}", entries[i].first, entries[i].second)
                              : std::string("none");
  };
  for (std::size_t i = 0; i < std::max(of.size(), from.size()); ++i)
    if (i >= of.size() || i >= from.size() || of[i] != from[i])
      return fmt::format("of its {} number {} is {}, not {}", list, i + 1, entry(of, i), entry(from, i));
  return "";
}

}  // namespace

std::size_t EnsembleResult::drawn_count() const {
  return static_cast<std::size_t>(
      std::count_if(columns.begin(), columns.end(), [](const EnsembleColumn& c) { return c.is_drawn; }));
}

std::vector<double> EnsembleResult::of_trusted(const std::vector<double>& values_of_all) const {
  std::vector<double> chosen;
  chosen.reserve(values_of_all.size());
  for (std::size_t k = 0; k < values_of_all.size(); ++k)
    if (trusted[k]) chosen.push_back(values_of_all[k]);
  return chosen;
}

std::uint64_t judged_count(const Shard& shard) { return std::min(shard.size(), kJudged); }

std::string difference(const EnsembleResult& of, const EnsembleResult& from) {
  const Lines lines = lines_of(of.facts), other_lines = lines_of(from.facts);
  // The program last: where something else differs, that says more.
  std::string last;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& [name, value] = lines[i];
    if (value == other_lines[i].second) continue;
    std::string text = fmt::format("{} is {}, not {}", name, value, other_lines[i].second);
    if (name != "program_sha256") return text;
    last = text + ": other options, or another model";
  }
  const EnsembleFacts &a = of.facts, &b = from.facts;
  for (const std::string& text : {difference_of_lists("parameters", a.parameters, b.parameters),
                                  difference_of_lists("inputs", a.inputs, b.inputs),
                                  difference_of_lists("spreads", a.spreads, b.spreads)})
    if (!text.empty()) return text;
  return last.empty() && of.columns != from.columns ? "its columns are other ones" : last;
}

}  // namespace jourdain::commands
