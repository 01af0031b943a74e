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

std::string statistics_table(const std::vector<EnsembleColumn>& columns,
                             const std::vector<Statistics>& statistics) {
  std::vector<std::string> names;
  std::size_t width = 0;
  for (const EnsembleColumn& column : columns) {
    names.push_back(column.name + (column.unit.empty() ? "" : ", " + column.unit));
    width = std::max(width, names.back().size());
  }
  std::string text = fmt::format("    {:<{}}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n", "", width, "mean",
                                 "deviation", "least", "5 %", "median", "95 %", "greatest");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i == 0 && columns[i].is_drawn) text += "  drawn\n";
    if (!columns[i].is_drawn && (i == 0 || columns[i - 1].is_drawn)) text += "  at the end\n";
    const Statistics& s = statistics[i];
    text += fmt::format("    {:<{}}", names[i], width);
    for (const double number : {s.mean, s.deviation, s.least, s.low, s.median, s.high, s.greatest})
      text += fmt::format(" {:>11.5g}", number);
    text += "\n";
  }
  return text;
}

std::string ensemble_csv(const EnsembleResult& result) {
  std::vector<std::vector<double>> columns;
  std::string text = "state";
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    columns.push_back(result.values(i));
    text += "," + csv_field(result.columns[i].name);
  }
  text += ",trusted\n";
  for (std::size_t k = 0; k < result.trusted.size(); ++k) {
    text += fmt::format("{}", result.shard.begin + k);
    for (const std::vector<double>& column : columns) text += fmt::format(",{}", column[k]);
    text += result.trusted[k] ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace jourdain::commands
