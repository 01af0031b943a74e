// Typed access to TOML tables: every key that is asked for wrongly, missing or unknown becomes a diagnostic.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/callable.hpp"
#include "model/dimensions.hpp"
#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "model/units.hpp"
#include "support/diagnostics.hpp"
#include "support/line_index.hpp"

namespace jourdain::model {

/// The text of `diagnostics` as TOML; nothing after a diagnostic.
std::optional<toml::table> parse_toml(support::Diagnostics& diagnostics);

/// What stands somewhere in a file: what messages call it, and the units that it needs one of.
struct Place {
  std::string what;
  Needed needed;
  std::optional<Unit> unit = {};  ///< of bare numbers
};

/// A number and its unit; none after a diagnostic. The hint is for where it does not fit.
struct Quantity {
  double value = 0;
  std::optional<Unit> unit;
  std::string hint;
};

/// What a [[repeat]] puts for its index into the texts of its tables.
struct Repetition {
  std::string index;
  std::int64_t value = 0;
};

/// An expression with a name that others may use.
struct Signal {
  std::string name;
  Expression value;
  std::string unit;  ///< SI; empty: none
  SourceRange where = {};
  /// The value where callables that are smooth everywhere, and all that are so within their ends, are sums of their
  /// arguments.
  Expression smoothed_everywhere = {}, smoothed_within_ends = {};
};

/// One TOML file while it is read.
class TomlFile {
 public:
  explicit TomlFile(support::Diagnostics& diagnostics)
      : diagnostics_(diagnostics), lines_(diagnostics.text()) {}

  support::Diagnostics& diagnostics() { return diagnostics_; }

  /// The names that expressions may use from now on, and their values.
  void declare(const std::vector<Parameter>& parameters);
  /// One more, which stands for an expression of those of `parameters`.
  void declare(const DerivedParameter& derived);
  /// All parameters of a mechanism.
  void declare(const Mechanism& mechanism);
  /// A table or function that expressions may call from now on.
  void declare(Callable callable) { callables_.push_back(std::move(callable)); }
  const std::vector<Callable>& callables() const { return callables_; }
  /// What `read` makes where callables that are at least so smooth are sums of their arguments, in signals too.
  Expression with_smooth_callables(Callable::Smooth at_least, const std::function<Expression()>& read);
  /// A signal that expressions may name from now on.
  void declare(Signal signal) { signals_.push_back(std::move(signal)); }
  const std::vector<Signal>& signals() const { return signals_; }
  /// What prescribed motions may name from now on.
  void declare(Scope motion_scope) { motion_scope_ = std::move(motion_scope); }
  const Scope& motion_scope() const { return motion_scope_; }
  /// The names that expressions may use, in order: those of parameters, then derived ones.
  const std::vector<DeclaredParameter>& declared() const { return parameters_; }

  /// What texts have in place of "{i}" from now on; none: braces are as written.
  void repeat(const std::optional<Repetition>& repetition);
  /// A text as it is meant: indices of [[repeat]] have their values. As written after a diagnostic.
  std::string text(const toml::value<std::string>& written);
  std::string text(const std::string& text, const SourceRange& where);
  /// The text of `key`, or `otherwise` where that is none.
  std::string text_or(const toml::table& table, std::string_view key, std::string otherwise = "");

  const support::Diagnostics& diagnostics() const { return diagnostics_; }
  SourceRange range(const toml::source_region& region) const;
  /// Within a repetition an error at a place is told once, for its first value of the index.
  void error(SourceRange where, std::string message, std::string hint = "");
  /// "line 7", of an imported file "line 7 of arm.urdf".
  std::string line_in_words(const SourceRange& where) const { return diagnostics_.line_in_words(where, {}); }
  /// How often `error` was called: lets a caller see whether a value could be read.
  std::size_t error_count() const { return error_count_; }

  /// In SI units: a number, an expression, a number with its unit ("30 deg") or a table { value, unit }; 0 after a
  /// diagnostic. Finite at the parameters' default values.
  Expression expression(const toml::node& node, const Place& place, const Scope& scope = {});
  /// One that does not depend on parameters; 0 after a diagnostic.
  double constant(const toml::node& node, const Place& place);
  /// The string as a number with its unit; nothing where it is an expression.
  std::optional<Quantity> quantity(const toml::value<std::string>& text, const Needed& needed,
                                   const Scope& scope = {});
  /// The unit of `table`'s key 'unit', after a diagnostic where it does not fit the place.
  std::optional<Unit> unit_apart(const toml::table& table, const Place& place);
  /// The parameters' default values.
  const std::vector<double>& values() const { return values_; }
  /// At the parameters' default values.
  double value(const Expression& expression) const { return expression.evaluate<double>(values_); }
  double value(const Expression& expression, const std::function<double(const Variable&)>& variable) const {
    return expression.evaluate<double>(
        values_, [](double literal) { return literal; }, variable);
  }

  /// The unit of measurement from `offset` in the text on; nothing after a diagnostic.
  std::optional<Unit> unit(const toml::value<std::string>& text, std::size_t offset = 0);

  Completeness& complete() { return complete_; }

 private:
  Expression number_error(SourceRange where, std::string message, std::string hint = "");
  Expression parsed(const toml::value<std::string>& text, const Place& place, const Scope& scope);
  Expression converted(const Quantity& quantity, const toml::value<std::string>& text, const Place& place);
  Expression value_and_unit(const toml::table& table, const Place& place, const Scope& scope);
  /// A bare number and an expression, in the place's unit.
  static Expression bare(double number, const Place& place);
  Expression in_unit(const Expression& bare, const Measure& measure, SourceRange where, const Place& place);
  /// A diagnostic that what is written does not have the dimension that the place needs.
  Expression misfit(const toml::value<std::string>& text, const Measure& measure, const Place& place,
                    const std::string& hint);
  /// After a diagnostic.
  Expression unread();
  /// Of a parameter or a variable of `scope`.
  std::optional<Measure> measure_of(std::string_view name, const Scope& scope) const;
  /// An expression of declared names as one of parameters; nothing where it would be too long.
  std::optional<Expression> with_meanings(const Expression& expression) const;
  SourceRange inside(const toml::value<std::string>& text, std::size_t offset, std::size_t length) const;
  bool is_underflow(const toml::node& node) const;

  support::Diagnostics& diagnostics_;
  support::LineIndex lines_;
  std::vector<DeclaredParameter> parameters_;
  std::vector<Expression> meanings_;  ///< of those that are derived, the last ones
  std::vector<double> values_;        ///< of the others
  std::vector<Callable> callables_;
  std::vector<Signal> signals_;
  Scope motion_scope_;
  std::optional<Repetition> repetition_;
  std::map<std::pair<int, int>, std::int64_t> repeated_errors_;  ///< index by line and column
  Completeness complete_;
  std::size_t error_count_ = 0;
};

/// A table of which all keys are known. `what` names it in messages ("body 'bob'").
class TomlTable {
 public:
  /// Reports keys that are not in `known`. `where` is underlined when a key is missing. Hints list `shown`, or all.
  TomlTable(TomlFile& file, const toml::table& table, std::string what, SourceRange where,
            const std::vector<std::string>& known, const std::vector<std::string>& shown = {});

  TomlFile& file() const { return file_; }
  const std::string& what() const { return what_; }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  const toml::node* find(std::string_view key) const { return table_.get(key); }
  /// Of the value of `key`, or of the table where it is missing.
  SourceRange where(std::string_view key) const;
  /// Of the value of `key`; line 0 where it is missing.
  SourceRange where_given(std::string_view key) const { return has(key) ? where(key) : SourceRange(); }

  /// The text of `key`; nothing (after a diagnostic if it has another type, or characters that cannot be
  /// printed) where it is missing.
  std::optional<std::string> text(std::string_view key) const;
  /// The unit of measurement that `key` names, 1 where it is missing; nothing after a diagnostic.
  std::optional<Unit> unit(std::string_view key) const;
  /// A text that is not empty.
  std::optional<std::string> required_text(std::string_view key) const;
  /// One of `allowed`, or nothing after a diagnostic; the first one where it is missing.
  std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& allowed) const;

  Expression number(std::string_view key, const Needed& needed, const Expression& otherwise = 0.0) const;
  /// A required number that is positive at the parameters' default values.
  Expression positive(std::string_view key, const Needed& needed) const;
  /// A number, 0 where the key is missing, that is not negative at the parameters' default values.
  Expression not_negative(std::string_view key, const Needed& needed) const;
  /// An expression over the names of `scope`, and three of them; zero where the key is missing.
  Expression function(std::string_view key, const Needed& needed, const Scope& scope) const;
  Vector3 functions(std::string_view key, const Needed& needed, const Scope& scope) const;
  /// Three numbers, or a table of them and their unit; `otherwise` where the key is missing.
  Vector3 vector(std::string_view key, const Needed& needed, const Vector3& otherwise = {}) const;
  /// Two numbers; nothing (after a diagnostic if it is something else) where the key is missing.
  std::optional<std::array<Expression, 2>> pair(std::string_view key, const Needed& needed) const;
  /// Three pure numbers that do not depend on parameters.
  std::array<double, 3> direction(std::string_view key, const std::array<double, 3>& otherwise) const;
  /// Two numbers that do not depend on parameters; nothing (after a diagnostic if it is something
  /// else) where it is missing. Bare ones have the unit `unit`.
  std::optional<std::array<double, 2>> constant_pair(std::string_view key, const Needed& needed,
                                                     const std::optional<Unit>& unit) const;
  /// Three angles.
  Rotation rotation(std::string_view key) const;
  /// Four numbers (w, x, y, z) of a unit quaternion; constant ones are normalised. The identity where it is missing.
  std::array<Expression, 4> quaternion(std::string_view key) const;
  /// A table within this one; nothing (after a diagnostic if it has another type) where it is missing.
  const toml::table* table(std::string_view key) const;

  /// An array; nothing after a diagnostic.
  const toml::array* array(std::string_view key, std::string_view expected) const;
  void missing(std::string_view key, std::string hint = "") const;
  void error(std::string_view key, std::string message, std::string hint = "") const;
  std::string quoted(std::string_view key) const;

 private:
  /// Those of `key`; their unit, where it stands apart, goes to `place`.
  const toml::array* numbers(std::string_view key, std::size_t count, Place& place) const;
  Place place(std::string_view key, const Needed& needed) const { return {quoted(key), needed}; }
  void wrong_type(std::string_view key, std::string_view expected) const;

  TomlFile& file_;
  const toml::table& table_;
  std::string what_;
  SourceRange where_;
};

/// "a string", "an array", …: what a value is, in words.
std::string_view type_in_words(const toml::node& node);

}  // namespace jourdain::model
