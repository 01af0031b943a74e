#include "readback/interpreter.hpp"

#include <fmt/format.h>

#include <utility>

#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

constexpr long kBudget = 20000000;  ///< operations of a run: a loop without an end ends

}  // namespace

Interpreter::Interpreter(const Unit& unit, Domain& domain, NumberType number)
    : unit_(unit),
      domain_(domain),
      number_type_(number),
      types_(unit, number, [this](const Expression& e, const Lookup& l) { return integer_in(e, l); }),
      meaning_(unit.symbols.size(), 0) {
  std::map<std::pair<std::string, Symbol>, std::map<std::string, std::size_t>> seen;
  for (const Function* function : unit.functions) {
    if (function->is_constructor) continue;
    const std::pair<std::string, Symbol> key = {function->scope, function->name};
    std::vector<const Function*>& list = functions_[key];
    const std::string signature =
        fmt::format("{} of {}", signature_of(unit, *function), function->parameters_of_template.size());
    const auto [it, is_new] = seen[key].try_emplace(signature, list.size());
    if (is_new)
      list.push_back(function);
    else if (!function->body || list[it->second]->body)
      refuse_at(function->place, fmt::format("{} once more", signature));
    else
      list[it->second] = function;
  }
  for (const Constant* constant : unit.constants)
    if (!constants_.emplace(constant->declarator.name, constant).second)
      refuse_at(constant->declarator.place,
                fmt::format("'{}' once more", unit.symbols.text(constant->declarator.name)));
  frames_.emplace_back();
  read_constants();
}

/// Integers and arrays of integers; an array may leave its length to its values.
void Interpreter::read_constants() {
  for (const Constant* constant : unit_.constants) {
    const Declarator& declarator = constant->declarator;
    if (constant->type.path.size() != 1 || unit_.symbols.text(constant->type.path[0]) != "int") continue;
    if (!declarator.initial || declarator.indirection != 0 || declarator.bounds.size() > 1)
      refuse_at(declarator.place, "a constant that is neither an integer nor a row of integers");
    const Type* type = types_.integer();
    if (declarator.bounds.size() == 1)
      type =
          types_.array(type, declarator.bounds[0] ? integer(*declarator.bounds[0])
                                                  : static_cast<long>(declarator.initial->arguments.size()));
    const Value place = place_of(type);
    initialise_from(place, *declarator.initial);
    constant_values_[constant] = as_const(place);
  }
}

void Interpreter::refuse_at(const Place& place, const std::string& message) const {
  refuse(unit_.files[static_cast<std::size_t>(place.file)], place.line, message);
}

void Interpreter::spend(const Place& place) {
  if (++budget_ > kBudget) refuse_at(place, "this does not end");
}

Lookup Interpreter::lookup() const {
  const Frame& inner = frames_.back();
  return {&inner.bindings, inner.inside, &inner.scope};
}

long Interpreter::integer_in(const Expression& expression, const Lookup& where) {
  if (expression.kind == ExpressionKind::kInteger) return expression.integer;
  if (expression.kind == ExpressionKind::kName && !expression.type && where.bindings)
    for (const Binding& binding : *where.bindings)
      if (binding.name == expression.name && !binding.type) return binding.integer;
  return integer(expression);
}

Value Interpreter::place_of(const Type* type) {
  Value place;
  place.kind = Value::Kind::kPlace;
  place.type = type;
  place.address = memory_.size();
  memory_.resize(memory_.size() + type->cells);
  return place;
}

Value Interpreter::make(const Type* type) {
  const Value place = place_of(type);
  initialise(place, type, false);
  return place;
}

Value Interpreter::make_function(FunctionObject function, const Type* result) {
  const Value place = place_of(types_.function());
  objects_[place.address] = {std::move(function), result};
  return place;
}

Value Interpreter::field(const Value& object, const std::string& name) {
  if (object.type->kind == Type::Kind::kStruct)
    for (const Field& field : object.type->structure->fields)
      if (unit_.symbols.text(field.name) == name) {
        Value place = object;
        place.type = field.type;
        place.address += field.offset;
        return place;
      }
  throw Refusal(fmt::format("{} has no member '{}'", types_.text(object.type), name));
}

Value Interpreter::entry(const Value& array, std::size_t index) {
  const bool has_entries = array.type->kind == Type::Kind::kArray || array.type->kind == Type::Kind::kLanes;
  if (!has_entries || static_cast<long>(index) >= array.type->extent)
    throw Refusal(fmt::format("{} has no entry {}", types_.text(array.type), index));
  Value place = array;
  place.type = array.type->element;
  place.address += index * place.type->cells;
  return place;
}

Value Interpreter::as_const(Value place) {
  place.is_const = true;
  return place;
}

void Interpreter::set(const Value& place, Number number) { cell(place) = number_cell(number); }

Number Interpreter::number(const Value& place) {
  if (place.kind == Value::Kind::kNumber) return place.number;
  if (place.kind != Value::Kind::kPlace || cell(place).kind != Cell::Kind::kNumber)
    throw Refusal("there is no number");
  return cell(place).number;
}

/// C takes structs, and numbers that it writes, by pointers.
std::vector<Value> Interpreter::as_pointers(const Function& function, const std::vector<Value>& arguments) {
  std::vector<Value> passed = arguments;
  for (std::size_t i = 0; i < std::min(passed.size(), function.parameters.size()); ++i) {
    if (function.parameters[i].declarator.indirection != '*' || passed[i].kind != Value::Kind::kPlace)
      continue;
    passed[i].kind = Value::Kind::kPointer;
    passed[i].begin = passed[i].address;
    passed[i].end = passed[i].address + passed[i].type->cells;
  }
  return passed;
}

// Variables and initial values

void Interpreter::add_variable(Symbol name, const Value& value, const Place& place) {
  if (name == 0) return;
  std::size_t& meaning = meaning_[name];
  if (meaning > frame().first_variable)
    refuse_at(place, fmt::format("'{}' is declared once more", unit_.symbols.text(name)));
  variables_.push_back({name, value, meaning});
  meaning = variables_.size();
}

void Interpreter::close_scope(std::size_t first_variable) {
  for (; variables_.size() > first_variable; variables_.pop_back())
    meaning_[variables_.back().name] = variables_.back().hidden;
}

void Interpreter::initialise(const Value& place, const Type* type, bool with_zeros) {
  switch (type->kind) {
    case Type::Kind::kNumber:
      if (with_zeros) set(place, domain_.literal(0.0));
      return;
    case Type::Kind::kInteger:
    case Type::Kind::kBool:
      if (with_zeros) cell(place) = integer_cell(0);
      return;
    case Type::Kind::kArray:
    case Type::Kind::kLanes:
      for (long i = 0; i < type->extent; ++i)
        initialise(entry(place, static_cast<std::size_t>(i)), type->element, with_zeros);
      return;
    case Type::Kind::kStruct: {
      for (const Field& field : type->structure->fields) {
        Value part = place;
        part.type = field.type;
        part.address += field.offset;
        if (!field.initial) {
          initialise(part, field.type, with_zeros);
          continue;
        }
        Frame& inner = frames_.emplace_back();
        inner.bindings = type->structure->bindings;
        inner.inside = type->structure;
        inner.scope = type->structure->syntax->scope;
        inner.base = inner.first_variable = variables_.size();
        initialise_from(part, *field.initial);
        frames_.pop_back();
      }
      return;
    }
    case Type::Kind::kVoid:
    case Type::Kind::kNative:
    case Type::Kind::kFunction:
      throw Refusal(fmt::format("a variable of type {}", types_.text(type)));
  }
}

void Interpreter::initialise_from(const Value& place, const Expression& initial) {
  if (initial.kind != ExpressionKind::kList) return store(place, evaluate(initial), initial);
  const std::vector<const Expression*>& list = initial.arguments;
  if (place.type->kind == Type::Kind::kLanes) return initialise_lanes(place, initial);
  if (list.empty()) return initialise(place, place.type, true);
  if (place.type->kind != Type::Kind::kArray || static_cast<long>(list.size()) > place.type->extent)
    refuse_at(initial.place, fmt::format("{} values for {}", list.size(), types_.text(place.type)));
  for (std::size_t i = 0; i < list.size(); ++i) initialise_from(entry(place, i), *list[i]);
  for (auto i = list.size(); static_cast<long>(i) < place.type->extent; ++i)
    initialise(entry(place, i), place.type->element, true);
}

void Interpreter::bind_reference(const Statement& statement, const Declarator& declarator) {
  if (!declarator.initial) refuse_at(declarator.place, "a reference to nothing");
  Value place = evaluate(*declarator.initial);
  const Type* type = types_.resolve(statement.type, declarator, lookup());
  if (place.kind != Value::Kind::kPlace || place.type != type || (place.is_const && !statement.type.is_const))
    refuse_at(declarator.place, "a reference to something of another type");
  place.is_const = statement.type.is_const;
  add_variable(declarator.name, place, declarator.place);
}

void Interpreter::declare(const Statement& statement, const Declarator& declarator) {
  if (declarator.indirection == '*') refuse_at(declarator.place, "a pointer as a variable");
  if (declarator.indirection == '&') return bind_reference(statement, declarator);
  Value place = place_of(types_.resolve(statement.type, declarator, lookup()));
  if (declarator.initial)
    initialise_from(place, *declarator.initial);
  else if (statement.type.is_const)
    refuse_at(declarator.place, "a constant without a value");
  else
    initialise(place, place.type, false);
  place.is_const = statement.type.is_const;
  add_variable(declarator.name, place, declarator.place);
}

// Statements

bool Interpreter::execute(const Statement& statement) {
  spend(statement.place);
  switch (statement.kind) {
    case StatementKind::kBlock:
      return execute_block(statement);
    case StatementKind::kDeclaration:
      for (const Declarator& declarator : statement.declarators) declare(statement, declarator);
      return true;
    case StatementKind::kExpression:
      evaluate(*statement.a);
      return true;
    case StatementKind::kIf:
      if (condition(*statement.a)) return execute_block(*statement.body[0]);
      return statement.body.size() < 2 || execute_block(*statement.body[1]);
    case StatementKind::kFor:
      return execute_for(statement);
    case StatementKind::kRangeFor:
      return execute_range_for(statement);
    case StatementKind::kReturn:
      return_value(statement);
      return false;
  }
  return true;
}

/// A block, or one statement as a block, with a scope of its own.
bool Interpreter::execute_block(const Statement& statement) {
  const std::size_t outside = std::exchange(frame().first_variable, variables_.size()),
                    first = variables_.size(), cells = memory_.size();
  bool goes_on = true;
  if (statement.kind != StatementKind::kBlock)
    goes_on = execute(statement);
  else
    for (const Statement* inner : statement.body)
      if (goes_on = execute(*inner); !goes_on) break;
  close_scope(first);
  memory_.resize(cells);
  frame().first_variable = outside;
  return goes_on;
}

bool Interpreter::condition(const Expression& expression) {
  const Value value = evaluate_loaded(expression);
  if (value.kind != Value::Kind::kBool)
    refuse_at(expression.place, "a condition that is neither true nor false");
  return value.integer != 0;
}

bool Interpreter::execute_for(const Statement& statement) {
  const std::size_t outside = std::exchange(frame().first_variable, variables_.size()),
                    first = variables_.size(), cells = memory_.size();
  bool goes_on = execute(*statement.first);
  while (goes_on && condition(*statement.a)) {
    goes_on = execute_block(*statement.body[0]);
    if (goes_on) evaluate(*statement.step);
  }
  close_scope(first);
  memory_.resize(cells);
  frame().first_variable = outside;
  return goes_on;
}

bool Interpreter::execute_range_for(const Statement& statement) {
  const Value range = evaluate(*statement.a);
  const Declarator& declarator = statement.declarators[0];
  if (range.kind != Value::Kind::kPlace || range.type->kind != Type::Kind::kArray ||
      declarator.indirection != '&')
    refuse_at(statement.place, "a range that is no array, or copies of its entries");
  bool goes_on = true;
  for (long i = 0; goes_on && i < range.type->extent; ++i) {
    const std::size_t first = variables_.size();
    const std::size_t outside = std::exchange(frame().first_variable, first);
    Value place = entry(range, static_cast<std::size_t>(i));
    if (place.type != types_.resolve(statement.type, lookup()) ||
        (place.is_const && !statement.type.is_const))
      refuse_at(statement.place, "a reference to something of another type");
    place.is_const = statement.type.is_const;
    add_variable(declarator.name, place, statement.place);
    goes_on = execute_block(*statement.body[0]);
    close_scope(first);
    frame().first_variable = outside;
  }
  return goes_on;
}

}  // namespace jourdain::readback
