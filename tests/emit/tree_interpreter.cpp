#include "emit/tree_interpreter.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "support/check.hpp"

namespace jourdain::tests {

using emit::Expression;
using Kind = Expression::Kind;

namespace {

/// A value, or the array from one of its entries on.
struct Place {
  Value* value = nullptr;
  long first = 0;
};

}  // namespace

/// One call of a function.
class TreeInterpreter::Frame {
 public:
  Frame(TreeInterpreter& all, const emit::Function& function, const std::vector<Place>& arguments)
      : all_(all) {
    JD_CHECK(arguments.size() == function.parameters.size(), "{} wants other arguments", function.name);
    for (std::size_t k = 0; k < arguments.size(); ++k) places_[function.parameters[k].name] = arguments[k];
    for (const emit::Table& table : all.code_.support.tables)
      for (std::size_t k = 0; k < table.entries.size(); ++k)
        local(table.name).entries[long(k)].number = double(table.entries[k]);
  }

  void bind(const std::string& name, Value* value) { places_[name] = {value}; }

  Value run(const emit::Statements& statements) {
    execute(statements);
    return result_;
  }

  void operator()(const emit::Declare& declare) {
    for (const emit::Variable& variable : declare.variables) {
      Value& value = fresh(variable.name);
      if (variable.value) value = evaluate(*variable.value);
      for (std::size_t k = 0; k < variable.entries.size(); ++k)
        value.entries[long(k)] = evaluate(variable.entries[k]);
    }
  }
  void operator()(const emit::Set& set) {
    const Value value = evaluate(set.value);
    for (const Expression& target : set.targets) *place(target).value = value;
  }
  void operator()(const emit::SineCosine& pair) {
    const double angle = evaluate(pair.angle).number;
    local(pair.sine).number = std::sin(angle);
    local(pair.cosine).number = std::cos(angle);
  }
  void operator()(const emit::Loop& loop) {
    const long first = integer(loop.first), end = integer(loop.end);
    for (long k = 0; k < end - first; ++k) {
      fresh(loop.variable).number = double(loop.descends ? end - 1 - k : first + k);
      execute(loop.body);
    }
  }
  void operator()(const emit::AtStart& start) {
    const double left = evaluate(start.left).number, right = evaluate(start.right).number;
    execute((start.is_less ? left < right : left == right) ? start.then : start.otherwise);
  }
  void operator()(const emit::Call& call) {
    const emit::Function& function = *all_.functions_.at(call.function);
    if (function.only_sampled) return;
    std::deque<Value> copies;
    std::vector<Place> arguments;
    for (std::size_t k = 0; k < call.arguments.size(); ++k) {
      const bool computed =
          call.arguments[k].kind == Kind::kOperation || call.arguments[k].kind == Kind::kReal;
      if (computed) copies.push_back(evaluate(call.arguments[k]));
      arguments.push_back(computed ? Place{&copies.back()} : place(call.arguments[k]));
    }
    Frame(all_, function, arguments).run(function.body);
  }
  void operator()(const emit::Return& result) { result_ = evaluate(result.value); }
  void operator()(const emit::Nearby& nearby) { places_[nearby.variable] = places_.at(nearby.window); }

 private:
  void execute(const emit::Statements& statements) {
    for (const emit::Statement& statement : statements) std::visit(*this, statement.is);
  }

  Value& fresh(const std::string& name) {
    locals_.emplace_back();
    places_[name] = {&locals_.back()};
    return locals_.back();
  }
  Value& local(const std::string& name) {
    return places_.count(name) ? *places_.at(name).value : fresh(name);
  }

  long integer(const Expression& e) { return long(evaluate(e).number); }

  Place place(const Expression& e) {
    switch (e.kind) {
      case Kind::kName:
        JD_CHECK(places_.count(e.name), "'{}' is not declared", e.name);
        return places_.at(e.name);
      case Kind::kMember:
        return {&place(e.operands[0]).value->members[e.name]};
      case Kind::kEntry: {
        const Place array = place(e.operands[0]);
        return {&array.value->entries[array.first + integer(e.operands[1])]};
      }
      case Kind::kFrom: {
        const Place array = place(e.operands[0]);
        return {array.value, array.first + integer(e.operands[1])};
      }
      case Kind::kInputsAt:
        return places_.at("input");
      case Kind::kReal:
      case Kind::kInteger:
      case Kind::kPositionCount:
      case Kind::kVelocityCount:
      case Kind::kOperation:
      case Kind::kLanes:
      case Kind::kToReal:
      case Kind::kToAngle:
      case Kind::kInvoke:
        break;
    }
    JD_CHECK(false, "an expression is no place");
    return {};
  }

  static Value of(double number) { return {number, {}, {}}; }

  Value evaluate(const Expression& e) {
    switch (e.kind) {
      case Kind::kReal:
      case Kind::kInteger:
        return of(e.number);
      case Kind::kPositionCount:
        return of(double(all_.scene_.positions.size()));
      case Kind::kVelocityCount:
        return of(double(all_.scene_.velocities.size()));
      case Kind::kToReal:
      case Kind::kToAngle:
        return evaluate(e.operands[0]);
      case Kind::kOperation:
        return operation(e);
      case Kind::kLanes: {
        Value all;
        for (std::size_t k = 0; k < e.operands.size(); ++k) all.entries[long(k)] = evaluate(e.operands[k]);
        return all;
      }
      case Kind::kInvoke:
        JD_CHECK(false, "functions of the user are not here");
      case Kind::kName:
      case Kind::kMember:
      case Kind::kEntry:
      case Kind::kFrom:
      case Kind::kInputsAt:
        break;
    }
    return *place(e).value;
  }

  /// Lane by lane where one of the operands has several; a number goes with all of them.
  Value operation(const Expression& e) {
    const Value a = evaluate(e.operands[0]), b = e.operands.size() > 1 ? evaluate(e.operands[1]) : Value();
    const std::size_t lanes = std::max(a.entries.size(), b.entries.size());
    if (lanes == 0) return of(operation(e, a.number, b.number));
    const auto lane = [](const Value& value, long k) {
      return value.entries.empty() ? value.number : value.entries.at(k).number;
    };
    Value all;
    for (long k = 0; k < long(lanes); ++k) all.entries[k] = of(operation(e, lane(a, k), lane(b, k)));
    return all;
  }

  static double operation(const Expression& e, double a, double b) {
    switch (e.operation) {
      case ir::Op::kNegate:
        return -a;
      case ir::Op::kAdd:
        return a + b;
      case ir::Op::kSubtract:
        return a - b;
      case ir::Op::kMultiply:
        return a * b;
      case ir::Op::kDivide:
        return a / b;
      case ir::Op::kSqrt:
        return std::sqrt(a);
      case ir::Op::kSin:
        return std::sin(a);
      case ir::Op::kCos:
        return std::cos(a);
      case ir::Op::kAtan2:
        return std::atan2(a, b);
      case ir::Op::kLiteral:
      case ir::Op::kLeaf:
        break;
      default:
        return support::value_of(ir::function_of(e.operation), a, b);
    }
    JD_CHECK(false, "no operation");
    return 0;
  }

  TreeInterpreter& all_;
  std::map<std::string, Place> places_;
  std::deque<Value> locals_;
  Value result_;
};

TreeInterpreter::TreeInterpreter(const emit::ModelCode& code, const programs::SceneFacts& scene)
    : code_(code), scene_(scene) {
  const auto add = [this](const emit::CutFunction& cut) {
    functions_[cut.function.name] = &cut.function;
    for (const emit::Function& part : cut.parts) functions_[part.name] = &part;
  };
  add(code.constructor);
  for (const emit::CutFunction& cut : code.functions) add(cut);
  for (const emit::Function& function : code.support.functions) functions_[function.name] = &function;
  for (const model::Parameter& parameter : scene.parameters)
    parameters_.members[parameter.name].number = parameter.value;
  Frame frame(*this, code.constructor.function, {{&parameters_}});
  for (const std::string& constant : code.constants) frame.bind(constant, &model_.members[constant]);
  frame.run(code.constructor.function.body);
}

Value TreeInterpreter::call(const std::string& function, const std::vector<Value*>& arguments) {
  std::vector<Place> places = {{&model_}};
  for (Value* argument : arguments) places.push_back({argument});
  const emit::Function& called = *functions_.at(function);
  return Frame(*this, called, places).run(called.body);
}

}  // namespace jourdain::tests
