#include "commands/input_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "support/csv.hpp"

namespace jourdain::commands {

namespace {

using Field = support::CsvField;

struct Row {
  double t = 0;
  std::vector<double> values;  // by input
};

class InputTable : public studies::Inputs {
 public:
  explicit InputTable(std::vector<Row> rows) : rows_(std::move(rows)) {}

  std::vector<double> at(double t) const override {
    const auto [before, after] = around(t);
    if (before == after) return before->values;
    return mixed<double>(*before, *after, (t - before->t) / (after->t - before->t));
  }

  std::vector<LongReal> at(const LongReal& t) const override {
    const auto [before, after] = around(double(t));
    if (before == after) return {before->values.begin(), before->values.end()};
    const LongReal begin(before->t), end(after->t);
    return mixed<LongReal>(*before, *after, (t - begin) / (end - begin));
  }

 private:
  /// The rows next to time t; the same one twice beyond the ends.
  std::pair<const Row*, const Row*> around(double t) const {
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), t,
                                        [](double time, const Row& row) { return time < row.t; });
    if (after == rows_.begin()) return {&rows_.front(), &rows_.front()};
    if (after == rows_.end()) return {&rows_.back(), &rows_.back()};
    return {&*(after - 1), &*after};
  }

  template <class Real>
  static std::vector<Real> mixed(const Row& before, const Row& after, const Real& share) {
    std::vector<Real> values;
    for (std::size_t i = 0; i < before.values.size(); ++i) {
      const Real begin(before.values[i]), end(after.values[i]);
      values.push_back(begin + share * (end - begin));
    }
    return values;
  }

  std::vector<Row> rows_;
};

class TableReader {
 public:
  TableReader(support::Diagnostics& diagnostics, const std::vector<std::string>& names)
      : diagnostics_(diagnostics), names_(names) {}

  std::vector<Row> read() {
    for (const support::CsvRow& row : support::csv_rows(diagnostics_.text())) {
      line_ = row.line;
      columns_.empty() ? read_header(row.fields) : read_row(row.fields);
      if (diagnostics_.has_errors()) return {};
    }
    if (rows_.empty())
      diagnostics_.error({}, "the file has no rows of numbers", "a header, then a row per time");
    return std::move(rows_);
  }

 private:
  void error(const Field& field, std::string message, std::string hint = "") {
    const int length = std::max(1, static_cast<int>(field.text.size()));
    diagnostics_.error({line_, field.column, length}, std::move(message), std::move(hint));
  }

  void read_header(const std::vector<Field>& fields) {
    if (fields.front().text != "time")
      return error(fields.front(),
                   fmt::format("the first column is '{}', not 'time'", support::shown(fields.front().text)),
                   "the header names the columns: time, then inputs");
    columns_.push_back(0);
    for (std::size_t i = 1; i < fields.size(); ++i) {
      const auto found = std::find(names_.begin(), names_.end(), fields[i].text);
      if (found == names_.end()) {
        const std::string near = support::nearest(fields[i].text, names_);
        return error(fields[i], fmt::format("no input '{}'", support::shown(fields[i].text)),
                     near.empty() ? fmt::format("the inputs are {}", fmt::join(names_, ", "))
                                  : fmt::format("did you mean '{}'?", near));
      }
      const auto input = static_cast<std::size_t>(found - names_.begin());
      if (std::find(columns_.begin() + 1, columns_.end(), input) != columns_.end())
        return error(fields[i], fmt::format("input '{}' has a column already", *found));
      columns_.push_back(input);
    }
  }

  std::optional<double> number(const Field& field) {
    if (const std::optional<double> value = support::number_in(field)) return value;
    error(field, fmt::format("'{}' is not a finite number", support::shown(field.text)));
    return {};
  }

  void read_row(const std::vector<Field>& fields) {
    if (fields.size() != columns_.size())
      return error(fields.front(), fmt::format("{} values for {} columns", fields.size(), columns_.size()));
    Row row{0, std::vector<double>(names_.size())};
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = number(fields[i]);
      if (!value) return;
      (i == 0 ? row.t : row.values[columns_[i]]) = *value;
    }
    if (!rows_.empty() && row.t <= rows_.back().t)
      return error(fields.front(), fmt::format("time {} does not come after {}", row.t, rows_.back().t));
    rows_.push_back(std::move(row));
  }

  support::Diagnostics& diagnostics_;
  const std::vector<std::string>& names_;
  int line_ = 0;
  std::vector<std::size_t> columns_;  // input of each column; the first one is time
  std::vector<Row> rows_;
};

}  // namespace

std::unique_ptr<studies::Inputs> read_input_table(support::Diagnostics& diagnostics,
                                                  const std::vector<std::string>& input_names) {
  std::vector<Row> rows = TableReader(diagnostics, input_names).read();
  if (diagnostics.has_errors()) return nullptr;
  return std::make_unique<InputTable>(std::move(rows));
}

}  // namespace jourdain::commands
