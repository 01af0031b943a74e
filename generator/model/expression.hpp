// Arithmetic over literals and named parameters, as it stands in a model file ("m/3*l^2", "30*deg").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "model/dimensions.hpp"
#include "support/check.hpp"
#include "support/elementary_functions.hpp"
#include "support/index.hpp"

namespace jourdain::model {

using ParameterIndex = support::Index<struct ParameterTag>;

/// A quantity that changes as the mechanism moves. What an expression may refer to depends on where it stands.
struct Variable {
  enum class Kind {
    kTime,            ///< t, s
    kPosition,        ///< scalar coordinate `component` of joint `index`, prescribed ones too
    kVelocity,        ///< its rate
    kInput,           ///< u[index]
    kFramePosition,   ///< component x, y, z of the origin of frame `index`, inertial frame, m
    kFrameVelocity,   ///< its velocity, inertial frame, m/s
    kFrameSpin,       ///< component of the frame's angular velocity, in its own axes, rad/s
    kFrameWorldSpin,  ///< of the same, inertial frame
    kFrameDirection,  ///< R_ij with `component` 3 i + j: component i of axis j of frame `index`, inertial frame
    kState,           ///< number `index` of the states beside the mechanism
    kStepLength,      ///< of the step that begins, s; in what a state is sampled to
    kArgument  ///< `component` of what it is a function of: a curve's coordinate; a spring's length (0), rate (1)
  };
  Kind kind = Kind::kTime;
  std::size_t index = 0;
  std::size_t component = 0;

  /// Of a coordinate or of a frame.
  bool is_rate() const {
    return kind == Kind::kVelocity || kind == Kind::kFrameVelocity || kind == Kind::kFrameSpin ||
           kind == Kind::kFrameWorldSpin;
  }
  bool operator==(const Variable&) const = default;
};

/// A number that may depend on tunable parameters and on variables. Operands come before their operator, the
/// last node is the value; a node may be the operand of several.
/// Subexpressions without either are folded to one double on construction: a model's numbers are rounded to
/// double once, on reading. Exact identities are applied: 1*x = x, x+0 = x, 0*x = 0, -(-x) = x, x^1 = x, x^0 = 1.
class Expression {
 public:
  enum class Op {
    kLiteral,
    kParameter,
    kVariable,
    kNegate,
    kAdd,
    kSubtract,
    kMultiply,
    kDivide,
    kPower,
    kSqrt,
    kSin,
    kCos,
    kFunction  ///< `function`, of one operand or two
  };
  struct Node {
    Op op = Op::kLiteral;
    double value = 0;               ///< kLiteral
    ParameterIndex parameter = {};  ///< kParameter
    Variable variable = {};         ///< kVariable
    int exponent = 0;               ///< kPower: integer exponent
    support::Function function = support::Function::kExp;
    std::size_t left = 0;  ///< operand (unary) or left operand
    std::size_t right = 0;
  };

  Expression() : Expression(0.0) {}
  Expression(double value)
      : nodes_{Node{.op = Op::kLiteral, .value = value}} {}  // NOLINT: numbers are expressions
  static Expression parameter(ParameterIndex index);
  static Expression variable(const Variable& variable);
  static Expression unary(Op op, const Expression& operand);
  static Expression binary(Op op, const Expression& left, const Expression& right);
  static Expression power(const Expression& base, int exponent);
  static Expression function(support::Function function, const Expression& operand);
  static Expression function(support::Function function, const Expression& left, const Expression& right);
  /// `nodes` on top of operands that are there once: an operand of a node is one of those, or after them an earlier
  /// node. The last node is the value.
  static Expression composed(std::span<const Expression> operands, const std::vector<Node>& nodes);
  /// sin/cos of one shared operand, so that nested tangents do not grow exponentially.
  static Expression tangent(const Expression& operand);

  bool is_constant() const { return nodes_.size() == 1 && nodes_[0].op == Op::kLiteral; }
  /// The same expression with each variable replaced.
  Expression substituted(const std::function<Expression(const Variable&)>& replacement) const;
  /// The same expression with each parameter replaced.
  Expression with_parameters(const std::function<Expression(ParameterIndex)>& replacement) const;

  /// Refers to no variable.
  bool has_no_variable() const;
  /// The value of an expression without parameters and variables.
  double constant() const;
  /// Some part without variables has no finite value at these parameters.
  bool has_undefined_part(std::span<const double> parameters) const;
  /// Operations and operands where shared operands count each time; no more than a little beyond the limit.
  std::size_t written_out_size() const;
  /// Value or derivative may jump where a variable moves on: see support::FunctionFacts.
  bool has_kinks() const;
  /// Calls `function`.
  bool calls(support::Function function) const;
  bool is_zero() const { return is_constant() && constant() == 0; }
  const std::vector<Node>& nodes() const { return nodes_; }

  /// Value in the arithmetic of `T` (double, long double, GiNaC::ex, …) with the given parameter values; `sqrt`,
  /// `sin`, `cos` and, of the functions, `value_of` are found by argument-dependent lookup (the standard ones for
  /// built-in types, support::value_of where a type has no own). `literal` turns a double into a T, `variable` a
  /// Variable.
  template <class T, class Literal, class VariableValue>
  T evaluate(std::span<const T> parameters, Literal&& literal, VariableValue&& variable) const;
  /// Without variables.
  template <class T, class Literal>
  T evaluate(std::span<const T> parameters, Literal&& literal) const {
    return evaluate<T>(parameters, literal, [](const Variable&) -> T {
      throw support::InternalError("an expression without variables has one");
    });
  }
  template <class T>
  T evaluate(std::span<const T> parameters) const {
    return evaluate<T>(parameters, [](double v) { return T(v); });
  }

 private:
  explicit Expression(std::vector<Node> nodes) : nodes_(std::move(nodes)) {}
  static Expression with_operand(Node node, const Expression& operand);
  static Expression with_operands(Node node, const Expression& left, const Expression& right);
  /// The same expression with each leaf that is no number replaced.
  template <class Replacement>
  Expression with_leaves(const Replacement& replacement) const;

  std::vector<Node> nodes_;
};

/// Why a text is not an expression: offset in the text, length of the offending part, message, hint.
struct ExpressionError {
  std::size_t offset = 0;
  std::size_t length = 1;
  std::string message;
  std::string hint;
};

inline constexpr std::size_t kMaximumExpressionLength = 2000;
inline constexpr int kMaximumExpressionDepth = 100;
inline constexpr std::size_t kMaximumExpressionSize = 5000;     ///< with derived parameters written out
inline constexpr std::size_t kMaximumWrittenOutSize = 1000000;  ///< with what is used twice written twice

/// A name that an expression may use for a variable or an expression of some; it may have one dot in it ("hinge.rate").
struct ScopeEntry {
  std::string name;
  Variable variable;
  Measure measure;
  std::string_view refusal = {};           ///< why it may not be used here, a hint; empty: it may
  std::optional<Expression> meaning = {};  ///< that it stands for, instead of a variable
};
using Scope = std::vector<ScopeEntry>;

struct DeclaredParameter {
  std::string name;
  Measure measure;
};

struct MeasuredExpression {
  Expression expression;
  Measure measure;
};

/// Parses + - * / ^ ( ), numbers, `pi`, `deg` (π/180), the functions of expression_functions.hpp, if(a < b, x, y) and
/// the given names. `^` binds tighter than unary minus. Text over kMaximumExpressionLength or nested deeper than
/// kMaximumExpressionDepth, or with more than kMaximumExpressionSize operations, or kMaximumWrittenOutSize where
/// functions that are made of others are written out, unknown names (with "did you mean"), NaN or infinity are errors,
/// and so are sums and functions of what has the wrong dimensions (see dimensions.hpp).
std::variant<MeasuredExpression, ExpressionError> parse_expression(
    std::string_view text, const std::vector<DeclaredParameter>& parameters, const Scope& scope = {});

template <class T, class Literal, class VariableValue>
T Expression::evaluate(std::span<const T> parameters, Literal&& literal, VariableValue&& variable) const {
  using std::cos;
  using std::sin;
  using std::sqrt;
  using support::value_of;
  std::vector<T> values;
  values.reserve(nodes_.size());
  // 1/(1/0) is no number, though it would be 0 in doubles; 1/0 is infinite.
  const auto number = [&](T value) {
    if (values.size() + 1 == nodes_.size()) return value;
    if constexpr (std::is_floating_point_v<T>)
      return support::finite_or_nan(value);
    else if constexpr (requires(T carrier) { requires std::floating_point<decltype(carrier.value)>; })
      value.value = support::finite_or_nan(value.value);
    return value;
  };
  for (const Node& node : nodes_) {
    switch (node.op) {
      case Op::kLiteral:
        values.push_back(literal(node.value));
        break;
      case Op::kParameter:
        JD_CHECK(node.parameter.value < parameters.size(), "parameter {}", node.parameter.value);
        values.push_back(parameters[node.parameter.value]);
        break;
      case Op::kVariable:
        values.push_back(T(variable(node.variable)));
        break;
      case Op::kNegate:
        values.push_back(T(-values[node.left]));
        break;
      case Op::kAdd:
        values.push_back(T(values[node.left] + values[node.right]));
        break;
      case Op::kSubtract:
        values.push_back(T(values[node.left] - values[node.right]));
        break;
      case Op::kMultiply:
        values.push_back(T(values[node.left] * values[node.right]));
        break;
      case Op::kDivide:
        values.push_back(number(T(values[node.left] / values[node.right])));
        break;
      case Op::kPower: {
        T product = literal(1.0);
        for (int i = 0; i < (node.exponent < 0 ? -node.exponent : node.exponent); ++i)
          product = T(product * values[node.left]);
        values.push_back(number(node.exponent < 0 ? T(literal(1.0) / product) : product));
        break;
      }
      case Op::kSqrt:
        values.push_back(T(sqrt(values[node.left])));
        break;
      case Op::kSin:
        values.push_back(T(sin(values[node.left])));
        break;
      case Op::kCos:
        values.push_back(T(cos(values[node.left])));
        break;
      case Op::kFunction:
        values.push_back(number(T(value_of(node.function, values[node.left], values[node.right]))));
        break;
    }
  }
  return values.back();
}

using Vector3 = std::array<Expression, 3>;

/// Whether `holds` says so of a variable of the expression.
template <class Holds>
bool any_variable(const Expression& expression, const Holds& holds) {
  return std::any_of(expression.nodes().begin(), expression.nodes().end(), [&](const Expression::Node& node) {
    return node.op == Expression::Op::kVariable && holds(node.variable);
  });
}

}  // namespace jourdain::model
