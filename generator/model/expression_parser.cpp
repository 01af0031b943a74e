// Recursive descent with a bounded depth; the grammar, loosest binding first:
//   sum := product (('+'|'-') product)*      product := signed (('*'|'/') signed)*
//   signed := ('+'|'-') signed | power       power := primary ('^' signed)?
//   primary := number | name | function '(' sum (',' sum)* ')' | '(' sum ')'
//            | callable '(' sum (',' sum)* ')' | 'if' '(' sum ('<' | '<=' | '>' | '>=') sum ',' sum ',' sum ')'
// Dimensions are inferred beside; the first that do not agree are an error where the syntax has none and a
// parameter with a unit stands in the expression.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>

#include "model/callable.hpp"
#include "model/expression.hpp"
#include "model/expression_dimensions.hpp"
#include "model/expression_functions.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

namespace {

using Op = Expression::Op;

constexpr int kMaximumExponent = 64;

using Term = MeasuredExpression;

class Parser : public ExpressionDimensions {
 public:
  Parser(std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope,
         const std::vector<Callable>& callables)
      : ExpressionDimensions(text), parameters_(parameters), scope_(scope), callables_(callables) {}

  Term parse() {
    Term result = sum(0);
    if (at_end()) return result;
    const std::size_t begin = position_;
    if (text_[begin] == ')') fail(begin, 1, "')' without '('");
    const bool operand = is_digit(text_[begin]) || starts_name(text_[begin]) || text_[begin] == '(';
    const bool compares = text_[begin] == '<' || text_[begin] == '>';
    const bool reciprocal = text_.substr(begin).starts_with("1/");
    fail(begin, operand ? 1 : character(begin),
         fmt::format("expected an operator, found '{}'", rest_of_word(begin)),
         reciprocal ? "a product needs '*'; the unit 1/m is written m^-1"
         : operand  ? "a product needs '*'"
         : compares ? "numbers are compared in if(a < b, x, y)"
                    : "");
  }

  /// A parameter with a unit stands in the expression.
  bool is_strict() const { return strict_; }

 private:
  /// Checks what an operation written at `begin` gave.
  Expression finite(Expression value, std::size_t begin) const {
    if (value.is_constant() && !std::isfinite(value.constant()))
      fail(begin, position_ - begin,
           std::isnan(value.constant()) ? "the value is not a number" : "the value is infinite");
    return value;
  }

  Term sum(int depth) {
    const std::size_t begin = skip_blanks();
    Term result = product(depth);
    for (;;) {
      const std::string_view left = written(begin, skip_blanks());
      const bool adds = accept('+');
      if (!adds && !accept('-')) return result;
      const std::size_t second = skip_blanks();
      const Term right = product(depth);
      const std::optional<Measure> measure = result.measure.plus(right.measure);
      if (!measure)
        note_mismatch(begin, fmt::format("'{}' ({}) and '{}' ({}) are {}", support::shown(left),
                                         result.measure.unit(), support::shown(written(second, position_)),
                                         right.measure.unit(), adds ? "added" : "subtracted"));
      result = {
          finite(Expression::binary(adds ? Op::kAdd : Op::kSubtract, result.expression, right.expression),
                 begin),
          measure.value_or(Measure::open())};
    }
  }

  Term product(int depth) {
    const std::size_t begin = position_;
    Term result = signed_power(depth);
    for (;;) {
      if (accept('*')) {
        if (next_is('*'))
          fail(position_ - 1, 2, "expected an operand, found '*'", "powers are written with '^'");
        const Term right = signed_power(depth);
        result = {finite(Expression::binary(Op::kMultiply, result.expression, right.expression), begin),
                  result.measure.times(right.measure)};
      } else if (accept('/')) {
        const std::size_t divisor = skip_blanks();
        const Term right = signed_power(depth);
        if (right.expression.is_zero()) fail(divisor, position_ - divisor, "division by zero");
        result = {finite(Expression::binary(Op::kDivide, result.expression, right.expression), begin),
                  result.measure.over(right.measure)};
      } else {
        return result;
      }
    }
  }

  Term signed_power(int depth) {
    const std::size_t begin = skip_blanks();
    if (depth > kMaximumExpressionDepth)
      fail(begin, 1, fmt::format("nested deeper than {} levels", kMaximumExpressionDepth));
    if (accept('-')) {
      const Term operand = signed_power(depth + 1);
      return {Expression::unary(Op::kNegate, operand.expression), operand.measure};
    }
    if (accept('+')) return signed_power(depth + 1);
    Term base = primary(depth);
    if (!accept('^')) return base;
    const std::size_t where = skip_blanks();
    const Term exponent = signed_power(depth + 1);
    Term result = raised(base, exponent, begin, where);
    result.expression = finite(std::move(result.expression), begin);
    return result;
  }

  Term raised(const Term& base, const Term& exponent, std::size_t begin, std::size_t where) {
    if (!exponent.measure.fits(needed::kPure))
      note_mismatch(where, fmt::format("an exponent is a pure number, but '{}' is in {}",
                                       support::shown(written(where, position_)), exponent.measure.unit()));
    const Measure measure = measure_of_power(base.measure, exponent.expression, exponent.measure);
    if (!exponent.expression.is_constant()) {
      check_pure("a power whose exponent is no number", base.measure, begin, where);
      return {real_power(base.expression, exponent.expression), measure};
    }
    const double value = exponent.expression.constant();
    if (base.expression.is_zero() && value < 0) fail(begin, position_ - begin, "division by zero");
    if (value == 0.5) return {square_root(base.expression, begin), measure};
    if (std::abs(value) > kMaximumExponent)
      fail(where, position_ - where,
           fmt::format("exponent {} is not between {} and {}", value, -kMaximumExponent, kMaximumExponent));
    return {real_power(base.expression, value), measure};
  }

  Expression square_root(const Expression& operand, std::size_t begin) const {
    if (operand.is_constant() && operand.constant() < 0)
      fail(begin, position_ - begin, fmt::format("square root of a negative number, {}", operand.constant()));
    return Expression::unary(Op::kSqrt, operand);
  }

  Term primary(int depth) {
    if (at_end()) fail(position_ == 0 ? 0 : position_ - 1, 1, "expected a number or a name, found the end");
    const std::size_t begin = position_;
    if (accept('(')) {
      Term inner = sum(depth + 1);
      if (!accept(')')) fail(begin, 1, "'(' is not closed");
      return inner;
    }
    if (is_digit(text_[begin]) || text_[begin] == '.') return number();
    if (starts_name(text_[begin])) return name(depth);
    fail(begin, character(begin),
         fmt::format("expected a number or a name, found '{}'", rest_of_word(begin)));
  }

  Term number() {
    const std::size_t begin = position_;
    double value = 0;
    const char* const end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + begin, end, value);
    const auto length = static_cast<std::size_t>(stop - text_.data()) - begin;
    if (error == std::errc::invalid_argument) fail(begin, 1, "'.' is not a number");
    if (error != std::errc()) fail(begin, length, "the number is out of the range of double precision");
    position_ = begin + length;
    return {Expression(value), Measure::literal(text_.substr(begin, length))};
  }

  Term name(int depth) {
    const std::size_t begin = position_;
    const std::string_view word = dotted_name_at(begin);
    position_ += word.size();
    if (next_is('('))
      for (const Callable& callable : callables_)
        if (callable.name == word) return value_of(callable, begin, depth);
    const auto is_called = [word](const ScopeEntry& entry) { return entry.name == word; };
    const auto variable = std::find_if(scope_.begin(), scope_.end(), is_called);
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (parameters_[i].name != word) continue;
      if (variable != scope_.end() && variable->refusal.empty())
        fail(begin, word.size(), fmt::format("'{}' names a parameter and something that moves", word),
             "rename the parameter");
      strict_ = strict_ || parameters_[i].measure.is_anchored();
      return {Expression::parameter(ParameterIndex(i)), parameters_[i].measure};
    }
    if (variable != scope_.end() && !variable->refusal.empty())
      fail(begin, word.size(), fmt::format("'{}' may not be used here", word),
           std::string(variable->refusal));
    if (variable != scope_.end() &&
        (is_expression_word(word) || (word == "t" && std::count_if(variable, scope_.end(), is_called) > 1)))
      fail(begin, word.size(), fmt::format("'{}' has two meanings", word), "rename the coordinate or input");
    if (variable != scope_.end())
      return {variable->meaning.value_or(Expression::variable(variable->variable)), variable->measure};
    if (word == "pi") return {Expression(std::numbers::pi), Measure::count()};
    if (word == "deg") return {Expression(std::numbers::pi / 180), Measure::degree()};
    if (next_is('(')) return word == "if" ? selection(depth) : function(word, begin, depth);
    if (const NamedFunction* function = find_function(word))
      fail(begin, word.size(), fmt::format("function '{}' needs an argument", word),
           fmt::format("write {}({})", word, function->count == 1 ? "..." : function->arguments));
    for (const Callable& callable : callables_)
      if (callable.name == word)
        fail(begin, word.size(), fmt::format("{} '{}' needs an argument", callable.kind, word),
             fmt::format("write {}({})", word, in_words(callable.arguments)));
    std::vector<std::string> known;
    for (const DeclaredParameter& parameter : parameters_) known.push_back(parameter.name);
    known.insert(known.end(), {"pi", "deg"});
    for (const ScopeEntry& entry : scope_)
      if (entry.refusal.empty()) known.push_back(entry.name);
    const std::string close = support::nearest(word, known);
    fail(begin, word.size(), fmt::format("unknown name '{}'", support::shown(word)),
         !close.empty()               ? fmt::format("did you mean '{}'?", close)
         : word == "t"                ? "time may not be used here"
         : word.starts_with("world.") ? "the world does not move: positions are measured in it"
                                      : "declare it in [parameters]");
  }

  Term function(std::string_view word, std::size_t begin, int depth) {
    const NamedFunction* function = find_function(word);
    if (!function)
      fail(begin, word.size(), fmt::format("unknown function '{}'", support::shown(word)),
           close_function(word));
    const std::size_t bracket = position_;
    accept('(');
    const std::size_t inside = skip_blanks();
    std::vector<Expression> arguments;
    std::optional<Measure> common;
    for (std::size_t i = 0; i < function->count; ++i) {
      if (i > 0 && !accept(','))
        fail(begin, position_ - begin, fmt::format("function '{}' needs {} arguments", word, function->count),
             fmt::format("write {}({})", word, function->arguments));
      const std::size_t at = skip_blanks();
      const Term argument = sum(depth + 1);
      arguments.push_back(argument.expression);
      if (function->dimensions == NamedFunction::Dimensions::kPower && i == 1)
        return power(*common, arguments, argument, begin, at);
      check_argument(*function, argument.measure, at);
      common = i == 0 ? argument.measure : in_common(*common, argument.measure, inside, word);
    }
    close(bracket, word, function->arguments);
    return {called(*function, arguments, begin), measure_of(function->dimensions, *common)};
  }

  static std::string in_words(const std::vector<Callable::Argument>& arguments) {
    std::vector<std::string_view> names;
    for (const Callable::Argument& argument : arguments) names.push_back(argument.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  Term value_of(const Callable& callable, std::size_t begin, int depth) {
    const std::size_t bracket = position_;
    const std::string names = in_words(callable.arguments);
    accept('(');
    std::vector<Expression> arguments;
    for (const Callable::Argument& needed : callable.arguments) {
      if (!arguments.empty() && !accept(','))
        fail(bracket, position_ - bracket,
             fmt::format("{} '{}' needs {} arguments", callable.kind, callable.name,
                         callable.arguments.size()),
             fmt::format("write {}({})", callable.name, names));
      const std::size_t at = skip_blanks();
      const Term argument = sum(depth + 1);
      if (!argument.measure.plus(needed.measure))
        note_mismatch(at, fmt::format("{} '{}' needs {}, but '{}' is in {}", callable.kind, callable.name,
                                      needed.measure.unit(), support::shown(written(at, position_)),
                                      argument.measure.unit()));
      arguments.push_back(argument.expression);
    }
    close(bracket, callable.name, names, callable.kind);
    strict_ = strict_ || callable.has_units();
    return {finite(callable.value(arguments), begin), callable.measure};
  }

  std::string close_function(std::string_view word) const {
    std::vector<std::string> known = function_names();
    for (const Callable& callable : callables_) known.push_back(callable.name);
    const std::string close = support::nearest(word, known);
    return close.empty() ? fmt::format("known are {}", fmt::join(known, ", "))
                         : fmt::format("did you mean '{}'?", close);
  }

  /// pow(x, p), as x^p.
  Term power(const Measure& measure, const std::vector<Expression>& arguments, const Term& exponent,
             std::size_t begin, std::size_t where) {
    Term result = raised({arguments[0], measure}, exponent, begin, where);
    close(begin, "pow", "x, exponent");
    result.expression = finite(std::move(result.expression), begin);
    return result;
  }

  Expression called(const NamedFunction& function, const std::vector<Expression>& arguments,
                    std::size_t begin) const {
    if (function.dimensions == NamedFunction::Dimensions::kRoot) return square_root(arguments[0], begin);
    const Expression& last = arguments.back();
    if (function.arguments.ends_with("width") && last.is_constant() && last.constant() == 0)
      fail(begin, position_ - begin, fmt::format("the width of '{}' is zero: it has a kink", function.name),
           "abs, sign, min and max say that they have one");
    return finite(function.of(arguments), begin);
  }

  /// if(a < b, x, y)
  Term selection(int depth) {
    const std::size_t bracket = position_;
    accept('(');
    const std::size_t inside = skip_blanks();
    const Term left = sum(depth + 1);
    const bool less = next_is('<');
    if (!less && !next_is('>'))
      fail(inside, position_ - inside, "'if' needs a comparison by <, <=, > or >=", "write if(a < b, x, y)");
    ++position_;
    const bool or_equal = position_ < text_.size() && text_[position_] == '=';
    position_ += or_equal ? 1 : 0;
    const Term right = sum(depth + 1);
    in_common(left.measure, right.measure, inside, "'if'");
    comma(inside);
    const std::size_t first = skip_blanks();
    const Term taken = sum(depth + 1);
    comma(inside);
    const Term otherwise = sum(depth + 1);
    const Measure measure = in_common(taken.measure, otherwise.measure, first, "'if'");
    close(bracket, "if", "a < b, x, y");
    return {where_less(less ? left.expression : right.expression, less ? right.expression : left.expression,
                       or_equal, taken.expression, otherwise.expression),
            measure};
  }

  void comma(std::size_t begin) {
    if (!accept(',')) fail(begin, position_ - begin, "'if' needs three arguments", "write if(a < b, x, y)");
  }

  void close(std::size_t bracket, std::string_view function, std::string_view arguments,
             std::string_view kind = "function") {
    if (next_is(','))
      fail(position_, 1, fmt::format("{} '{}' has an argument too many", kind, function),
           fmt::format("write {}({})", function, arguments));
    if (!accept(')')) fail(bracket, 1, "'(' is not closed");
  }

  const std::vector<DeclaredParameter>& parameters_;
  const Scope& scope_;
  const std::vector<Callable>& callables_;
  bool strict_ = false;
};

}  // namespace

std::variant<MeasuredExpression, ExpressionError> parse_expression(
    std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope) {
  return parse_expression(text, parameters, scope, {});
}

std::variant<MeasuredExpression, ExpressionError> parse_expression(
    std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope,
    const std::vector<Callable>& callables) {
  if (text.size() > kMaximumExpressionLength)
    return ExpressionError{
        0, 1, fmt::format("the expression is longer than {} characters", kMaximumExpressionLength), ""};
  try {
    Parser parser(text, parameters, scope, callables);
    MeasuredExpression result = parser.parse();
    if (result.expression.written_out_size() > kMaximumWrittenOutSize)
      return ExpressionError{
          0, text.size(),
          fmt::format("the expression has more than {} operations where functions are written out",
                      kMaximumWrittenOutSize),
          "some are made of others, as tan(x) is sin(x)/cos(x): each one around another doubles what is "
          "inside"};
    if (result.expression.nodes().size() > kMaximumExpressionSize)
      return ExpressionError{
          0, text.size(), fmt::format("the expression has more than {} operations", kMaximumExpressionSize),
          "a table has some for each of its points, a function all of its own at each call"};
    if (parser.is_strict() && parser.mismatch()) return *parser.mismatch();
    if (!parser.is_strict()) result.measure = result.measure.times(Measure::open());
    return result;
  } catch (const ExpressionError& error) {
    return error;
  }
}

}  // namespace jourdain::model
