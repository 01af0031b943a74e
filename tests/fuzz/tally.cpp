#include "fuzz/tally.hpp"

#include <fmt/format.h>

namespace jourdain::tests {

namespace {

double percent(std::uint64_t part, std::uint64_t all) {
  return all == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

void FuzzTally::add(const Record& record) {
  ++cases_;
  read_ += record.read;
  emitted_ += record.emitted && record.kind != CaseKind::kOptions;
  compiled_ += record.compiled;
  seconds_ += record.seconds;
  if (record.seconds > longest_ || (record.seconds == longest_ && record.index < slowest_)) {
    longest_ = record.seconds;
    slowest_ = record.index;
  }
  Row& row = rows_[record.kind];
  row.seconds += record.seconds;
  ++row.counts[static_cast<std::size_t>(record.outcome)];
  if (!is_failure(record.outcome)) return;
  FailureClass& found = classes_[{record.outcome, record.why.data()}];
  found.first = std::min(found.first, record.index);
  ++found.count;
}

std::uint64_t FuzzTally::failures() const {
  std::uint64_t sum = 0;
  for (const auto& [key, found] : classes_) sum += found.count;
  return sum;
}

std::string FuzzTally::text() const {
  constexpr std::size_t kNarrowest = 8;
  const auto name = [](std::size_t i) { return outcome_name(static_cast<Outcome>(i)); };
  const auto width = [&](std::size_t i) { return std::max(kNarrowest, name(i).size()); };
  std::string text = fmt::format("{:<8}", "");
  for (std::size_t i = 0; i < kOutcomes; ++i) text += fmt::format(" {:>{}}", name(i), width(i));
  text += fmt::format(" {:>9}", "s");
  for (const auto& [kind, row] : rows_) {
    text += fmt::format("\n{:<8}", kind_name(kind));
    for (std::size_t i = 0; i < kOutcomes; ++i) text += fmt::format(" {:>{}}", row.counts[i], width(i));
    text += fmt::format(" {:>9.0f}", row.seconds);
  }
  text += fmt::format(
      "\n{} cases: {:.1f} % passed the reader, {:.1f} % were emitted and read back, {} of these compiled by "
      "g++ and clang++ "
      "and stepped\n{:.0f} s of processor time, the longest case {} with {:.1f} s\n",
      cases_, percent(read_, cases_), percent(emitted_, cases_), compiled_, seconds_, slowest_, longest_);
  for (const auto& [key, found] : classes_)
    text += fmt::format("FAILED {:>7}  {}: {}  (first: case {})\n", found.count, outcome_name(key.first),
                        key.second, found.first);
  return text;
}

std::string FuzzTally::too_few() const {
  constexpr std::uint64_t kEnough = 1000;
  constexpr double kRead = 30, kEmitted = 10;
  if (cases_ < kEnough) return "";
  if (percent(read_, cases_) < kRead) return fmt::format("fewer than {} % passed the reader", kRead);
  return percent(emitted_, cases_) < kEmitted ? fmt::format("fewer than {} % were emitted", kEmitted) : "";
}

}  // namespace jourdain::tests
