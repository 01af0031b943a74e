// Numbers and positions of a TOML file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/expression_sums.hpp"
#include "model/read/nesting.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

namespace {

/// "Error while parsing array: …" of toml++ in our words.
std::string syntax_message(std::string_view description) {
  constexpr std::string_view kPrefix = "Error while parsing ";
  if (description.starts_with(kPrefix)) description.remove_prefix(kPrefix.size());
  return fmt::format("TOML syntax, {}", description);
}

constexpr const char* kCountHint = "a number that has a unit is written with a point, 2.0, or as a parameter";

}  // namespace

std::optional<toml::table> parse_toml(support::Diagnostics& diagnostics) {
  const support::LineIndex lines(diagnostics.text());
  if (const auto offset = deep_toml_nesting(diagnostics.text())) {
    diagnostics.error(lines.range(*offset, 1), fmt::format("nested deeper than {} levels", kMaximumNesting));
    return {};
  }
  try {
    return toml::parse(std::string_view(diagnostics.text()));
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    diagnostics.error({static_cast<int>(begin.line), static_cast<int>(begin.column), 1},
                      syntax_message(error.description()));
    return {};
  }
}

Expression TomlFile::with_smooth_callables(Callable::Smooth at_least,
                                           const std::function<Expression()>& read) {
  const std::vector<Callable> kept = callables_;
  const std::vector<Signal> kept_signals = signals_;
  for (Signal& signal : signals_)
    signal.value =
        at_least == Callable::Smooth::kEverywhere ? signal.smoothed_everywhere : signal.smoothed_within_ends;
  for (Callable& callable : callables_)
    if (callable.smooth >= at_least)
      callable.value = [](std::span<const Expression> arguments) {
        Expression sum;
        for (const Expression& argument : arguments) sum = plus(sum, argument);
        return sum;
      };
  Expression result = read();
  callables_ = kept;
  signals_ = kept_signals;
  return result;
}

void TomlFile::declare(const std::vector<Parameter>& parameters) {
  parameters_.clear();
  meanings_.clear();
  values_.clear();
  for (const Parameter& parameter : parameters) {
    parameters_.push_back({parameter.name, Measure::parameter(parameter.unit)});
    values_.push_back(parameter.value);
  }
}

void TomlFile::declare(const DerivedParameter& derived) {
  parameters_.push_back({derived.name, Measure::parameter(derived.unit)});
  meanings_.push_back(derived.value);
}

void TomlFile::declare(const Mechanism& mechanism) {
  declare(mechanism.parameters);
  for (const DerivedParameter& derived : mechanism.derived) declare(derived);
}

std::optional<Expression> TomlFile::with_meanings(const Expression& expression) const {
  if (meanings_.empty()) return expression;
  const auto meaning = [this](ParameterIndex index) {
    return index.value < values_.size() ? Expression::parameter(index)
                                        : meanings_[index.value - values_.size()];
  };
  std::size_t size = 0;
  for (const Expression::Node& node : expression.nodes())
    size += node.op == Expression::Op::kParameter ? meaning(node.parameter).nodes().size() : 1;
  if (size > kMaximumExpressionSize) return {};
  Expression result = expression.with_parameters(meaning);
  if (result.written_out_size() > kMaximumWrittenOutSize) return {};
  return result;
}

void TomlFile::error(SourceRange where, std::string message, std::string hint) {
  ++error_count_;
  if (repetition_) {
    const auto [first, is_new] =
        repeated_errors_.emplace(std::pair(where.line, where.column), repetition_->value);
    if (!is_new && first->second != repetition_->value) return;
  }
  diagnostics_.error(where, std::move(message), std::move(hint));
}

SourceRange TomlFile::range(const toml::source_region& region) const {
  const int line = static_cast<int>(region.begin.line);
  const int column = static_cast<int>(region.begin.column);
  const std::size_t begin = lines_.offset(line, column);
  const bool one_line = region.end.line == region.begin.line;
  const std::size_t end =
      one_line ? lines_.offset(line, static_cast<int>(region.end.column)) : diagnostics_.text().size();
  return lines_.range(begin, std::max<std::size_t>(end, begin + 1) - begin);
}

Expression TomlFile::number_error(SourceRange where, std::string message, std::string hint) {
  error(where, std::move(message), std::move(hint));
  complete_.numbers = false;
  return 0.0;
}

Expression TomlFile::expression(const toml::node& node, const Place& place, const Scope& scope) {
  const SourceRange where = range(node.source());
  if (const auto* integer = node.as_integer()) return bare(static_cast<double>(integer->get()), place);
  if (const auto* number = node.as_floating_point()) {
    if (!std::isfinite(number->get()))
      return number_error(where, fmt::format("{} is not finite", place.what));
    if (is_underflow(node)) return number_error(where, "the number is out of the range of double precision");
    return bare(number->get(), place);
  }
  if (const auto* text = node.as_string()) {
    const std::optional<Quantity> with_unit = quantity(*text, place.needed, scope);
    return with_unit ? converted(*with_unit, *text, place) : parsed(*text, place, scope);
  }
  const toml::table* table = node.as_table();
  if (table && (table->contains("value") || table->contains("unit")))
    return value_and_unit(*table, place, scope);
  return number_error(
      where, fmt::format("{} must be a number or an expression, not {}", place.what, type_in_words(node)));
}

Expression TomlFile::bare(double number, const Place& place) {
  return place.unit ? in_si(number, *place.unit) : number;
}

/// toml++ reads 1e-400 as zero.
bool TomlFile::is_underflow(const toml::node& node) const {
  if (node.as_floating_point()->get() != 0) return false;
  const toml::source_region& region = node.source();
  const std::size_t begin =
      lines_.offset(static_cast<int>(region.begin.line), static_cast<int>(region.begin.column));
  const std::size_t end =
      lines_.offset(static_cast<int>(region.end.line), static_cast<int>(region.end.column));
  const std::string_view written = std::string_view(diagnostics_.text()).substr(begin, end - begin);
  return written.substr(0, written.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos;
}

Expression TomlFile::parsed(const toml::value<std::string>& text, const Place& place, const Scope& scope) {
  const auto result = parse_expression(this->text(text), parameters_, scope, callables_);
  if (const auto* wrong = std::get_if<ExpressionError>(&result))
    return number_error(inside(text, wrong->offset, wrong->length), wrong->message, wrong->hint);
  const auto& [expression, measure] = std::get<MeasuredExpression>(result);
  if (!measure.fits(place.needed))
    return misfit(text, measure, place, measure.has_counts() ? kCountHint : "");
  const std::optional<Expression> of_parameters = with_meanings(expression);
  if (!of_parameters)
    return number_error(
        range(text.source()),
        fmt::format("{} has more than {} operations where the parameters that follow from others "
                    "are written out",
                    place.what, kMaximumExpressionSize));
  Expression in_si_units = in_unit(*of_parameters, measure, range(text.source()), place);
  if (!expression.has_no_variable()) {
    if (in_si_units.has_undefined_part(values_))
      return number_error(range(text.source()), "a part of it has no finite value at the parameters' values");
    return in_si_units;
  }
  if (expression.calls(support::Function::kCall))
    return number_error(range(text.source()), "an external function is called with nothing that moves",
                        "a number of the model does not depend on code that is not here");
  const double at_defaults = value(in_si_units);
  if (!std::isfinite(at_defaults))
    return number_error(range(text.source()),
                        fmt::format("the value is {} at the parameters' values",
                                    std::isnan(at_defaults) ? "not a number" : "infinite"));
  return in_si_units;
}

/// A part of an expression or a unit, or all of it where the string is written with escapes.
SourceRange TomlFile::inside(const toml::value<std::string>& text, std::size_t offset,
                             std::size_t length) const {
  const toml::source_position& begin = text.source().begin;
  const std::size_t quote = lines_.offset(static_cast<int>(begin.line), static_cast<int>(begin.column));
  const std::string_view written = std::string_view(diagnostics_.text()).substr(quote);
  const std::size_t first = written.find_first_not_of(written.substr(0, 1));
  const bool as_written = !text.get().empty() &&
                          !(repetition_ && text.get().find('{') != std::string::npos) &&
                          first != std::string_view::npos && written.substr(first).starts_with(text.get());
  return as_written ? lines_.range(quote + first + offset, length) : range(text.source());
}

std::optional<Unit> TomlFile::unit(const toml::value<std::string>& text, std::size_t offset) {
  const std::string meant = this->text(text);
  const auto result = parse_unit(std::string_view(meant).substr(std::min(offset, meant.size())));
  if (const auto* unit = std::get_if<Unit>(&result)) return *unit;
  const auto& wrong = std::get<UnitError>(result);
  error(inside(text, offset + wrong.offset, wrong.length), wrong.message, wrong.hint);
  return {};
}

double TomlFile::constant(const toml::node& node, const Place& place) {
  const Expression result = expression(node, place);
  if (result.is_constant()) return result.constant();
  number_error(range(node.source()),
               fmt::format("{} must be constant, it cannot depend on parameters", place.what));
  return 0;
}

}  // namespace jourdain::model
