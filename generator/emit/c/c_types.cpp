#include "emit/c/c_types.hpp"

#include "support/check.hpp"

namespace jourdain::emit::c {

using Kind = Expression::Kind;

namespace {

CType of(const Type& type) {
  switch (type.kind) {
    case Type::Kind::kReal:
      return {};
    case Type::Kind::kAngle:
      return {CType::Kind::kAngle};
    case Type::Kind::kInteger:
      return {CType::Kind::kInteger};
    case Type::Kind::kStruct:
      return {CType::Kind::kStruct, type.name};
    case Type::Kind::kLanes:
      break;
  }
  JD_CHECK(false, "C has no lanes");
  return {};
}

}  // namespace

void CScope::add(const std::string& name, const CVariable& variable) { variables_[name] = variable; }

void CScope::add(const std::string& name, const Type& type, bool is_pointer) {
  const CType known = of(type);
  if (const CVariable* before = find(name))
    JD_CHECK(before->type.kind == known.kind && before->type.structure == known.structure &&
                 !before->is_pointer && !is_pointer,
             "'{}' means two things", name);
  variables_[name] = {known, is_pointer};
}

const CVariable* CScope::find(const std::string& name) const {
  const auto it = variables_.find(name);
  return it == variables_.end() ? nullptr : &it->second;
}

CType CScope::type_of(const Expression& expression) const {
  switch (expression.kind) {
    case Kind::kReal:
    case Kind::kLanes:
    case Kind::kToReal:
    case Kind::kInvoke:
      return {};
    case Kind::kInteger:
    case Kind::kPositionCount:
    case Kind::kVelocityCount:
      return {CType::Kind::kInteger};
    case Kind::kName: {
      const CVariable* variable = find(expression.name);
      JD_CHECK(variable, "'{}' is not declared", expression.name);
      return variable->type;
    }
    case Kind::kMember:
      return type_of_member(expression);
    case Kind::kEntry:
    case Kind::kFrom:
      return type_of(expression.operands[0]);
    case Kind::kOperation:
      return type_of_operation(expression);
    case Kind::kToAngle:
      return {CType::Kind::kAngle};
    case Kind::kInputsAt:
      return {CType::Kind::kStruct, "Input"};
  }
  return {};
}

CType CScope::type_of_member(const Expression& expression) const {
  const std::string structure = type_of(expression.operands[0]).structure;
  if (structure == "State" && expression.name == "t") return {CType::Kind::kTime};
  if (structure == "ImplicitStage" && expression.name == "state") return {CType::Kind::kStruct, "State"};
  const bool remembers = structure == "RateHistory" || structure == "Accelerations";
  return {remembers && expression.name == "count" ? CType::Kind::kInteger : CType::Kind::kReal};
}

CType CScope::type_of_operation(const Expression& expression) const {
  const ir::Op op = expression.operation;
  if (op == ir::Op::kSqrt || op == ir::Op::kSin || op == ir::Op::kCos || ir::is_function(op)) return {};
  // Each operand is looked at once: sums are nested deeply.
  bool has_angle = false, has_time = false, has_real = false;
  for (const Expression& operand : expression.operands) {
    const CType::Kind kind = type_of(operand).kind;
    has_angle = has_angle || kind == CType::Kind::kAngle;
    has_time = has_time || kind == CType::Kind::kTime;
    has_real = has_real || kind == CType::Kind::kReal;
  }
  if (has_angle) return {CType::Kind::kAngle};
  if (has_time) return {CType::Kind::kTime};
  return {has_real ? CType::Kind::kReal : CType::Kind::kInteger};
}

}  // namespace jourdain::emit::c
