// Expressions of the interpreter.
#include <fmt/format.h>

#include "readback/interpreter.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

/// Additions of Time's operator+.
constexpr std::size_t kMovesTime = 7;

Value of_number(Number number) {
  Value value;
  value.kind = Value::Kind::kNumber;
  value.number = number;
  return value;
}

Value of_integer(long integer, Value::Kind kind = Value::Kind::kInteger) {
  Value value;
  value.kind = kind;
  value.integer = integer;
  return value;
}

Value of_native(double native) {
  Value value;
  value.kind = Value::Kind::kNative;
  value.native = native;
  return value;
}

bool is_arithmetic(BinaryOp op) {
  return op == BinaryOp::kAdd || op == BinaryOp::kSubtract || op == BinaryOp::kMultiply ||
         op == BinaryOp::kDivide;
}

ir::Op operation(BinaryOp op) {
  switch (op) {
    case BinaryOp::kAdd:
      return ir::Op::kAdd;
    case BinaryOp::kSubtract:
      return ir::Op::kSubtract;
    case BinaryOp::kMultiply:
      return ir::Op::kMultiply;
    default:
      return ir::Op::kDivide;
  }
}

template <class T>
T arithmetic(BinaryOp op, T a, T b) {
  switch (op) {
    case BinaryOp::kAdd:
      return a + b;
    case BinaryOp::kSubtract:
      return a - b;
    case BinaryOp::kMultiply:
      return a * b;
    default:
      return a / b;
  }
}

template <class T>
bool comparison(BinaryOp op, T a, T b) {
  switch (op) {
    case BinaryOp::kLess:
      return a < b;
    case BinaryOp::kGreater:
      return a > b;
    case BinaryOp::kLessEqual:
      return a <= b;
    case BinaryOp::kGreaterEqual:
      return a >= b;
    case BinaryOp::kEqual:
      return a == b;
    default:
      return a != b;
  }
}

}  // namespace

/// The value in a place that holds a scalar; other values are what they are.
Value Interpreter::load(const Value& value, const Expression& expression) {
  if (value.kind != Value::Kind::kPlace) return value;
  const Type::Kind kind = value.type->kind;
  if (kind != Type::Kind::kNumber && kind != Type::Kind::kInteger && kind != Type::Kind::kBool) return value;
  const Cell& held = memory_[value.address];
  if (held.kind == Cell::Kind::kUnset) refuse_at(expression.place, "what is read here has no value yet");
  if (kind == Type::Kind::kNumber) return of_number(held.number);
  return of_integer(held.integer, kind == Type::Kind::kBool ? Value::Kind::kBool : Value::Kind::kInteger);
}

Value Interpreter::evaluate(const Expression& expression) {
  spend(expression.place);
  switch (expression.kind) {
    case ExpressionKind::kInteger:
      return of_integer(expression.integer);
    case ExpressionKind::kFloating:
      return of_native(expression.floating);
    case ExpressionKind::kBool:
      return of_integer(expression.integer, Value::Kind::kBool);
    case ExpressionKind::kString:
    case ExpressionKind::kNull:
    case ExpressionKind::kList:
      refuse_at(expression.place, "a string, nullptr or list in an expression");
    case ExpressionKind::kName:
      return name(expression);
    case ExpressionKind::kNegate:
      return negate(expression);
    case ExpressionKind::kNot:
      return of_integer(!condition(*expression.a), Value::Kind::kBool);
    case ExpressionKind::kAddress:
      return address(expression);
    case ExpressionKind::kDereference:
      return dereference(expression);
    case ExpressionKind::kIncrement:
      return step(expression, 1);
    case ExpressionKind::kDecrement:
      return step(expression, -1);
    case ExpressionKind::kBinary:
      return binary(expression);
    case ExpressionKind::kAssign:
      return assign(expression);
    case ExpressionKind::kCall:
      return call(expression);
    case ExpressionKind::kCast:
      return cast(expression);
    case ExpressionKind::kSubscript:
      return subscript(expression);
    case ExpressionKind::kMember:
      return member(expression);
  }
  return {};
}

/// A variable, a member of the object that is constructed, a static constant around, a constant of the namespace.
Value Interpreter::name(const Expression& expression) {
  if (expression.type || expression.global) return static_member(expression);
  const std::size_t meaning = meaning_[expression.name];
  const Frame& inner = frame();
  if (meaning > inner.base) return variables_[meaning - 1].value;
  if (inner.self.kind == Value::Kind::kPlace)
    if (const Field* field = inner.self.type->structure->find(expression.name)) {
      Value place = inner.self;
      place.type = field->type;
      place.address += field->offset;
      return place;
    }
  if (inner.inside)
    for (const Member& member : inner.inside->syntax->members)
      if (member.is_static && member.declarator.name == expression.name)
        return evaluate(*member.declarator.initial);
  return find_constant(expression.name, inner.scope, expression);
}

Value Interpreter::find_constant(Symbol name, const std::string& scope, const Expression& expression) {
  const auto it = constants_.find(name);
  if (it == constants_.end() || (!it->second->scope.empty() && it->second->scope != scope))
    refuse_at(expression.place, fmt::format("'{}' is not known here", unit_.symbols.text(name)));
  if (unit_.is_c && unit_.symbols.text(it->second->type.path[0]) == "Real")
    return evaluate(*it->second->declarator.initial);
  if (it->second->type.path != std::vector<Symbol>{it->second->type.path[0]} ||
      unit_.symbols.text(it->second->type.path[0]) != "int")
    refuse_at(expression.place, fmt::format("'{}' is no integer", unit_.symbols.text(name)));
  const auto known = constant_values_.find(it->second);
  if (known == constant_values_.end()) refuse_at(expression.place, "a constant without a value");
  return known->second;
}

/// `Model<Real>::position_count`.
Value Interpreter::static_member(const Expression& expression) {
  if (!expression.global && !expression.type->path.empty()) {
    const Struct* known = types_.find_struct(expression.type->path, lookup());
    if (known)
      return constant(types_.resolve(*expression.type, lookup()), unit_.symbols.text(expression.name));
  }
  refuse_at(expression.place, fmt::format("'{}' is no value", unit_.symbols.text(expression.name)));
}

Value Interpreter::constant(const Type* type, const std::string& name) {
  if (type->kind == Type::Kind::kStruct)
    for (const Member& member : type->structure->syntax->members)
      if (member.is_static && unit_.symbols.text(member.declarator.name) == name && member.declarator.initial)
        return evaluate(*member.declarator.initial);
  throw Refusal(fmt::format("{} has no constant '{}'", types_.text(type), name));
}

Value Interpreter::negate(const Expression& expression) {
  const Value a = evaluate_loaded(*expression.a);
  if (a.kind == Value::Kind::kNumber) return of_number(domain_.operate(ir::Op::kNegate, a.number));
  if (a.kind == Value::Kind::kNative) return of_native(-a.native);
  if (a.kind == Value::Kind::kInteger) return of_integer(-a.integer);
  refuse_at(expression.place, "the negative of what is no number");
}

Value Interpreter::pointer_to(const Value& array) const {
  Value pointer = array;
  pointer.kind = Value::Kind::kPointer;
  pointer.type = array.type->element;
  pointer.begin = array.address;
  pointer.end = array.address + array.type->cells;
  return pointer;
}

Value Interpreter::binary(const Expression& expression) {
  const BinaryOp op = expression.operation;
  if (op == BinaryOp::kAnd || op == BinaryOp::kOr) {
    const bool a = condition(*expression.a);
    return of_integer(a == (op == BinaryOp::kOr) ? a : condition(*expression.b), Value::Kind::kBool);
  }
  Value a = evaluate_loaded(*expression.a);
  const Value b = evaluate_loaded(*expression.b);
  if (a.kind == Value::Kind::kNumber && b.kind == Value::Kind::kNumber)
    return is_arithmetic(op) ? of_number(domain_.operate(operation(op), a.number, b.number))
                             : compare(expression, a, b);
  if ((is_lanes(a) || is_lanes(b)) && is_arithmetic(op)) return lane_by_lane(operation(op), a, b, expression);
  if (a.kind == Value::Kind::kPlace && a.type->kind == Type::Kind::kArray) a = pointer_to(a);
  if (a.kind == Value::Kind::kPointer && b.kind == Value::Kind::kInteger && op == BinaryOp::kAdd) {
    a.address += static_cast<std::size_t>(b.integer) * a.type->cells;
    if (b.integer < 0 || a.address > a.end) refuse_at(expression.place, "a pointer beyond its array");
    return a;
  }
  return binary_native(expression, a, b);
}

/// Of integers and constants of type double.
Value Interpreter::binary_native(const Expression& expression, const Value& a, const Value& b) {
  const auto is_native = [](const Value& v) {
    return v.kind == Value::Kind::kInteger || v.kind == Value::Kind::kNative;
  };
  if (!is_native(a) || !is_native(b)) refuse_at(expression.place, "an operation on values of two types");
  const bool is_arithmetic_op = is_arithmetic(expression.operation);
  if (a.kind == Value::Kind::kInteger && b.kind == Value::Kind::kInteger) {
    if (expression.operation == BinaryOp::kDivide && b.integer == 0)
      refuse_at(expression.place, "a division by zero");
    return is_arithmetic_op
               ? of_integer(arithmetic(expression.operation, a.integer, b.integer))
               : of_integer(comparison(expression.operation, a.integer, b.integer), Value::Kind::kBool);
  }
  const auto number = [](const Value& v) {
    return v.kind == Value::Kind::kNative ? v.native : double(v.integer);
  };
  return is_arithmetic_op
             ? of_native(arithmetic(expression.operation, number(a), number(b)))
             : of_integer(comparison(expression.operation, number(a), number(b)), Value::Kind::kBool);
}

Value Interpreter::compare(const Expression& expression, const Value& a, const Value& b) {
  const auto truth = [](bool value) { return of_integer(value, Value::Kind::kBool); };
  switch (expression.operation) {
    case BinaryOp::kLess:
      return truth(domain_.is_less(a.number, b.number));
    case BinaryOp::kGreater:
      return truth(domain_.is_less(b.number, a.number));
    case BinaryOp::kLessEqual:
      return truth(domain_.is_at_most(a.number, b.number));
    case BinaryOp::kGreaterEqual:
      return truth(domain_.is_at_most(b.number, a.number));
    default:
      refuse_at(expression.place, "numbers are compared for equality");
  }
}

void Interpreter::store(const Value& place, const Value& given, const Expression& expression) {
  const Value value = load(given, expression);
  if (place.type->kind == Type::Kind::kNumber && value.kind == Value::Kind::kNumber) {
    memory_[place.address] = number_cell(value.number);
  } else if (place.type->kind == Type::Kind::kInteger && value.kind == Value::Kind::kInteger) {
    memory_[place.address] = integer_cell(value.integer);
  } else if ((place.type->kind == Type::Kind::kStruct || place.type->kind == Type::Kind::kLanes) &&
             value.kind == Value::Kind::kPlace && value.type == place.type) {
    for (std::size_t i = 0; i < place.type->cells; ++i)
      memory_[place.address + i] = memory_[value.address + i];
  } else {
    refuse_at(expression.place, fmt::format("a value of another type for {}", types_.text(place.type)));
  }
}

Value Interpreter::assign(const Expression& expression) {
  const Value value = load(evaluate(*expression.b), *expression.b);
  const Value place = evaluate(*expression.a);
  if (place.kind != Value::Kind::kPlace) refuse_at(expression.place, "an assignment to what is no variable");
  if (place.is_const) refuse_at(expression.place, "an assignment to a constant");
  const Expression& of = *expression.b;
  const bool moves_time = unit_.is_c ? of.moves_time : of.kind == ExpressionKind::kBinary;
  if (types_.is_sum(place.type) && moves_time) domain_.count_additions(kMovesTime - 1);
  store(place, value, expression);
  return place;
}

Value Interpreter::step(const Expression& expression, long by) {
  const Value place = evaluate(*expression.a);
  if (place.kind != Value::Kind::kPlace || place.is_const || place.type->kind != Type::Kind::kInteger)
    refuse_at(expression.place, "a step of what is no integer variable");
  const Value value = load(place, expression);
  memory_[place.address] = integer_cell(value.integer + by);
  return place;
}

long Interpreter::integer(const Expression& expression) {
  const Value value = evaluate_loaded(expression);
  if (value.kind != Value::Kind::kInteger) refuse_at(expression.place, "an integer is needed here");
  return value.integer;
}

/// A number from an integer, from a constant of type double or from a number; lanes from a list of numbers.
Value Interpreter::cast(const Expression& expression) {
  const Type* type = types_.resolve(*expression.type, lookup());
  if (type->kind == Type::Kind::kLanes) return lanes_of(type, expression);
  if (type->kind != Type::Kind::kNumber || expression.arguments.size() != 1)
    refuse_at(expression.place, "a conversion to another type than that of numbers");
  const Value value = evaluate_loaded(*expression.arguments[0]);
  if (value.kind == Value::Kind::kNumber) return value;
  if (value.kind == Value::Kind::kInteger)
    return of_number(domain_.literal(static_cast<double>(value.integer)));
  if (value.kind == Value::Kind::kNative) return of_number(domain_.literal(value.native));
  refuse_at(expression.place, "a conversion of what is no number");
}

Value Interpreter::subscript(const Expression& expression) {
  Value array = evaluate(*expression.a);
  const long index = integer(*expression.b);
  if (array.kind == Value::Kind::kPlace &&
      (array.type->kind == Type::Kind::kArray || array.type->kind == Type::Kind::kLanes)) {
    if (index < 0 || index >= array.type->extent)
      refuse_at(expression.place, fmt::format("entry {} of {}", index, types_.text(array.type)));
    array.type = array.type->element;
    array.address += static_cast<std::size_t>(index) * array.type->cells;
    return array;
  }
  if (array.kind != Value::Kind::kPointer) refuse_at(expression.place, "an entry of what is no array");
  array.address += static_cast<std::size_t>(index) * array.type->cells;
  if (index < 0 || array.address + array.type->cells > array.end)
    refuse_at(expression.place, fmt::format("entry {} beyond an array's end", index));
  array.kind = Value::Kind::kPlace;
  return array;
}

/// Of a place: a pointer that stays there.
Value Interpreter::address(const Expression& expression) {
  Value pointer = evaluate(*expression.a);
  if (pointer.kind != Value::Kind::kPlace) refuse_at(expression.place, "the address of what is no variable");
  pointer.kind = Value::Kind::kPointer;
  pointer.begin = pointer.address;
  pointer.end = pointer.address + pointer.type->cells;
  return pointer;
}

Value Interpreter::dereference(const Expression& expression) {
  Value place = evaluate(*expression.a);
  if (place.kind != Value::Kind::kPointer || place.address + place.type->cells > place.end)
    refuse_at(expression.place, "what no pointer points to");
  place.kind = Value::Kind::kPlace;
  return place;
}

Value Interpreter::member(const Expression& expression) {
  Value object = evaluate(*expression.a);
  const bool is_sum = object.kind == Value::Kind::kNumber ||
                      (object.kind == Value::Kind::kPlace && types_.is_sum(object.type));
  if (unit_.is_c && is_sum && unit_.symbols.text(expression.name) == "high") return load(object, expression);
  const Field* field = object.kind == Value::Kind::kPlace && object.type->kind == Type::Kind::kStruct
                           ? object.type->structure->find(expression.name)
                           : nullptr;
  if (!field) refuse_at(expression.place, fmt::format("no member '{}'", unit_.symbols.text(expression.name)));
  object.type = field->type;
  object.address += field->offset;
  return object;
}

}  // namespace jourdain::readback
