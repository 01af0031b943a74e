// What is found about an ensemble's numbers: statistics, states that are not to be trusted, what half the step moves.
#pragma once

#include <string>
#include <vector>

#include "commands/ensemble_result.hpp"
#include "commands/ensemble_text.hpp"

namespace jourdain::commands {

/// The most that half the step changes an end by, over the deviation of that number. Infinite where half the step ends
/// without a number.
struct StepError {
  double ratio = 0;
  std::string column;
  bool deviates = true;  ///< else `ratio` is over a thousandth of its size

  std::string unit() const { return deviates ? "a deviation" : "a thousandth of the value"; }
};

/// Of the first states of a result that are trusted; `statistics` are those of all of an ensemble, or of its shard, at
/// least of one state.
StepError step_error(const EnsembleResult& result, const std::vector<Statistics>& statistics);

struct Verdict {
  std::vector<Statistics> statistics;  ///< over the trusted states; none where there are none
  std::uint64_t untrusted = 0;
  std::vector<std::uint64_t> first_untrusted;  ///< places in the result, a few
  std::vector<std::vector<double>> drawn;      ///< for each of these
  StepError error;
};

Verdict judge(const EnsembleResult& result);

/// Prints the summary and the statistics, `files` that were written ("a.h5, a.svg", or none), and what is wrong. The
/// status to exit with.
int report_ensemble(const EnsembleResult& result, const Verdict& verdict, const std::string& files);

}  // namespace jourdain::commands
