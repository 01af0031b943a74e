#include "emit/tree.hpp"

#include <algorithm>

namespace jourdain::emit {

using ir::Op;
using Kind = Expression::Kind;

Expression::Expression() = default;
Expression::Expression(double real) : kind(Kind::kReal), number(real) {}
Expression::Expression(int integer) : number(integer) {}
Expression::Expression(std::size_t integer) : number(static_cast<double>(integer)) {}
Expression::Expression(Kind k, std::string n, std::vector<Expression> o)
    : kind(k), name(std::move(n)), operands(std::move(o)) {}
Expression::Expression(const Expression&) = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(const Expression&) = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

Expression Expression::operator[](const Expression& index) const {
  return {Kind::kEntry, "", {*this, index}};
}
Expression Expression::from(const Expression& index) const { return {Kind::kFrom, "", {*this, index}}; }
Expression Expression::dot(const std::string& member) const { return {Kind::kMember, member, {*this}}; }

Statement::Statement(Declare declare) : is(std::move(declare)) {}
Statement::Statement(Set set) : is(std::move(set)) {}
Statement::Statement(SineCosine pair) : is(std::move(pair)) {}
Statement::Statement(Loop loop) : is(std::move(loop)) {}
Statement::Statement(AtStart start) : is(std::move(start)) {}
Statement::Statement(Call call) : is(std::move(call)) {}
Statement::Statement(Return result) : is(std::move(result)) {}
Statement::Statement(Nearby nearby) : is(std::move(nearby)) {}
Statement::Statement(const Statement&) = default;
Statement::Statement(Statement&&) noexcept = default;
Statement& Statement::operator=(const Statement&) = default;
Statement& Statement::operator=(Statement&&) noexcept = default;
Statement::~Statement() = default;

Expression name(const std::string& variable) { return {Kind::kName, variable}; }

Expression operation(Op op, std::vector<Expression> operands) {
  Expression result(Kind::kOperation, "", std::move(operands));
  result.operation = op;
  return result;
}

Expression operator+(const Expression& a, const Expression& b) { return operation(Op::kAdd, {a, b}); }
Expression operator-(const Expression& a, const Expression& b) { return operation(Op::kSubtract, {a, b}); }
Expression operator*(const Expression& a, const Expression& b) { return operation(Op::kMultiply, {a, b}); }
Expression operator/(const Expression& a, const Expression& b) { return operation(Op::kDivide, {a, b}); }
Expression operator-(const Expression& a) { return operation(Op::kNegate, {a}); }
Expression square_root(const Expression& a) { return operation(Op::kSqrt, {a}); }
Expression lanes(std::vector<Expression> numbers) { return {Kind::kLanes, "", std::move(numbers)}; }
Expression to_real(const Expression& a) { return {Kind::kToReal, "", {a}}; }
Expression to_angle(const Expression& time) { return {Kind::kToAngle, "", {time}}; }
Expression invoke(const Expression& object, const std::string& function, std::vector<Expression> arguments) {
  arguments.insert(arguments.begin(), object);
  return {Kind::kInvoke, function, std::move(arguments)};
}
Expression inputs_at(const Expression& state) { return {Kind::kInputsAt, "", {state}}; }
Expression position_count() { return {Kind::kPositionCount, ""}; }
Expression velocity_count() { return {Kind::kVelocityCount, ""}; }

Statement set(const Expression& target, const Expression& value) { return {Set{{target}, value}}; }

Statement constant(const std::string& variable, const Expression& value) {
  return {Declare{{}, Declare::Change::kConstant, {{variable, {}, value}}}};
}

Statement loop(const std::string& variable, const Expression& end, Statements body) {
  return {Loop{variable, 0, end, false, std::move(body)}};
}

bool mentions(const Expression& expression, const std::string& variable) {
  if (expression.kind == Kind::kName && expression.name == variable) return true;
  if (expression.kind == Kind::kInputsAt && variable == "input") return true;
  return std::any_of(expression.operands.begin(), expression.operands.end(),
                     [&](const Expression& operand) { return mentions(operand, variable); });
}

namespace {

/// Whether one statement mentions `variable`.
struct Mentions {
  const std::string& variable;

  bool any(const std::vector<Expression>& expressions) const {
    return std::any_of(expressions.begin(), expressions.end(),
                       [this](const Expression& e) { return mentions(e, variable); });
  }
  bool operator()(const Declare& declare) const {
    return std::any_of(declare.variables.begin(), declare.variables.end(), [this](const Variable& v) {
      return v.name == variable || any(v.entries) || (v.value && mentions(*v.value, variable));
    });
  }
  bool operator()(const Set& set) const { return any(set.targets) || mentions(set.value, variable); }
  bool operator()(const SineCosine& pair) const {
    return pair.sine == variable || pair.cosine == variable || mentions(pair.angle, variable);
  }
  bool operator()(const Loop& loop) const {
    return mentions(loop.first, variable) || mentions(loop.end, variable) || mentions(loop.body, variable);
  }
  bool operator()(const AtStart& start) const {
    return any({start.left, start.right}) || mentions(start.then, variable) ||
           mentions(start.otherwise, variable);
  }
  bool operator()(const Call& call) const { return any(call.arguments); }
  bool operator()(const Return& result) const { return mentions(result.value, variable); }
  bool operator()(const Nearby& nearby) const {
    return nearby.window == variable || nearby.variable == variable;
  }
};

}  // namespace

bool mentions(const Statements& statements, const std::string& variable) {
  return std::any_of(statements.begin(), statements.end(),
                     [&](const Statement& s) { return std::visit(Mentions{variable}, s.is); });
}

}  // namespace jourdain::emit
