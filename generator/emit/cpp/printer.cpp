#include "emit/cpp/printer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/constant_tables.hpp"
#include "emit/function_names.hpp"
#include "emit/layout.hpp"

namespace jourdain::emit::cpp {

using Kind = Expression::Kind;

std::string digits_text(double value) {
  std::string digits = fmt::format("{}", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits;
}

std::string literal_text(double value) { return fmt::format("Real({})", digits_text(value)); }

namespace {

/// Binding strength of an expression's outermost operation.
enum class Strength { kSum, kProduct, kAtom };

struct Text {
  std::string text;
  Strength strength = Strength::kAtom;
};

bool is_table(const Expression& e) {
  return e.kind == Kind::kName && std::find(kTables.begin(), kTables.end(), e.name) != kTables.end();
}

std::string lanes_type(std::size_t count, const std::string& real) {
  return fmt::format("detail::Lanes<{}, {}>", count, real);
}

class ExpressionPrinter {
 public:
  explicit ExpressionPrinter(const Place& place) : place_(place) {}

  /// The numbers of lanes: `{a, b}`.
  std::string list(const Expression& e) const {
    std::string text;
    for (std::size_t i = 0; i < e.operands.size(); ++i) text += (i == 0 ? "" : ", ") + whole(e, i);
    return "{" + text + "}";
  }

  Text print(const Expression& e) const {
    switch (e.kind) {
      case Kind::kReal:
        return {literal_text(e.number)};
      case Kind::kInteger:
        return {fmt::format("{}", static_cast<long>(e.number))};
      case Kind::kPositionCount:
        return {"Model<Real>::position_count"};
      case Kind::kVelocityCount:
        return {"Model<Real>::velocity_count"};
      case Kind::kName:
        return {e.name};
      case Kind::kMember:
        return {whole(e, 0) + "." + e.name};
      case Kind::kEntry:
        if (is_table(e.operands[0])) return {fmt::format("{}({})", whole(e, 0), whole(e, 1))};
        return {fmt::format("{}[{}]", whole(e, 0), whole(e, 1))};
      case Kind::kFrom:
        return {fmt::format("{} + {}", whole(e, 0), whole(e, 1)), Strength::kSum};
      case Kind::kOperation:
        return operation(e);
      case Kind::kLanes:
        return {lanes_type(e.operands.size(), "Real") + list(e)};
      case Kind::kToReal:
        return {fmt::format("Real({})", whole(e, 0))};
      case Kind::kToAngle:
        return {fmt::format("detail::Angle<Real>({})", whole(e, 0))};
      case Kind::kInvoke: {
        std::string arguments;
        for (std::size_t i = 1; i < e.operands.size(); ++i) arguments += (i == 1 ? "" : ", ") + whole(e, i);
        return {fmt::format("{}.{}({})", whole(e, 0), e.name, arguments)};
      }
      case Kind::kInputsAt:
        if (!place_.samples_inputs) return {"input"};
        return {fmt::format("{}input_at(input, {})", place_.in_detail ? "" : "detail::", whole(e, 0))};
    }
    return {};
  }

 private:
  std::string whole(const Expression& e, std::size_t operand) const {
    return print(e.operands[operand]).text;
  }

  std::string at_least(const Expression& e, std::size_t operand, Strength strength) const {
    const Text text = print(e.operands[operand]);
    return text.strength >= strength ? text.text : "(" + text.text + ")";
  }

  Text infix(const Expression& e, const char* sign, Strength strength) const {
    const Strength right = strength == Strength::kSum ? Strength::kProduct : Strength::kAtom;
    return {at_least(e, 0, strength) + sign + at_least(e, 1, right), strength};
  }

  Text call(const std::string& function, const std::string& arguments) const {
    return {fmt::format("{}{}({})", place_.in_detail ? "" : "detail::", function, arguments)};
  }

  Text call(const Expression& e, const char* function) const {
    return call(function, e.operands.size() > 1 ? whole(e, 0) + ", " + whole(e, 1) : whole(e, 0));
  }

  Text operation(const Expression& e) const {
    switch (e.operation) {
      case ir::Op::kNegate:
        return {"-" + at_least(e, 0, Strength::kAtom), Strength::kSum};
      case ir::Op::kAdd:
        return infix(e, " + ", Strength::kSum);
      case ir::Op::kSubtract:
        return infix(e, " - ", Strength::kSum);
      case ir::Op::kMultiply:
        return infix(e, " * ", Strength::kProduct);
      case ir::Op::kDivide:
        return infix(e, " / ", Strength::kProduct);
      case ir::Op::kSqrt:
        return call(e, "square_root");
      case ir::Op::kSin:
        return call(e, "sine");
      case ir::Op::kCos:
        return call(e, "cosine");
      case ir::Op::kLiteral:
      case ir::Op::kLeaf:
        break;
      case ir::Op::kEntry:
        return call(table_function(e.operands[1].number), whole(e, 0));
      default:
        return call(e, function_name(ir::function_of(e.operation)));
    }
    return {};
  }

  const Place& place_;
};

class StatementPrinter {
 public:
  StatementPrinter(const Place& place, std::size_t indent) : place_(place), indent_(indent) {}

  std::string operator()(const Declare& declare) const {
    const char* change = declare.change == Declare::Change::kNever      ? "constexpr "
                         : declare.change == Declare::Change::kConstant ? "const "
                                                                        : "";
    const std::string type = change + type_text(declare.type, "Real", place_) + " ";
    std::vector<std::string> variables;
    for (const Variable& variable : declare.variables)
      variables.push_back(declared(variable, place_) + initial(variable));
    if (variables.size() > 1) return aligned(std::string(indent_, ' ') + type, variables, ";");
    return line(type + variables[0] + ";" + (declare.comment.empty() ? "" : "  // " + declare.comment));
  }
  std::string operator()(const Set& set) const {
    std::string text;
    for (const Expression& target : set.targets) text += of(target) + " = ";
    return line(text + of(set.value) + ";");
  }
  std::string operator()(const SineCosine& pair) const {
    return line(
        fmt::format("{}sine_cosine({}, {}, {});", prefix(true), of(pair.angle), pair.sine, pair.cosine));
  }
  std::string operator()(const Loop& loop) const {
    const std::string& i = loop.variable;
    const std::string head =
        loop.descends
            ? fmt::format("for (int {0} = {1} - 1; {0} >= {2}; --{0})", i, of(loop.end), of(loop.first))
            : fmt::format("for (int {0} = {1}; {0} < {2}; ++{0})", i, of(loop.first), of(loop.end));
    return controlled(head, loop.body);
  }
  std::string operator()(const AtStart& start) const {
    const std::string head =
        fmt::format("if ({} {} {})", of(start.left), start.is_less ? "<" : "==", of(start.right));
    if (start.otherwise.empty()) return controlled(head, start.then);
    return line(head + " {") + statements_text(start.then, place_, indent_ + 2) + line("} else {") +
           statements_text(start.otherwise, place_, indent_ + 2) + line("}");
  }
  std::string operator()(const Call& call) const {
    std::string arguments;
    for (const Expression& argument : call.arguments)
      arguments += (arguments.empty() ? "" : ", ") + of(argument);
    return line(fmt::format("{}{}({});", prefix(call.is_support), call.function, arguments));
  }
  std::string operator()(const Return& result) const { return line("return " + of(result.value) + ";"); }
  std::string operator()(const Nearby& nearby) const {
    return line(fmt::format("{} (&{})[{}] = {}nearby({});", type_text(nearby.type, "Real", place_),
                            nearby.variable, nearby.extent, prefix(true), nearby.window));
  }

 private:
  std::string of(const Expression& e) const { return expression_text(e, place_); }
  std::string line(const std::string& text) const { return wrapped(text, indent_); }
  const char* prefix(bool is_support) const { return is_support && !place_.in_detail ? "detail::" : ""; }

  std::string initial(const Variable& variable) const {
    if (variable.value && variable.value->kind == Kind::kLanes)
      return " = " + ExpressionPrinter(place_).list(*variable.value);
    if (variable.value) return " = " + of(*variable.value);
    if (variable.entries.empty()) return "";
    std::string list;
    for (const Expression& entry : variable.entries) list += (list.empty() ? "" : ", ") + of(entry);
    return " = {" + list + "}";
  }

  /// A single statement follows on the line of `head` where it fits and is no loop, otherwise on the next; several are
  /// in braces.
  std::string controlled(const std::string& head, const Statements& body) const {
    if (body.size() != 1) return line(head + " {") + statements_text(body, place_, indent_ + 2) + line("}");
    const std::string single = statements_text(body, place_, 0);
    if (!std::holds_alternative<Loop>(body[0].is) && single.find('\n') + 1 == single.size() &&
        indent_ + head.size() + single.size() <= kLineLength)
      return line(head + " " + single.substr(0, single.size() - 1));
    return line(head) + statements_text(body, place_, indent_ + 2);
  }

  const Place& place_;
  std::size_t indent_;
};

}  // namespace

std::string expression_text(const Expression& expression, const Place& place) {
  return ExpressionPrinter(place).print(expression).text;
}

std::string statements_text(const Statements& statements, const Place& place, std::size_t indent) {
  const StatementPrinter printer(place, indent);
  std::string text;
  for (const Statement& statement : statements) text += std::visit(printer, statement.is);
  return text;
}

std::string type_text(const Type& type, const std::string& real, const Place& place) {
  switch (type.kind) {
    case Type::Kind::kReal:
      return real;
    case Type::Kind::kAngle:
      return fmt::format("detail::Angle<{}>", real);
    case Type::Kind::kInteger:
      return "int";
    case Type::Kind::kLanes:
      return lanes_type(static_cast<std::size_t>(type.depth), real);
    case Type::Kind::kStruct:
      return fmt::format("{}{}<{}{}>", type.is_support && !place.in_detail ? "detail::" : "", type.name,
                         type.depth > 0 ? fmt::format("{}, ", type.depth) : "", real);
  }
  return {};
}

std::string declared(const Variable& variable, const Place& place) {
  std::string text = variable.name;
  for (const Expression& extent : variable.extents)
    text += fmt::format("[{}]", expression_text(extent, place));
  return text;
}

}  // namespace jourdain::emit::cpp
