#include "commands/ensemble_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "commands/printable.hpp"
#include "support/check.hpp"

namespace jourdain::commands {

Statistics statistics_of(std::vector<double> values) {
  JD_CHECK(!values.empty(), "statistics of nothing");
  Statistics result;
  const auto count = static_cast<double>(values.size());
  // About the first value, so that little is lost where all are alike.
  const double about = values[0];
  for (const double value : values) result.mean += (value - about) / count;
  double squares = 0;
  for (const double value : values) squares += (value - about - result.mean) * (value - about - result.mean);
  result.deviation = values.size() > 1 ? std::sqrt(squares / (count - 1)) : 0;
  result.mean += about;
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double share) {
    const double place = share * (count - 1);
    const auto below = static_cast<std::size_t>(place);
    const double above = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - static_cast<double>(below)) * (above - values[below]);
  };
  result.least = values.front();
  result.low = quantile(0.05);
  result.median = quantile(0.5);
  result.high = quantile(0.95);
  result.greatest = values.back();
  return result;
}

std::string statistics_table(const std::vector<std::string>& columns, const std::vector<std::string>& units,
                             const std::vector<Statistics>& statistics, std::size_t first) {
  std::vector<std::string> names;
  std::size_t width = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    names.push_back(columns[i] + (units[i].empty() ? "" : ", " + units[i]));
    width = std::max(width, names.back().size());
  }
  std::string text = fmt::format("    {:<{}}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "", width, "mean",
                                 "deviation", "least", "5 %", "median", "95 %", "greatest");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i == 0 && first > 0) text += "  drawn\n";
    if (i == first) text += "  at the end\n";
    const Statistics& s = statistics[i];
    text += fmt::format("    {:<{}}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}{:>12.5g}\n",
                        names[i], width, s.mean, s.deviation, s.least, s.low, s.median, s.high, s.greatest);
  }
  return text;
}

std::string ensemble_csv(const std::vector<std::string>& columns, const std::vector<EnsembleRow>& rows) {
  std::string text = "state";
  for (const std::string& column : columns) text += "," + csv_field(column);
  text += ",trusted\n";
  for (const EnsembleRow& row : rows) {
    text += fmt::format("{}", row.state);
    for (const double value : row.drawn) text += fmt::format(",{}", value);
    for (const double value : row.end) text += fmt::format(",{}", value);
    text += row.trusted ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace jourdain::commands
