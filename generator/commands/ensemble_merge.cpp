#include "commands/ensemble_merge.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace jourdain::commands {

namespace {

struct Range {
  std::uint64_t begin = 0, end = 0;

  std::string text() const {
    return end - begin == 1 ? fmt::format("{}", begin) : fmt::format("{} to {}", begin, end - 1);
  }
};

/// In the order of their states.
std::vector<const StoredShard*> in_order(const std::vector<StoredShard>& shards) {
  std::vector<const StoredShard*> sorted;
  for (const StoredShard& shard : shards) sorted.push_back(&shard);
  std::stable_sort(sorted.begin(), sorted.end(), [](const StoredShard* a, const StoredShard* b) {
    return a->result.shard.begin < b->result.shard.begin;
  });
  return sorted;
}

std::vector<std::string> overlaps(const std::vector<const StoredShard*>& sorted) {
  std::vector<std::string> sentences;
  const StoredShard* last = nullptr;  // the one that reaches farthest
  for (const StoredShard* shard : sorted) {
    const Shard& states = shard->result.shard;
    if (last && states.begin < last->result.shard.end) {
      const Range both{states.begin, std::min(states.end, last->result.shard.end)};
      sentences.push_back(fmt::format("{} and {} both have states {}", last->path, shard->path, both.text()));
    }
    if (!last || states.end > last->result.shard.end) last = shard;
  }
  return sentences;
}

std::vector<Range> gaps(const std::vector<const StoredShard*>& sorted, std::uint64_t states) {
  std::vector<Range> missing;
  std::uint64_t next = 0;
  for (const StoredShard* shard : sorted) {
    const Shard& part = shard->result.shard;
    if (part.begin > next) missing.push_back({next, part.begin});
    next = std::max(next, part.end);
  }
  if (next < states) missing.push_back({next, states});
  return missing;
}

/// The first few of a list, and how many more there are.
class Enumeration {
 public:
  void add(const std::string& entry) {
    if (++count_ <= kShown) text_ += (text_.empty() ? "" : ", ") + entry;
  }
  std::string text() const {
    return count_ > kShown ? fmt::format("{} and {} more", text_, count_ - kShown) : text_;
  }

 private:
  static constexpr std::size_t kShown = 20;
  std::size_t count_ = 0;
  std::string text_;
};

/// The parts that hold the missing states, of shards that were cut alike.
std::string parts_text(const Shard& cut, std::uint64_t states, const std::vector<Range>& missing) {
  Enumeration parts;
  auto gap = missing.begin();
  for (std::uint64_t part = 1; gap != missing.end() && part <= cut.parts; ++part) {
    const Shard shard = shard_of(states, part, cut.parts);
    if (shard.begin < gap->begin) continue;
    parts.add("--shard " + shard.text());
    if (shard.end == gap->end) ++gap;
  }
  return parts.text();
}

std::string missing_text(const std::vector<StoredShard>& shards, const std::vector<Range>& missing) {
  Enumeration ranges;
  for (const Range& range : missing) ranges.add(range.text());
  const Shard& cut = shards.front().result.shard;
  const std::uint64_t states = shards.front().result.facts.states;
  const bool is_cut_alike = std::all_of(shards.begin(), shards.end(), [&](const StoredShard& shard) {
    return shard.result.shard.parts == cut.parts;
  });
  return fmt::format("states {} of {} are missing{}", ranges.text(), states,
                     is_cut_alike ? "; run again: " + parts_text(cut, states, missing) : "");
}

}  // namespace

std::vector<std::string> merge_problems(const std::vector<StoredShard>& shards) {
  std::vector<std::string> problems;
  const StoredShard& first = shards.front();
  for (const StoredShard& shard : shards)
    if (const std::string what = difference(shard.result, first.result); !what.empty())
      problems.push_back(fmt::format("{} does not belong to {}: {}", shard.path, first.path, what));
  if (!problems.empty()) return problems;
  const std::vector<const StoredShard*> sorted = in_order(shards);
  problems = overlaps(sorted);
  if (const std::vector<Range> missing = gaps(sorted, first.result.facts.states); !missing.empty())
    problems.push_back(missing_text(shards, missing));
  return problems;
}

EnsembleResult merged(std::vector<StoredShard> shards) {
  std::sort(shards.begin(), shards.end(), [](const StoredShard& a, const StoredShard& b) {
    return a.result.shard.begin < b.result.shard.begin;
  });
  EnsembleResult whole;
  whole.facts = shards.front().result.facts;
  whole.shard = shard_of(whole.facts.states, 1, 1);
  whole.columns = shards.front().result.columns;
  whole.halved.columns.resize(whole.columns.size() - whole.drawn_count());
  const std::uint64_t judged = judged_count(whole.shard);
  for (const StoredShard& shard : shards) {
    const EnsembleResult& part = shard.result;
    whole.trusted.insert(whole.trusted.end(), part.trusted.begin(), part.trusted.end());
    // A shard's own first states reach beyond those of the whole, or hold all of them that it has.
    const std::uint64_t known = whole.halved.trusted.size();
    const auto taken =
        static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(judged - known, part.halved.trusted.size()));
    whole.halved.trusted.insert(whole.halved.trusted.end(), part.halved.trusted.begin(),
                                part.halved.trusted.begin() + taken);
    for (std::size_t i = 0; i < whole.halved.columns.size(); ++i)
      whole.halved.columns[i].insert(whole.halved.columns[i].end(), part.halved.columns[i].begin(),
                                     part.halved.columns[i].begin() + taken);
  }
  whole.values = [shards = std::move(shards), count = whole.shard.size()](std::size_t column) {
    std::vector<double> values;
    values.reserve(count);
    for (const StoredShard& shard : shards) {
      const std::vector<double> part = shard.result.values(column);
      values.insert(values.end(), part.begin(), part.end());
    }
    return values;
  };
  return whole;
}

}  // namespace jourdain::commands
