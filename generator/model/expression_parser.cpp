// Recursive descent with a bounded depth; the grammar, loosest binding first:
//   sum := product (('+'|'-') product)*      product := signed (('*'|'/') signed)*
//   signed := ('+'|'-') signed | power       power := primary ('^' signed)?
//   primary := number | name | function '(' sum ')' | '(' sum ')'
// Dimensions are inferred beside; the first that do not agree are an error where the syntax has none and a
// parameter with a unit stands in the expression.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>

#include "model/expression.hpp"
#include "support/diagnostics.hpp"
#include "support/utf8.hpp"

namespace jourdain::model {

namespace {

using Op = Expression::Op;

constexpr int kMaximumExponent = 64;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

using Term = MeasuredExpression;

class Parser {
 public:
  Parser(std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope)
      : text_(text), parameters_(parameters), scope_(scope) {}

  Term parse() {
    Term result = sum(0);
    if (at_end()) return result;
    const std::size_t begin = position_;
    if (text_[begin] == ')') fail(begin, 1, "')' without '('");
    const bool operand = is_digit(text_[begin]) || starts_name(text_[begin]) || text_[begin] == '(';
    fail(begin, operand ? 1 : character(begin),
         fmt::format("expected an operator, found '{}'", rest_of_word(begin)),
         operand ? "a product needs '*'" : "");
  }

  /// A parameter with a unit stands in the expression.
  bool is_strict() const { return strict_; }
  /// The first dimensions that do not agree.
  const std::optional<ExpressionError>& mismatch() const { return mismatch_; }

 private:
  [[noreturn]] void fail(std::size_t offset, std::size_t length, std::string message,
                         std::string hint = "") const {
    throw ExpressionError{offset, std::max<std::size_t>(1, length), std::move(message), std::move(hint)};
  }

  bool at_end() {
    while (position_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[position_]) != std::string_view::npos)
      ++position_;
    return position_ == text_.size();
  }

  bool next_is(char c) { return !at_end() && text_[position_] == c; }

  bool accept(char c) {
    if (!next_is(c)) return false;
    ++position_;
    return true;
  }

  std::size_t character(std::size_t offset) const { return support::utf8_at(text_, offset).bytes; }

  std::string_view name_at(std::size_t begin) const {
    std::size_t end = begin;
    while (end < text_.size() && (starts_name(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(begin, end - begin);
  }

  /// With a member after one dot.
  std::string_view dotted_name_at(std::size_t begin) const {
    const std::string_view word = name_at(begin);
    const std::size_t dot = begin + word.size();
    if (word.empty() || dot + 1 >= text_.size() || text_[dot] != '.' || !starts_name(text_[dot + 1]))
      return word;
    return text_.substr(begin, word.size() + 1 + name_at(dot + 1).size());
  }

  std::string rest_of_word(std::size_t begin) const {
    const std::string_view name = name_at(begin);
    return support::shown(name.empty() ? text_.substr(begin, character(begin)) : name);
  }

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

  /// Without the blanks at its end.
  std::string_view written(std::size_t begin, std::size_t end) const {
    const std::string_view part = text_.substr(begin, end - begin);
    return part.substr(0, part.find_last_not_of(" \t\r\n") + 1);
  }

  /// Of what begins at `begin` and was read last.
  void note_mismatch(std::size_t begin, std::string message) {
    if (!mismatch_)
      mismatch_ = {begin, std::max<std::size_t>(1, written(begin, position_).size()), std::move(message), ""};
  }

  std::size_t skip_blanks() {
    at_end();
    return position_;
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
    const Expression exponent = signed_power(depth + 1).expression;
    Term result = raised(base, exponent, begin, where);
    result.expression = finite(std::move(result.expression), begin);
    return result;
  }

  Term raised(const Term& base, const Expression& exponent, std::size_t begin, std::size_t where) const {
    const std::size_t length = position_ - where;
    if (!exponent.is_constant()) fail(where, length, "an exponent must not depend on parameters");
    const double value = exponent.constant();
    if (base.expression.is_zero() && value < 0) fail(begin, position_ - begin, "division by zero");
    if (value == 0.5) return {square_root(base.expression, begin), base.measure.square_root()};
    if (value != std::floor(value) || std::abs(value) > kMaximumExponent)
      fail(where, length,
           fmt::format("exponent {} is neither 0.5 nor an integer between {} and {}", value,
                       -kMaximumExponent, kMaximumExponent));
    const int power = static_cast<int>(value);
    return {Expression::power(base.expression, power), base.measure.power(power)};
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
    const auto variable = std::find_if(scope_.begin(), scope_.end(),
                                       [word](const ScopeEntry& entry) { return entry.name == word; });
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
    if (variable != scope_.end()) return {Expression::variable(variable->variable), variable->measure};
    if (word == "pi") return {Expression(std::numbers::pi), Measure::count()};
    if (word == "deg") return {Expression(std::numbers::pi / 180), Measure::degree()};
    if (next_is('(')) return function(word, begin, depth);
    if (word == "sqrt" || word == "sin" || word == "cos" || word == "tan")
      fail(begin, word.size(), fmt::format("function '{}' needs an argument", word),
           fmt::format("write {}(...)", word));
    std::vector<std::string> known;
    for (const DeclaredParameter& parameter : parameters_) known.push_back(parameter.name);
    known.insert(known.end(), {"pi", "deg"});
    for (const ScopeEntry& entry : scope_)
      if (entry.refusal.empty()) known.push_back(entry.name);
    const std::string close = support::nearest(word, known);
    fail(begin, word.size(), fmt::format("unknown name '{}'", support::shown(word)),
         !close.empty() ? fmt::format("did you mean '{}'?", close)
         : word == "t"  ? "time may not be used here"
                        : "declare it in [parameters]");
  }

  Term function(std::string_view word, std::size_t begin, int depth) {
    const bool known = word == "sqrt" || word == "sin" || word == "cos" || word == "tan";
    if (!known)
      fail(begin, word.size(), fmt::format("unknown function '{}'", support::shown(word)),
           "known are sqrt, sin, cos, tan");
    const std::size_t bracket = position_;
    accept('(');
    const std::size_t inside = skip_blanks();
    const Term argument = sum(depth + 1);
    check_argument(word, argument.measure, inside);
    if (!accept(')')) fail(bracket, 1, "'(' is not closed");
    if (word == "sqrt") return {square_root(argument.expression, begin), argument.measure.square_root()};
    const Measure measure = Measure::ratio_of(argument.measure);
    if (word == "tan") return {finite(Expression::tangent(argument.expression), begin), measure};
    const Op op = word == "sin" ? Op::kSin : Op::kCos;
    return {finite(Expression::unary(op, argument.expression), begin), measure};
  }

  void check_argument(std::string_view function, const Measure& argument, std::size_t begin) {
    if (function == "sqrt" || argument.fits(needed::kAngle)) return;
    note_mismatch(begin, fmt::format("{} needs rad, but '{}' is in {}", function,
                                     support::shown(written(begin, position_)), argument.unit()));
  }

  std::string_view text_;
  const std::vector<DeclaredParameter>& parameters_;
  const Scope& scope_;
  std::size_t position_ = 0;
  std::optional<ExpressionError> mismatch_;
  bool strict_ = false;
};

/// Operations and operands where shared operands count each time; no more than a little beyond the limit.
std::size_t written_out(const Expression& expression) {
  std::vector<std::size_t> sizes;
  for (const Expression::Node& node : expression.nodes()) {
    const bool leaf = sizes.empty() || node.op == Expression::Op::kLiteral ||
                      node.op == Expression::Op::kParameter || node.op == Expression::Op::kVariable;
    const std::size_t both = leaf ? 0 : sizes[node.left] + (node.right == node.left ? 0 : sizes[node.right]);
    sizes.push_back(std::min(1 + both, kMaximumExpressionSize + 1));
  }
  return sizes.back();
}

}  // namespace

std::variant<MeasuredExpression, ExpressionError> parse_expression(
    std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope) {
  if (text.size() > kMaximumExpressionLength)
    return ExpressionError{
        0, 1, fmt::format("the expression is longer than {} characters", kMaximumExpressionLength), ""};
  try {
    Parser parser(text, parameters, scope);
    MeasuredExpression result = parser.parse();
    if (written_out(result.expression) > kMaximumExpressionSize)
      return ExpressionError{
          0, text.size(),
          fmt::format("the expression has more than {} operations where tangents are written out",
                      kMaximumExpressionSize),
          "tan(x) is sin(x)/cos(x): each one around another doubles what is inside"};
    if (parser.is_strict() && parser.mismatch()) return *parser.mismatch();
    if (!parser.is_strict()) result.measure = result.measure.times(Measure::open());
    return result;
  } catch (const ExpressionError& error) {
    return error;
  }
}

}  // namespace jourdain::model
