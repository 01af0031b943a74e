// What is said of an ensemble's end: statistics of each number, rows of all states.
#pragma once

#include <string>
#include <vector>

#include "commands/ensemble_result.hpp"

namespace jourdain::commands {

/// Of one number over states, in the order of their numbers, so that they do not depend on who computed what.
struct Statistics {
  double mean = 0, deviation = 0;  ///< deviation of the sample: over n - 1; zero of one state
  double least = 0, low = 0, median = 0, high = 0, greatest = 0;  ///< low and high: 5 and 95 in 100
};

/// Of at least one value. Percentiles by linear interpolation between order statistics (type 7 of Hyndman and Fan,
/// American Statistician 50, 1996).
Statistics statistics_of(std::vector<double> values);

/// A table of the columns' statistics, over the states that may be trusted.
std::string statistics_table(const std::vector<EnsembleColumn>& columns,
                             const std::vector<Statistics>& statistics);

/// "state,mass,slide,...,trusted" and a row for each.
std::string ensemble_csv(const EnsembleResult& result);

}  // namespace jourdain::commands
