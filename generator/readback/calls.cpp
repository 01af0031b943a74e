// Calls of the interpreter: overloads, template arguments, what stands for a function.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "readback/function_texts.hpp"
#include "readback/interpreter.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

constexpr std::size_t kDeepest = 64;  ///< calls within each other

}  // namespace

const Type* Interpreter::type_of(const Value& value) const {
  auto& types = const_cast<TypeTable&>(types_);
  switch (value.kind) {
    case Value::Kind::kNothing:
    case Value::Kind::kList:
      return types.nothing();
    case Value::Kind::kBool:
      return types.boolean();
    case Value::Kind::kInteger:
      return types.integer();
    case Value::Kind::kNative:
      return types.native();
    case Value::Kind::kNumber:
      return types.number();
    case Value::Kind::kPlace:
    case Value::Kind::kPointer:
      return types_.is_sum(value.type) ? types.number() : value.type;
  }
  return nullptr;
}

/// Functions of that name in the namespace, or else in the outer one.
const std::vector<const Function*>* Interpreter::overloads(Symbol name, const std::string& scope) const {
  auto it = functions_.find({scope, name});
  if (it == functions_.end()) it = functions_.find({"", name});
  return it == functions_.end() ? nullptr : &it->second;
}

bool Interpreter::unify(const TypeName& pattern, const Type* type, Candidate& candidate) {
  const Function& function = *candidate.function;
  if (pattern.path.size() == 1)
    for (const TemplateParameter& parameter : function.parameters_of_template)
      if (parameter.is_type && parameter.name == pattern.path[0]) {
        for (const Binding& binding : candidate.bindings)
          if (binding.name == parameter.name) return binding.type == type;
        candidate.bindings.push_back({parameter.name, type, 0});
        return true;
      }
  const Lookup where = {&candidate.bindings, nullptr, &function.scope};
  const Struct* syntax = types_.find_struct(pattern.path, where);
  if (!syntax) return types_.resolve(pattern, where) == type;
  if (type->kind != Type::Kind::kStruct || type->structure->syntax != syntax ||
      pattern.arguments.size() != type->structure->bindings.size())
    return false;
  for (std::size_t i = 0; i < pattern.arguments.size(); ++i) {
    const Binding& actual = type->structure->bindings[i];
    const TemplateArgument& argument = pattern.arguments[i];
    if ((argument.value != nullptr) == (actual.type != nullptr)) return false;
    if (argument.value ? integer_in(*argument.value, where) != actual.integer
                       : !unify(argument.type, actual.type, candidate))
      return false;
  }
  return true;
}

bool Interpreter::matches(const Parameter& parameter, const Value& argument, Candidate& candidate) {
  const Declarator& declarator = parameter.declarator;
  const Type* type = type_of(argument);
  const bool is_array = argument.kind == Value::Kind::kPlace && type->kind == Type::Kind::kArray;
  if (declarator.indirection == '*') {
    if (argument.kind != Value::Kind::kPointer && !is_array) return false;
    if (argument.is_const && !parameter.type.is_const) return false;
    return declarator.bounds.empty() && unify(parameter.type, is_array ? type->element : type, candidate);
  }
  if (argument.kind == Value::Kind::kPointer || (declarator.indirection == 0 && !declarator.bounds.empty()))
    return false;
  const bool is_place = argument.kind == Value::Kind::kPlace;
  if (declarator.indirection == '&' && !parameter.type.is_const && (!is_place || argument.is_const))
    return false;
  const Lookup where = {&candidate.bindings, nullptr, &candidate.function->scope};
  for (const Expression* bound : declarator.bounds) {
    if (type->kind != Type::Kind::kArray || !bound || integer_in(*bound, where) != type->extent) return false;
    type = type->element;
  }
  return unify(parameter.type, type, candidate);
}

bool Interpreter::matches(const Function& function, const std::vector<Value>& arguments, Candidate& candidate,
                          std::size_t explicit_count) {
  if (function.parameters.size() != arguments.size()) return false;
  if (function.parameters_of_template.size() < explicit_count) return false;
  for (std::size_t i = 0; i < explicit_count; ++i)
    candidate.bindings[i].name = function.parameters_of_template[i].name;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const TypeName& type = function.parameters[i].type;
    for (const TemplateParameter& parameter : function.parameters_of_template)
      candidate.generic += type.path.size() == 1 && type.path[0] == parameter.name;
    if (!matches(function.parameters[i], arguments[i], candidate)) return false;
  }
  return candidate.bindings.size() == function.parameters_of_template.size();
}

/// The one that fits: a function before a template, then the one that takes the fewest things of any type,
/// then that of fewer types.
Interpreter::Candidate Interpreter::choose(const std::vector<const Function*>& functions,
                                           const std::vector<Value>& arguments,
                                           const Bindings& explicit_arguments, const std::string& name) {
  std::vector<Candidate> fitting;
  for (const Function* function : functions) {
    Candidate candidate = {function, explicit_arguments, 0};
    if (matches(*function, arguments, candidate, explicit_arguments.size()))
      fitting.push_back(std::move(candidate));
  }
  const auto rank = [](const Candidate& c) {
    return std::tuple(c.function->is_template, c.generic, c.function->parameters_of_template.size());
  };
  const auto order = [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); };
  std::sort(fitting.begin(), fitting.end(), order);
  std::string types;
  for (const Value& argument : arguments)
    types += (types.empty() ? "" : ", ") + types_.text(type_of(argument));
  if (fitting.empty()) throw Refusal(fmt::format("no function fits the call {}({})", name, types));
  if (fitting.size() > 1 && !order(fitting[0], fitting[1]))
    throw Refusal(fmt::format("two functions fit the call {}({})", name, types));
  return fitting[0];
}

Value Interpreter::call(const Expression& expression) {
  if (expression.a->kind == ExpressionKind::kMember) return call_of_user(expression);
  if (expression.a->kind != ExpressionKind::kName)
    refuse_at(expression.place, "a call of what is no function");
  const Expression& callee = *expression.a;
  std::vector<Value> arguments;
  for (const Expression* argument : expression.arguments) {
    arguments.push_back(evaluate(*argument));
    if (const Value& value = arguments.back(); value.kind == Value::Kind::kNothing)
      refuse_at(argument->place, "an argument without a value");
  }
  if (const std::vector<double>* table = table_of(callee)) return entry(*table, arguments, expression);
  if (!callee.type && !callee.global && meaning_[callee.name] > frame().base)
    return call_object(variables_[meaning_[callee.name] - 1].value, arguments, expression);
  std::string scope = frame().scope;
  Bindings explicit_arguments;
  if (callee.type) {
    if (callee.type->path.size() > 1) refuse_at(callee.place, "a function of a namespace that is not known");
    if (!callee.type->path.empty()) {
      scope = unit_.symbols.text(callee.type->path[0]);
      if (functions_.find({scope, callee.name}) == functions_.end())
        refuse_at(callee.place,
                  fmt::format("no function '{}' in '{}'", unit_.symbols.text(callee.name), scope));
    }
    for (const TemplateArgument& argument : callee.type->arguments) {
      if (argument.value) refuse_at(callee.place, "a number as a template argument of a function");
      explicit_arguments.push_back({0, types_.resolve(argument.type, lookup()), 0});
    }
  }
  const std::vector<const Function*>* found = callee.global ? nullptr : overloads(callee.name, scope);
  if (!found) return call_c_library(expression, arguments);
  try {
    return invoke(choose(*found, arguments, explicit_arguments, unit_.symbols.text(callee.name)), arguments);
  } catch (const Refusal& refusal) {
    const std::string text = refusal.what();
    if (text.find(unit_.files.back()) != std::string::npos || text.find(".hpp:") != std::string::npos) throw;
    refuse_at(expression.place, text);
  }
}

Value Interpreter::call_c_library(const Expression& expression, const std::vector<Value>& arguments) {
  const std::string& name = unit_.symbols.text(expression.a->name);
  const bool is_global = expression.a->global;
  if (expression.a->type) refuse_at(expression.place, fmt::format("no function '{}'", name));
  // <math.h> for double and float; another number type brings functions of the plain names.
  const bool is_own = number_type_ == NumberType::kOwn;
  const std::string plain =
      number_type_ == NumberType::kFloat && name.ends_with("f") ? name.substr(0, name.size() - 1) : name;
  for (const LibraryName& function : library_names()) {
    if (plain != function.name || is_global == is_own) continue;
    if (number_type_ == NumberType::kFloat && plain == name) continue;
    std::vector<Number> numbers;
    for (const Value& argument : arguments) {
      const Value value = load(argument, expression);
      if (value.kind != Value::Kind::kNumber)
        refuse_at(expression.place, fmt::format("{} of what is no number", name));
      numbers.push_back(value.number);
    }
    if (static_cast<int>(numbers.size()) != ir::operand_count(function.op))
      refuse_at(expression.place, fmt::format("{} arguments for {}", numbers.size(), name));
    Value value;
    value.kind = Value::Kind::kNumber;
    value.number = domain_.operate(function.op, numbers[0], numbers.size() > 1 ? numbers[1] : 0);
    return value;
  }
  refuse_at(expression.place, fmt::format("no function '{}' for these numbers", name));
}

Value Interpreter::call_object(const Value& object, const std::vector<Value>& arguments,
                               const Expression& expression) {
  const auto it = objects_.find(object.address);
  if (object.kind != Value::Kind::kPlace || it == objects_.end() || arguments.size() != 1)
    refuse_at(expression.place, "a call of what is no function");
  const Value result = place_of(it->second.result);
  it->second.function(arguments[0], result);
  return result;
}

/// What a parameter is inside the function: the argument itself, a copy of it, or a pointer.
Value Interpreter::bound(const Parameter& parameter, const Value& argument) {
  Value value = argument;
  if (parameter.declarator.indirection == '*') {
    if (value.kind == Value::Kind::kPlace) value = pointer_to(value);
  } else if (parameter.declarator.indirection == '&' && argument.kind == Value::Kind::kPlace) {
    // the argument itself
  } else {
    value = place_with(argument);
  }
  value.is_const = parameter.type.is_const;
  return value;
}

Value Interpreter::place_with(const Value& given) {
  const Value place = place_of(type_of(given));
  if (given.kind == Value::Kind::kNumber)
    set(place, given.number);
  else if (given.kind == Value::Kind::kInteger || given.kind == Value::Kind::kBool)
    cell(place) = integer_cell(given.integer);
  else if (given.kind == Value::Kind::kPlace)
    for (std::size_t i = 0; i < given.type->cells; ++i) cell(place, i) = cell(given, i);
  else
    throw Refusal("an argument of type double");
  return place;
}

void Interpreter::enter(const Function& function, const Bindings& bindings, const StructType* inside) {
  if (frames_.size() > kDeepest) throw Refusal("calls that do not end");
  Frame& made = frames_.emplace_back();
  made.function = &function;
  made.bindings = bindings;
  made.inside = inside;
  made.scope = function.scope == "detail" ? function.scope : "";
  made.base = made.first_variable = variables_.size();
  made.first_cell = memory_.size();
}

Value Interpreter::leave(std::size_t outside_variables) {
  close_scope(outside_variables);
  Frame done = std::move(frames_.back());
  frames_.pop_back();
  memory_.resize(done.first_cell);
  if (done.cells.empty()) return done.result;
  Value place = place_of(done.result.type);
  std::copy(done.cells.begin(), done.cells.end(), memory_.begin() + static_cast<long>(place.address));
  return place;
}

Value Interpreter::invoke(const Candidate& candidate, const std::vector<Value>& arguments) {
  const Function& function = *candidate.function;
  const auto standin = standins_.find(&function);
  if (standin != standins_.end()) {
    std::vector<Value> places;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      Value& place = places.emplace_back(bound(function.parameters[i], arguments[i]));
      if (unit_.is_c && place.kind == Value::Kind::kPointer) place.kind = Value::Kind::kPlace;
    }
    standin->second(places);
    return {};
  }
  if (!function.body) throw Refusal(fmt::format("{} has no body", unit_.symbols.text(function.name)));
  enter(function, candidate.bindings, nullptr);
  const std::size_t outside = variables_.size();
  for (std::size_t i = 0; i < arguments.size(); ++i)
    add_variable(function.parameters[i].declarator.name, bound(function.parameters[i], arguments[i]),
                 function.place);
  bool goes_on = true;
  for (const Statement* statement : function.body->body)
    if (goes_on = execute(*statement); !goes_on) break;
  if (goes_on && unit_.symbols.text(function.result.path[0]) != "void")
    refuse_at(function.place, "a function ends without returning a value");
  return leave(outside);
}

void Interpreter::return_value(const Statement& statement) {
  Frame& inner = frame();
  const Function& function = *inner.function;
  if (function.is_constructor) refuse_at(statement.place, "a constructor returns");
  const Type* type = types_.resolve(function.result, lookup());
  if (!statement.a) {
    if (type->kind != Type::Kind::kVoid) refuse_at(statement.place, "a return without a value");
    return;
  }
  Value value = evaluate(*statement.a);
  if (function.result_indirection == '&') {
    if (value.kind != Value::Kind::kPlace || value.type != type || value.address >= inner.first_cell ||
        (value.is_const && !function.result.is_const))
      refuse_at(statement.place, "a reference to what does not outlive the call, or to another type");
    value.is_const = function.result.is_const;
    inner.result = value;
    return;
  }
  value = load(value, *statement.a);
  if (unit_.is_c && value.kind == Value::Kind::kBool) value.kind = Value::Kind::kInteger;
  if (value.kind == Value::Kind::kPointer || function.result_indirection != 0 || type_of(value) != type)
    refuse_at(statement.place, "a return of another type");
  if (value.kind == Value::Kind::kPlace)
    inner.cells.assign(memory_.begin() + static_cast<long>(value.address),
                       memory_.begin() + static_cast<long>(value.address + type->cells));
  inner.result = value;
}

// Calls from outside

Value Interpreter::call(const std::string& scope, const std::string& name,
                        const std::vector<Value>& arguments) {
  for (const auto& [key, list] : functions_)
    if (key.first == scope && unit_.symbols.text(key.second) == name) {
      const std::vector<Value> passed = unit_.is_c ? as_pointers(*list.front(), arguments) : arguments;
      return invoke(choose(list, passed, {}, name), passed);
    }
  throw Refusal(fmt::format("there is no function {}", name));
}

bool Interpreter::call_member(const Type* type, const std::string& name,
                              const std::vector<Value>& arguments) {
  for (const Function* function : type->structure->syntax->functions) {
    if (unit_.symbols.text(function->name) != name || !function->is_static || !function->body) continue;
    if (function->parameters.size() != arguments.size()) throw Refusal(fmt::format("arguments of {}", name));
    enter(*function, type->structure->bindings, type->structure);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      const Parameter& parameter = function->parameters[i];
      if (types_.resolve(parameter.type, parameter.declarator, lookup()) != arguments[i].type ||
          parameter.declarator.indirection != '&')
        refuse_at(function->place, fmt::format("arguments of {}", name));
      add_variable(parameter.declarator.name, bound(parameter, arguments[i]), function->place);
    }
    bool goes_on = true;
    for (const Statement* statement : function->body->body)
      if (goes_on = execute(*statement); !goes_on) break;
    const Value result = leave(frame().base);
    if (goes_on || result.kind != Value::Kind::kBool)
      refuse_at(function->place, fmt::format("{} does not return", name));
    return result.integer != 0;
  }
  throw Refusal(fmt::format("{} has no function {}", types_.text(type), name));
}

void Interpreter::construct(const Value& object, const Value& parameters) {
  if (unit_.is_c) {
    call("", "set_model", {object, parameters});
    return;
  }
  const StructType* structure = object.type->structure;
  const Function* found = nullptr;
  for (const Function* function : unit_.functions)
    if (function->is_constructor && function->name == structure->syntax->name && function->body) {
      if (found) refuse_at(function->place, "a constructor once more");
      found = function;
    }
  if (!found || found->parameters.size() != 1 || found->parameters[0].declarator.indirection != '&' ||
      !found->parameters[0].type.is_const)
    throw Refusal(fmt::format("{} has no constructor from its parameters", types_.text(object.type)));
  enter(*found, structure->bindings, structure);
  frame().self = object;
  if (types_.resolve(found->parameters[0].type, lookup()) != parameters.type)
    refuse_at(found->place, "a constructor from another type");
  frame().bindings[0].name = found->parameters_of_template.at(0).name;
  add_variable(found->parameters[0].declarator.name, bound(found->parameters[0], parameters), found->place);
  for (const Statement* statement : found->body->body) execute(*statement);
  leave(frame().base);
}

void Interpreter::replace(const std::string& name, const Standin& standin) {
  for (const auto& [key, list] : functions_)
    if (key.first.empty() && unit_.symbols.text(key.second) == name)
      for (const Function* function : list) standins_[function] = standin;
}

}  // namespace jourdain::readback
