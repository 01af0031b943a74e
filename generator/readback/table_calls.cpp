// Calls of functions that take entries of an array of constants.
#include "readback/interpreter.hpp"

namespace jourdain::readback {

/// Of a function of namespace detail, which no variable hides.
const std::vector<double>* Interpreter::table_of(const Expression& callee) {
  const auto table = unit_.tables.find(unit_.symbols.text(callee.name));
  if (table == unit_.tables.end() || callee.global) return nullptr;
  if (!callee.type)
    return frame().scope == "detail" && meaning_[callee.name] <= frame().base ? &table->second : nullptr;
  const bool is_internal =
      callee.type->path.size() == 1 && unit_.symbols.text(callee.type->path[0]) == "detail";
  return is_internal && callee.type->arguments.empty() ? &table->second : nullptr;
}

Value Interpreter::entry(const std::vector<double>& table, const std::vector<Value>& arguments,
                         const Expression& expression) {
  Value value = arguments.size() == 1 ? load(arguments[0], expression) : Value();
  if (value.kind != Value::Kind::kNumber)
    refuse_at(expression.place, "an entry whose place is not one number");
  value.number = domain_.operate(ir::Op::kEntry, value.number, domain_.array(table));
  return value;
}

}  // namespace jourdain::readback
