// [[table]]: functions given by points, in the file or in one of comma-separated columns.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/lookup_table.hpp"
#include "model/read/import_file.hpp"
#include "model/read/keys.hpp"
#include "model/read/toml_callable.hpp"
#include "model/read/toml_sections.hpp"
#include "support/csv.hpp"

namespace jourdain::model {

namespace {

using support::shown;

class LookupTableReader {
 public:
  LookupTableReader(TomlFile& file, const toml::table& node, const ImportChain& chain)
      : file_(file),
        chain_(chain),
        keys_(file, node, fmt::format("table '{}'", shown(file.text_or(node, "name"))),
              file.range(node.source()), keys_of("table")) {}

  /// One that is zero after a diagnostic, nothing where it has no name.
  std::optional<LookupTable> read() {
    const std::size_t mark = file_.error_count();
    read_all(mark);
    if (file_.error_count() != mark) {
      file_.complete().numbers = false;
      table_.axes.assign(has_y_ ? 2 : 1, {{0, 1}});
      table_.values.assign(has_y_ ? 4 : 2, 0.0);
      table_.interpolation = Interpolation::kLinear;
      table_.beyond = Beyond::kHold;
    }
    return table_.name.empty() ? std::nullopt : std::optional(std::move(table_));
  }

 private:
  void read_all(std::size_t mark) {
    table_.name = keys_.required_text("name").value_or("");
    table_.where = keys_.where("name");
    if (file_.error_count() == mark) check_name();
    keys_.text("description");
    read_kinds();
    has_y_ = keys_.has("y") || keys_.has("y_unit");
    x_ = scale_of("x_unit"), y_ = scale_of("y_unit"), value_ = scale_of("unit");
    if (file_.error_count() != mark) return;
    table_.measure = measure_of("unit");
    table_.axes.push_back({{}, measure_of("x_unit")});
    if (keys_.has("file")) {
      for (const char* key : {"x", "y", "values"})
        if (keys_.has(key)) keys_.error(key, fmt::format("{} has a file, and '{}'", keys_.what(), key));
      if (file_.error_count() == mark) read_file();
    } else {
      if (has_y_) table_.axes.push_back({{}, measure_of("y_unit")});
      read_points("x", x_, table_.axes[0].points);
      if (has_y_) read_points("y", y_, table_.axes[1].points);
      if (file_.error_count() == mark) read_values();
    }
    if (file_.error_count() == mark) check_kind();
  }

  void check_name() { check_callable_name(file_, keys_, "table", table_.name); }

  void read_kinds() {
    const auto interpolation = keys_.choice("interpolation", {"linear", "monotone", "spline"});
    table_.interpolation = static_cast<Interpolation>(interpolation.value_or(0));
    table_.beyond = static_cast<Beyond>(keys_.choice("beyond", {"hold", "extend", "repeat"}).value_or(0));
  }

  /// The unit and what is in it, as messages show it.
  struct Scale {
    Unit unit;
    std::string text;

    double in_si(double number) const { return model::in_si(number, unit); }
    Place place(std::string what) const {
      Place place{std::move(what), {{text}}};
      if (unit.factor != 1) place.unit = unit;
      return place;
    }
  };

  Scale scale_of(std::string_view key) {
    const std::optional<Unit> unit = keys_.unit(key);
    if (!keys_.has(key) || !unit) return {};
    return {*unit, unit->factor == 1 ? *keys_.text(key) : unit->si};
  }
  Measure measure_of(std::string_view key) const {
    return keys_.has(key) ? Measure::parameter(*keys_.text(key)) : Measure::open();
  }

  void read_points(const char* key, const Scale& scale, std::vector<double>& points) {
    const toml::array* array = keys_.array(key, "an array of numbers");
    if (!array) return;
    const Place place = scale.place(keys_.quoted(key));
    const std::size_t mark = file_.error_count();
    for (const toml::node& node : *array) {
      const double point = file_.constant(node, place);
      if (file_.error_count() != mark) return;
      if (!points.empty() && !(point > points.back()))
        return file_.error(file_.range(node.source()),
                           fmt::format("{} does not rise: {} does not come after {}", keys_.quoted(key),
                                       point, points.back()));
      points.push_back(point);
    }
    if (points.size() < 2) keys_.error(key, fmt::format("{} needs two points at least", keys_.quoted(key)));
  }

  /// One array, or one for each x.
  void read_values() {
    const toml::array* array = keys_.array("values", "an array");
    if (!array) return;
    if (table_.axes.size() == 1) return read_row(*array, table_.axes[0].points.size(), "x");
    if (!check_count(*array, table_.axes[0].points.size(), "arrays", "x")) return;
    for (const toml::node& node : *array) {
      const toml::array* row = node.as_array();
      if (!row)
        return file_.error(file_.range(node.source()),
                           fmt::format("{} must be arrays, one for each x, not {}", keys_.quoted("values"),
                                       type_in_words(node)));
      read_row(*row, table_.axes[1].points.size(), "y");
    }
  }

  void read_row(const toml::array& row, std::size_t count, const char* axis) {
    if (!check_count(row, count, "numbers", axis)) return;
    const Place place = value_.place(keys_.quoted("values"));
    for (const toml::node& node : row)
      table_.values.push_back(table_.interpolation == Interpolation::kLinear
                                  ? file_.expression(node, place)
                                  : Expression(file_.constant(node, place)));
  }

  bool check_count(const toml::array& array, std::size_t count, const char* what, const char* axis) {
    if (array.size() == count) return true;
    file_.error(file_.range(array.source()),
                fmt::format("{} needs {} {}, one for each {}, found {}", keys_.quoted("values"), count, what,
                            axis, array.size()));
    return false;
  }

  /// Columns x, value; or a head line of y behind any text, and lines of x and values.
  void read_file() {
    const std::optional<std::string> name = keys_.required_text("file");
    if (!name) return;
    FoundFile found = find_import(*name, file_.diagnostics().path(), chain_);
    if (!found.problem.empty()) return keys_.error("file", found.problem, found.hint);
    support::Diagnostics diagnostics(found.path, std::move(found.text));
    const std::vector<support::CsvRow> rows = support::csv_rows(diagnostics.text());
    read_rows(rows, diagnostics);
    const bool failed = diagnostics.has_errors();
    file_.diagnostics().absorb(std::move(diagnostics), keys_.where("file"));
    if (failed) keys_.error("file", fmt::format("{} could not be read", keys_.what()));
  }

  void read_rows(const std::vector<support::CsvRow>& rows, support::Diagnostics& diagnostics) {
    const bool has_head = !rows.empty() && !support::number_in(rows[0].fields[0]);
    const bool is_grid = !rows.empty() && rows[0].fields.size() > 2;
    if (is_grid && !has_head)
      return diagnostics.error({rows[0].line, 1, 1}, "the first line of a grid begins with a word",
                               "it has that and the points of y, the others a point of x and its values");
    if (!is_grid && keys_.has("y_unit"))
      return keys_.error("y_unit", fmt::format("{} has no y in its file", keys_.what()));
    if (is_grid) {
      table_.axes.push_back({{}, measure_of("y_unit")});
      for (std::size_t i = 1; i < rows[0].fields.size(); ++i)
        if (!take_point(rows[0], i, y_, table_.axes[1].points, diagnostics)) return;
    }
    for (std::size_t r = has_head ? 1 : 0; r < rows.size(); ++r) {
      const std::size_t count = is_grid ? rows[0].fields.size() : 2;
      if (rows[r].fields.size() != count)
        return diagnostics.error({rows[r].line, 1, 1},
                                 fmt::format("{} columns instead of {}", rows[r].fields.size(), count));
      if (!take_point(rows[r], 0, x_, table_.axes[0].points, diagnostics)) return;
      for (std::size_t i = 1; i < count; ++i) {
        const std::optional<double> number = number_at(rows[r], i, diagnostics);
        if (!number) return;
        table_.values.emplace_back(value_.in_si(*number));
      }
    }
    if (table_.axes[0].points.size() < 2)
      diagnostics.error({}, "the file needs two points at least", "a line for each: x, value");
  }

  static SourceRange range(const support::CsvRow& row, std::size_t i) {
    return {row.line, row.fields[i].column, std::max(1, static_cast<int>(row.fields[i].text.size()))};
  }

  static std::optional<double> number_at(const support::CsvRow& row, std::size_t i,
                                         support::Diagnostics& diagnostics) {
    const std::optional<double> number = support::number_in(row.fields[i]);
    if (!number)
      diagnostics.error(range(row, i), fmt::format("'{}' is not a finite number", shown(row.fields[i].text)));
    return number;
  }

  static bool take_point(const support::CsvRow& row, std::size_t i, const Scale& scale,
                         std::vector<double>& points, support::Diagnostics& diagnostics) {
    const std::optional<double> number = number_at(row, i, diagnostics);
    if (!number) return false;
    const double point = scale.in_si(*number);
    if (!points.empty() && !(point > points.back())) {
      diagnostics.error(range(row, i), fmt::format("{} does not come after {}", point, points.back()));
      return false;
    }
    points.push_back(point);
    return true;
  }

  void check_kind() {
    const bool is_curved = table_.interpolation != Interpolation::kLinear, is_grid = table_.axes.size() == 2;
    if (table_.interpolation == Interpolation::kMonotone && is_grid)
      return keys_.error("interpolation",
                         fmt::format("{} has two axes: it is linear or a spline", keys_.what()));
    if (is_curved && is_grid && table_.beyond == Beyond::kExtend)
      return keys_.error("beyond", fmt::format("{} is a spline of two axes: it holds", keys_.what()));
    if (table_.beyond == Beyond::kRepeat && !check_period()) return;
    const std::size_t most =
        has_entries(table_) ? kMaximumTableNumbers / numbers_a_value() : kMaximumTableValues;
    if (table_.values.size() > most)
      return keys_.error(
          keys_.has("file") ? "file" : "values",
          fmt::format("{} has {} values, more than {}", keys_.what(), table_.values.size(), most));
    for (const Expression& value : table_.values)
      if (!std::isfinite(file_.value(value)))
        return keys_.error("values", fmt::format("a value of {} is not finite in SI units", keys_.what()));
    if (!is_finite_at_points())
      keys_.error("name", fmt::format("{} is too steep: a slope is not finite", keys_.what()));
  }

  bool check_period() {
    const Expression &first = table_.values.front(), &last = table_.values.back();
    if (table_.axes.size() == 2)
      keys_.error("beyond", fmt::format("{} has two axes: it does not repeat", keys_.what()));
    else if (!first.is_constant() || !last.is_constant())
      keys_.error("beyond",
                  fmt::format("{} repeats: its first value and its last are numbers", keys_.what()));
    else if (first.constant() != last.constant())
      keys_.error("beyond",
                  fmt::format("{} repeats, but begins with {} and ends with {}", keys_.what(),
                              first.constant(), last.constant()),
                  "the last point is the first one of the next period");
    else
      return true;
    return false;
  }

  /// Coefficients, and of a curve the beginning of an interval.
  std::size_t numbers_a_value() const {
    const bool is_linear = table_.interpolation == Interpolation::kLinear;
    if (table_.axes.size() == 2) return is_linear ? 4 : 16;
    return is_linear ? 3 : 5;
  }

  /// Where each interval ends.
  bool is_finite_at_points() const {
    std::vector<Variable> arguments(table_.axes.size(), {Variable::Kind::kArgument});
    if (arguments.size() == 2) arguments[1].component = 1;
    std::vector<Expression> given;
    for (const Variable& argument : arguments) given.push_back(Expression::variable(argument));
    const Expression value = looked_up(table_, given);
    const std::vector<double>& x = table_.axes[0].points;
    const std::vector<double> y = table_.axes.size() == 2 ? table_.axes[1].points : std::vector<double>{0};
    return std::all_of(x.begin(), x.end(), [&](double at_x) {
      return std::all_of(y.begin(), y.end(), [&](double at_y) {
        return std::isfinite(file_.value(
            value, [&](const Variable& argument) { return argument == arguments[0] ? at_x : at_y; }));
      });
    });
  }

  TomlFile& file_;
  const ImportChain& chain_;
  TomlTable keys_;
  LookupTable table_;
  bool has_y_ = false;
  Scale x_, y_, value_;
};

}  // namespace

void read_lookup_tables(TomlFile& file, const TomlTables& section, const ImportChain& chain) {
  for (const toml::node& node : section)
    if (std::optional<LookupTable> table = LookupTableReader(file, *node.as_table(), chain).read())
      file.declare(callable(std::move(*table)));
}

}  // namespace jourdain::model
