#include "emit/operations.hpp"

#include <algorithm>
#include <map>

#include "support/check.hpp"

namespace jourdain::emit {

namespace {

using Kind = Expression::Kind;

/// A literal, or made of literals only.
bool is_constant(const Expression& expression) {
  if (expression.kind == Kind::kReal) return true;
  return expression.kind == Kind::kOperation &&
         std::all_of(expression.operands.begin(), expression.operands.end(), is_constant);
}

long operations(const Expression& expression) {
  if (expression.kind != Kind::kOperation || is_constant(expression)) return 0;
  long count = expression.operation == ir::Op::kNegate ? 0 : 1;
  for (const Expression& operand : expression.operands) count += operations(operand);
  return count;
}

class Counter {
 public:
  Counter(const programs::SceneFacts& scene, const Support& support, const ir::Module& module)
      : scene_(scene), support_(support), module_(module) {}

  long count(const Statements& statements) {
    long total = 0;
    for (const Statement& statement : statements) total += std::visit(*this, statement.is);
    return total;
  }

  long operator()(const Declare& declare) {
    long total = 0;
    for (const Variable& variable : declare.variables) {
      if (!variable.value) continue;
      if (declare.type.kind == Type::Kind::kInteger)
        integers_[variable.name] = integer(*variable.value);
      else
        total += operations(*variable.value);
    }
    return total;
  }
  long operator()(const Set& set) {
    const Expression& target = set.targets.front();
    const bool moves_clock =
        target.kind == Kind::kMember && target.name == "t" && set.value.kind != Kind::kMember;
    return operations(set.value) + (moves_clock ? kClockOperations - 1 : 0);
  }
  long operator()(const SineCosine&) { return 0; }
  long operator()(const Loop& loop) {
    long total = 0;
    const long first = integer(loop.first), end = integer(loop.end);
    for (long i = first; i < end; ++i) {
      integers_[loop.variable] = i;
      total += count(loop.body);
    }
    return total;
  }
  long operator()(const AtStart& start) { return count(start.otherwise); }
  long operator()(const Call& call) {
    long total = 0;
    for (const Expression& argument : call.arguments) total += operations(argument);
    return total + (call.is_support ? of_support(call.function) : of_model(call.function));
  }
  long operator()(const Return&) { return 0; }
  long operator()(const Nearby&) { return 0; }

 private:
  long of_model(const std::string& function) const {
    const ir::Program* program = find_program(module_, function);
    JD_CHECK(program, "no program '{}'", function);
    return static_cast<long>(ir::count_operations(*program).arithmetic());
  }

  long of_support(const std::string& function) const {
    const auto found = std::find_if(support_.functions.begin(), support_.functions.end(),
                                    [&](const Function& f) { return f.name == function; });
    JD_CHECK(found != support_.functions.end(), "no function '{}'", function);
    return found->only_sampled ? 0 : Counter(scene_, support_, module_).count(found->body);
  }

  long integer(const Expression& e) const {
    switch (e.kind) {
      case Kind::kInteger:
        return static_cast<long>(e.number);
      case Kind::kPositionCount:
        return static_cast<long>(scene_.positions.size());
      case Kind::kVelocityCount:
        return static_cast<long>(scene_.velocities.size());
      case Kind::kName:
        return integers_.at(e.name);
      case Kind::kOperation:
        return e.operation == ir::Op::kAdd ? integer(e.operands[0]) + integer(e.operands[1])
                                           : integer(e.operands[0]) - integer(e.operands[1]);
      case Kind::kEntry:
        for (const Table& table : support_.tables)
          if (table.name == e.operands[0].name)
            return static_cast<long>(table.entries.at(static_cast<std::size_t>(integer(e.operands[1]))));
        break;
      case Kind::kReal:
      case Kind::kMember:
      case Kind::kFrom:
      case Kind::kLanes:
      case Kind::kToReal:
      case Kind::kToAngle:
      case Kind::kInvoke:
      case Kind::kInputsAt:
        break;
    }
    JD_CHECK(false, "'{}' is no integer that is known", e.name);
    return 0;
  }

  const programs::SceneFacts& scene_;
  const Support& support_;
  const ir::Module& module_;
  std::map<std::string, long> integers_;
};

}  // namespace

std::vector<StepRecord> step_records(const programs::SceneFacts& scene,
                                     const std::vector<programs::FunctionInfo>& functions,
                                     const ir::Module& module) {
  const Support support = step_support(scene, functions, module);
  std::vector<StepRecord> records;
  for (const programs::FunctionInfo& function : functions)
    if (function.stepper)
      records.push_back(
          {function.stepper, Counter(scene, support, module).count(step_function(scene, function).body)});
  return records;
}

}  // namespace jourdain::emit
