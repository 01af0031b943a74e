// Expressions of C as those of C++ that they mean: functions of sums of numbers are operations, names of functions lose
// their prefix.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "readback/expression_parser.hpp"
#include "readback/function_texts.hpp"

namespace jourdain::readback {

namespace {

struct SumOperation {
  std::string_view name;
  ExpressionKind kind;
  BinaryOp operation;
};

/// Functions of passages that stand for numbers, and what they compute; a cast leaves a number what it is.
constexpr std::array<SumOperation, 9> kSumOperations = {
    {{"time_at", ExpressionKind::kCast, BinaryOp::kAdd},
     {"time_after", ExpressionKind::kBinary, BinaryOp::kAdd},
     {"angle_of", ExpressionKind::kCast, BinaryOp::kAdd},
     {"angle_of_time", ExpressionKind::kCast, BinaryOp::kAdd},
     {"angle_negative", ExpressionKind::kNegate, BinaryOp::kAdd},
     {"angle_sum", ExpressionKind::kBinary, BinaryOp::kAdd},
     {"angle_difference", ExpressionKind::kBinary, BinaryOp::kSubtract},
     {"angle_product", ExpressionKind::kBinary, BinaryOp::kMultiply},
     {"angle_quotient", ExpressionKind::kBinary, BinaryOp::kDivide}}};

/// Functions of angles, and those of numbers that compute the same.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kOfAngles = {
    {{"angle_sine_cosine", "sine_cosine"}, {"angle_sine", "sine"}, {"angle_cosine", "cosine"}}};

}  // namespace

TypeName ExpressionParser::c_type() {
  TypeName result;
  result.is_const = accept_word("const");
  if (is_word(known_.c->real())) {
    take();
    result.path = {unit_.symbols["Real"]};
    return result;
  }
  for (const char* word : {"int", "void", "char"})
    if (accept_word(word)) {
      result.path = {unit_.symbols[word]};
      return result;
    }
  const auto it = peek().kind == TokenKind::kName ? known_.c_types.find(unit_.symbols[peek().text])
                                                  : known_.c_types.end();
  if (it == known_.c_types.end()) refuse_here("a type");
  take();
  const bool is_const = result.is_const;
  result = it->second;
  result.is_const = is_const;
  return result;
}

const Expression* ExpressionParser::as_real(const Expression* value) {
  Expression& made = make(ExpressionKind::kCast);
  TypeName& real = unit_.types.emplace_back();
  real.path = {unit_.symbols["Real"]};
  made.type = &real;
  made.arguments = {value};
  return &made;
}

const Expression* ExpressionParser::dereferenced(const Expression* pointer) {
  Expression& made = make(ExpressionKind::kDereference);
  made.a = pointer;
  return &made;
}

/// `(-2.5)`, which is a number, `(double)k`, or an expression in parentheses.
const Expression* ExpressionParser::c_parenthesis() {
  expect("(");
  if (is("-") && peek(1).kind == TokenKind::kFloating && is(")", 2)) {
    take();
    const Expression* literal = number(true);
    expect(")");
    return literal;
  }
  if (is_word(known_.c->real()) && is(")", 1)) {
    take();
    take();
    return as_real(unary());
  }
  const Expression* inner = expression();
  expect(")");
  return inner;
}

/// A variable keeps its whole name; a function is that of the namespace, or of namespace detail, whose prefix it has.
const Expression* ExpressionParser::c_name() {
  Expression& made = make(ExpressionKind::kName);
  if (!is("(", 1) || is_word("input_at")) {
    made.name = expect_name();
    return &made;
  }
  std::string_view text = peek().text;
  const std::string internal = known_.c->internal();
  if (text.starts_with(internal)) {
    text.remove_prefix(internal.size());
    TypeName& scope = unit_.types.emplace_back();
    scope.path = {unit_.symbols["detail"]};
    made.type = &scope;
  } else if (text.starts_with(known_.c->prefix)) {
    text.remove_prefix(known_.c->prefix.size());
  } else {
    if (known_.c->is_float && !text.ends_with('f')) refuse_here("a function for float");
    if (known_.c->is_float) text.remove_suffix(1);
    if (std::none_of(library_names().begin(), library_names().end(),
                     [text](const LibraryName& known) { return known.name == text; }))
      refuse_here("a function that is known");
  }
  expect_name();
  made.name = unit_.symbols[text];
  return &made;
}

/// `model->functions.grip(model->functions.context, x)`: of what goes to functions of the user only the numbers.
const Expression* ExpressionParser::c_call_of_user(Expression& call) {
  std::vector<const Expression*>& arguments = call.arguments;
  const auto is_member = [this](const Expression* of, std::string_view name) {
    return of->kind == ExpressionKind::kMember && unit_.symbols.text(of->name) == name;
  };
  const auto is_of_model = [&](const Expression* object) {
    return is_member(object, "functions") && object->a->kind == ExpressionKind::kDereference &&
           object->a->a->kind == ExpressionKind::kName && unit_.symbols.text(object->a->a->name) == "model";
  };
  if (arguments.empty() || !is_member(arguments[0], "context") || !is_of_model(arguments[0]->a) ||
      !is_of_model(call.a->a))
    refuse_here("a function of the user and its context");
  arguments.erase(arguments.begin());
  return &call;
}

const Expression* ExpressionParser::c_call(Expression& call) {
  if (call.a->kind == ExpressionKind::kMember) return c_call_of_user(call);
  if (call.a->kind != ExpressionKind::kName) return &call;
  const std::string& name = unit_.symbols.text(call.a->name);
  const auto& arguments = call.arguments;
  if (name == "input_at" && !call.a->type) {
    // input_at(context, &state, &input);
    const bool has_context = arguments.size() == 3 && arguments[0]->kind == ExpressionKind::kName &&
                             unit_.symbols.text(arguments[0]->name) == "context";
    if (!has_context) refuse_here("a context, a state and an input");
    Expression& set = make(ExpressionKind::kAssign);
    set.a = dereferenced(arguments[2]);
    call.arguments = {dereferenced(arguments[1])};
    set.b = &call;
    return &set;
  }
  if (!known_.c_operations.count(name)) return &call;
  for (const auto& [of_angle, of_number] : kOfAngles)
    if (name == of_angle) {
      Expression& callee = make(ExpressionKind::kName);
      callee.type = call.a->type;
      callee.name = unit_.symbols[of_number];
      call.a = &callee;
      return &call;
    }
  for (const SumOperation& known : kSumOperations) {
    if (name != known.name) continue;
    if (arguments.size() != (known.kind == ExpressionKind::kBinary ? 2u : 1u))
      refuse_here(fmt::format("other arguments of {}", name));
    if (known.kind == ExpressionKind::kCast) return as_real(arguments[0]);
    Expression& made = make(known.kind);
    made.operation = known.operation;
    made.moves_time = name == "time_after";
    made.a = arguments[0];
    if (known.kind == ExpressionKind::kBinary) made.b = arguments[1];
    return &made;
  }
  return &call;
}

}  // namespace jourdain::readback
