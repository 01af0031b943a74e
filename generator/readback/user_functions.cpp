// Functions that the user of emitted code defines: what calls of them are.
#include "readback/expected.hpp"
#include "readback/interpreter.hpp"
#include "support/elementary_functions.hpp"

namespace jourdain::readback {

std::map<std::string, support::CalledFunction> Expected::user_functions() const {
  std::map<std::string, support::CalledFunction> list;
  for (const ir::Program& program : module->functions)
    for (const ir::Node& node : program.nodes) {
      if (node.op != ir::Op::kCall) continue;
      const support::CalledFunction& called = support::called_by(program[node.b].literal);
      list.emplace(called.member(), called);
    }
  return list;
}

/// `model.functions.grip(slip, load)`
Value Interpreter::call_of_user(const Expression& expression) {
  const Value object = evaluate(*expression.a->a);
  const bool is_place = object.kind == Value::Kind::kPlace && object.type->structure &&
                        unit_.symbols.text(object.type->structure->syntax->name) == "Functions";
  const auto known = unit_.called.find(unit_.symbols.text(expression.a->name));
  if (!is_place || known == unit_.called.end()) refuse_at(expression.place, "a call of what is no function");
  if (expression.arguments.size() != known->second.arguments.size())
    refuse_at(expression.place, "a function with other arguments than it has");
  Number list = domain_.literal(0);
  for (const Expression* argument : expression.arguments) {
    const Value value = load(evaluate(*argument), expression);
    if (value.kind != Value::Kind::kNumber) refuse_at(argument->place, "an argument that is no number");
    list = domain_.operate(ir::Op::kArgument, value.number, list);
  }
  Value value;
  value.kind = Value::Kind::kNumber;
  value.number =
      domain_.operate(ir::Op::kCall, list, domain_.literal(support::number_of_called(known->second)));
  return value;
}

}  // namespace jourdain::readback
