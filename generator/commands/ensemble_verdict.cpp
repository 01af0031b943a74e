#include "commands/ensemble_verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "commands/load.hpp"

namespace jourdain::commands {

namespace {

/// The most that half the step changes an end in a column by, over its deviation; over a thousandth of its size where
/// all states end alike, as nothing spreads it.
double column_error(const EnsembleResult& result, const std::vector<double>& values,
                    const std::vector<double>& halved, const Statistics& s) {
  constexpr double kRounding = 1e-6;  // of a number's size: less is not looked at
  constexpr double kAlike = 1e-3;     // of a number's size, where all are the same
  const double size = std::max(std::fabs(s.least), std::fabs(s.greatest));
  const double share = s.least == s.greatest ? kAlike : kRounding;
  const double unit = std::max({s.deviation, share * size, 1e-12});
  double worst = 0;
  for (std::size_t k = 0; k < halved.size(); ++k) {
    if (!result.trusted[k]) continue;
    const double ratio = result.halved.trusted[k] ? std::fabs(values[k] - halved[k]) / unit
                                                  : std::numeric_limits<double>::infinity();
    worst = std::max(worst, ratio);
  }
  return worst;
}

/// The first states that may not be trusted, and what was drawn for them.
std::string untrusted_text(const EnsembleResult& result, const Verdict& verdict) {
  std::string text = fmt::format(
      "error: {} of {} states are not to be trusted: a number is not finite, loops could not be closed, or "
      "how they are closed is not proven for their parameters",
      verdict.untrusted, result.shard.size());
  for (std::size_t shown = 0; shown < verdict.first_untrusted.size(); ++shown) {
    text += fmt::format("\n  state {}", result.shard.begin + verdict.first_untrusted[shown]);
    for (std::size_t i = 0; i < verdict.drawn[shown].size(); ++i)
      text +=
          fmt::format("{} {} = {:g}", i == 0 ? ":" : ",", result.columns[i].name, verdict.drawn[shown][i]);
  }
  return text + "\n";
}

std::string summary(const EnsembleResult& result) {
  const EnsembleFacts& facts = result.facts;
  const Shard& shard = result.shard;
  const std::string of_whole =
      shard.size() < facts.states ? fmt::format(" ({} to {} of {})", shard.begin, shard.end - 1, facts.states)
                                  : "";
  return fmt::format("{}: {} states{}, {} steps of {:g} s with {} in {}, seed {}\n", facts.model,
                     shard.size(), of_whole, facts.steps, facts.step, facts.method, facts.real, facts.seed);
}

}  // namespace

StepError step_error(const EnsembleResult& result, const std::vector<Statistics>& statistics) {
  StepError worst;
  const std::size_t drawn = result.drawn_count();
  for (std::size_t i = drawn; i < result.columns.size(); ++i) {
    const double ratio =
        column_error(result, result.values(i), result.halved.columns[i - drawn], statistics[i]);
    if (ratio > worst.ratio)
      worst = {ratio, result.columns[i].name, statistics[i].least != statistics[i].greatest};
  }
  return worst;
}

Verdict judge(const EnsembleResult& result) {
  constexpr std::size_t kShown = 3;
  Verdict verdict;
  for (std::size_t k = 0; k < result.trusted.size(); ++k) {
    if (result.trusted[k]) continue;
    ++verdict.untrusted;
    if (verdict.first_untrusted.size() < kShown) verdict.first_untrusted.push_back(k);
  }
  verdict.drawn.resize(verdict.first_untrusted.size());
  const std::size_t drawn = result.drawn_count();
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    const std::vector<double> values = result.values(i);
    for (std::size_t shown = 0; i < drawn && shown < verdict.drawn.size(); ++shown)
      verdict.drawn[shown].push_back(values[verdict.first_untrusted[shown]]);
    if (verdict.untrusted == result.trusted.size()) continue;
    verdict.statistics.push_back(statistics_of(result.of_trusted(values)));
  }
  if (!verdict.statistics.empty()) verdict.error = step_error(result, verdict.statistics);
  return verdict;
}

int report_ensemble(const EnsembleResult& result, const Verdict& verdict, const std::string& files) {
  fmt::print("{}", summary(result));
  const StepError& error = verdict.error;
  if (!verdict.statistics.empty()) {
    fmt::print("{}", statistics_table(result.columns, verdict.statistics));
    fmt::print("  half the step moves the first {} ends by at most {:.2g} of {}{}\n",
               result.halved.trusted.size(), error.ratio, error.unit(),
               error.column.empty() ? "" : fmt::format(" ({})", error.column));
  }
  if (!files.empty()) fmt::print("  wrote {}\n", files);
  if (verdict.untrusted > 0) fmt::print(stderr, "{}", untrusted_text(result, verdict));
  const bool is_step_short = error.ratio <= result.facts.accuracy;
  if (!is_step_short)
    fmt::print(stderr,
               "error: the step is too long for these statistics (allowed: {:g} of {}); take a "
               "shorter one, or allow more by --accuracy where a motion is chaotic\n",
               result.facts.accuracy, error.unit());
  return verdict.untrusted > 0 || !is_step_short ? kModelWrong : kSuccess;
}

}  // namespace jourdain::commands
