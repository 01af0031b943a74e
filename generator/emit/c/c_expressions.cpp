#include "emit/c/c_expressions.hpp"

#include <fmt/format.h>

#include "emit/constant_tables.hpp"
#include "emit/function_names.hpp"
#include "support/check.hpp"

namespace jourdain::emit::c {

using Kind = Expression::Kind;

bool CExpressions::is_pointer(const Expression& expression) const {
  if (expression.kind != Kind::kName) return false;
  const CVariable* variable = scope_.find(expression.name);
  return variable && variable->is_pointer;
}

std::string CExpressions::address(const Expression& structure) const {
  return is_pointer(structure) ? structure.name : "&" + text(structure);
}

std::string CExpressions::object(const Expression& structure) const {
  return is_pointer(structure) ? "*" + structure.name : text(structure);
}

std::string CExpressions::name(const std::string& name) const {
  const CVariable* variable = scope_.find(name);
  return variable && !variable->text.empty() ? variable->text : name;
}

std::string CExpressions::whole(const Expression& e, std::size_t operand) const {
  return text(e.operands[operand]);
}

std::string CExpressions::at_least(const Expression& operand, Strength strength) const {
  const Text printed = print(operand);
  return printed.strength >= strength ? printed.text : "(" + printed.text + ")";
}

CExpressions::Text CExpressions::print(const Expression& e) const {
  switch (e.kind) {
    case Kind::kReal:
      return {names_.literal(e.number)};
    case Kind::kInteger:
      return {fmt::format("{}", static_cast<long>(e.number))};
    case Kind::kPositionCount:
      return {names_.count("position")};
    case Kind::kVelocityCount:
      return {names_.count("velocity")};
    case Kind::kName:
      return {name(e.name)};
    case Kind::kMember:
      return {whole(e, 0) + (is_pointer(e.operands[0]) ? "->" : ".") + e.name};
    case Kind::kEntry:
      return {fmt::format("{}[{}]", whole(e, 0), whole(e, 1))};
    case Kind::kLanes:
      break;  // of C++
    case Kind::kFrom:
      return {fmt::format("{} + {}", whole(e, 0), whole(e, 1)), Strength::kSum};
    case Kind::kOperation:
      return operation(e);
    case Kind::kToReal: {
      const CType::Kind kind = scope_.type_of(e.operands[0]).kind;
      if (kind == CType::Kind::kReal) return print(e.operands[0]);
      if (kind == CType::Kind::kInteger)
        return {fmt::format("({}){}", names_.real(), at_least(e.operands[0], Strength::kAtom))};
      return {whole(e, 0) + ".high"};
    }
    case Kind::kToAngle:
      return {fmt::format("{}({})", names_.internal("angle_of_time"), whole(e, 0))};
    case Kind::kInvoke: {
      std::string arguments = whole(e, 0) + ".context";
      for (std::size_t i = 1; i < e.operands.size(); ++i) arguments += ", " + whole(e, i);
      return {fmt::format("{}.{}({})", whole(e, 0), e.name, arguments)};
    }
    case Kind::kInputsAt:
      return {"*input"};
  }
  return {};
}

std::string CExpressions::call(const std::string& function, const Expression& e) const {
  std::string arguments = whole(e, 0);
  if (e.operands.size() > 1) arguments += ", " + whole(e, 1);
  return fmt::format("{}({})", names_.internal(function), arguments);
}

std::string CExpressions::angle(const Expression& e) const {
  switch (scope_.type_of(e).kind) {
    case CType::Kind::kAngle:
      return text(e);
    case CType::Kind::kTime:
      return fmt::format("{}({})", names_.internal("angle_of_time"), text(e));
    case CType::Kind::kReal:
      return fmt::format("{}({})", names_.internal("angle_of"), text(e));
    case CType::Kind::kInteger:
    case CType::Kind::kStruct:
      break;
  }
  JD_CHECK(false, "no angle");
  return {};
}

std::string CExpressions::angle_operation(const Expression& e) const {
  const auto call = [&](const char* function) {
    std::string arguments = angle(e.operands[0]);
    if (e.operands.size() > 1) arguments += ", " + angle(e.operands[1]);
    return fmt::format("{}({})", names_.internal(function), arguments);
  };
  switch (e.operation) {
    case ir::Op::kNegate:
      return call("angle_negative");
    case ir::Op::kAdd:
      return call("angle_sum");
    case ir::Op::kSubtract:
      return call("angle_difference");
    case ir::Op::kMultiply:
      return call("angle_product");
    case ir::Op::kDivide:
      return call("angle_quotient");
    case ir::Op::kSqrt:
    case ir::Op::kSin:
    case ir::Op::kCos:
    case ir::Op::kLiteral:
    case ir::Op::kLeaf:
    default:
      break;
  }
  JD_CHECK(false, "no operation of angles");
  return {};
}

CExpressions::Text CExpressions::infix(const Expression& e, const char* sign, Strength strength) const {
  const Strength right = strength == Strength::kSum ? Strength::kProduct : Strength::kAtom;
  return {at_least(e.operands[0], strength) + sign + at_least(e.operands[1], right), strength};
}

CExpressions::Text CExpressions::operation(const Expression& e) const {
  const CType::Kind kind = scope_.type_of(e).kind;
  if (kind == CType::Kind::kAngle) return {angle_operation(e)};
  if (kind == CType::Kind::kTime) {
    JD_CHECK(e.operation == ir::Op::kAdd, "no operation of times");
    return {fmt::format("{}({}, {})", names_.global("time_after"), whole(e, 0), whole(e, 1))};
  }
  const bool turns = scope_.type_of(e.operands[0]).kind == CType::Kind::kAngle;
  switch (e.operation) {
    case ir::Op::kNegate: {
      // "(-2.0)" is a literal, "-(2.0)" the negative of one.
      const bool literal = e.operands[0].kind == Kind::kReal;
      const std::string operand = at_least(e.operands[0], Strength::kAtom);
      return {"-" + (literal ? "(" + operand + ")" : operand), Strength::kSum};
    }
    case ir::Op::kAdd:
      return infix(e, " + ", Strength::kSum);
    case ir::Op::kSubtract:
      return infix(e, " - ", Strength::kSum);
    case ir::Op::kMultiply:
      return infix(e, " * ", Strength::kProduct);
    case ir::Op::kDivide:
      return infix(e, " / ", Strength::kProduct);
    case ir::Op::kSqrt:
      return {call("square_root", e)};
    case ir::Op::kSin:
      return {call(turns ? "angle_sine" : "sine", e)};
    case ir::Op::kCos:
      return {call(turns ? "angle_cosine" : "cosine", e)};
    case ir::Op::kEntry:
      return {fmt::format("{}({})", names_.internal(table_function(e.operands[1].number)), whole(e, 0))};
    default:
      return {call(function_name(ir::function_of(e.operation)), e)};
    case ir::Op::kLiteral:
    case ir::Op::kLeaf:
      break;
  }
  return {};
}

}  // namespace jourdain::emit::c
