// Executes functions of the text that was read, over any domain of numbers.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "readback/domain.hpp"
#include "readback/syntax.hpp"
#include "readback/types.hpp"
#include "readback/value.hpp"

namespace jourdain::readback {

/// What C++ says the text does: overloads, template arguments, references, scopes, the value that a variable
/// has or has not yet. Whatever a C++ compiler would reject, or would leave undefined, throws Refusal.
class Interpreter {
 public:
  /// Stands for a function of the text; it gets the arguments as places.
  using Standin = std::function<void(const std::vector<Value>&)>;
  /// A function object that is passed as an argument: gets the place of its argument and that of its result.
  using FunctionObject = std::function<void(const Value& argument, const Value& result)>;

  Interpreter(const Unit& unit, Domain& domain, NumberType number = NumberType::kOwn);

  TypeTable& types() { return types_; }
  Domain& domain() { return domain_; }

  /// An object without values in memory that lasts as long as the interpreter, with its members' initial
  /// values where it has some.
  Value make(const Type* type);
  /// A place of type "function": calls of it go to `function`, whose result has type `result`.
  Value make_function(FunctionObject function, const Type* result);

  Value field(const Value& object, const std::string& name);
  Value entry(const Value& array, std::size_t index);
  static Value as_const(Value place);
  Cell& cell(const Value& place, std::size_t offset = 0) { return memory_[place.address + offset]; }
  void set(const Value& place, Number number);
  Number number(const Value& place);  ///< throws Refusal where it has none

  /// Calls the function `name` of namespace `scope`. Returns its result; structs as places.
  Value call(const std::string& scope, const std::string& name, const std::vector<Value>& arguments);
  /// Calls a static member function of `type`.
  bool call_member(const Type* type, const std::string& name, const std::vector<Value>& arguments);
  /// Executes the constructor of `object` from `parameters`.
  void construct(const Value& object, const Value& parameters);
  /// From now on the function `name` of the outer namespace is not executed; `standin` is.
  void replace(const std::string& name, const Standin& standin);
  /// Value of a static constant of a struct.
  Value constant(const Type* type, const std::string& name);

 private:
  struct Variable {
    Symbol name = 0;
    Value value;
    std::size_t hidden = 0;  ///< what the name meant outside
  };
  struct Frame {
    const Function* function = nullptr;
    Bindings bindings;
    const StructType* inside = nullptr;
    Value self;  ///< object of a constructor
    std::string scope;
    std::size_t base = 0;            ///< variables before are those of callers
    std::size_t first_variable = 0;  ///< of the innermost scope
    std::size_t first_cell = 0;
    Value result;
    std::vector<Cell> cells;  ///< of a struct that is returned
  };
  struct Candidate {
    const Function* function = nullptr;
    Bindings bindings;
    int generic = 0;  ///< parameters that take any type
  };

  // statements
  bool execute(const Statement& statement);  ///< false: the function returned
  bool execute_block(const Statement& statement);
  bool execute_for(const Statement& statement);
  bool execute_range_for(const Statement& statement);
  void declare(const Statement& statement, const Declarator& declarator);
  void bind_reference(const Statement& statement, const Declarator& declarator);
  void return_value(const Statement& statement);
  void add_variable(Symbol name, const Value& value, const Place& place);
  void close_scope(std::size_t first_variable);
  void read_constants();
  void initialise(const Value& place, const Type* type, bool with_zeros);
  void initialise_from(const Value& place, const Expression& initial);
  bool condition(const Expression& expression);

  // expressions
  Value evaluate(const Expression& expression);
  Value load(const Value& value, const Expression& expression);
  Value evaluate_loaded(const Expression& expression) { return load(evaluate(expression), expression); }
  Value name(const Expression& expression);
  Value static_member(const Expression& expression);
  Value find_constant(Symbol name, const std::string& scope, const Expression& expression);
  Value binary(const Expression& expression);
  Value binary_native(const Expression& expression, const Value& a, const Value& b);
  Value compare(const Expression& expression, const Value& a, const Value& b);
  Value assign(const Expression& expression);
  void store(const Value& place, const Value& value, const Expression& expression);
  Value step(const Expression& expression, long by);
  Value negate(const Expression& expression);
  Value cast(const Expression& expression);
  Value subscript(const Expression& expression);
  Value member(const Expression& expression);
  Value address(const Expression& expression);
  Value dereference(const Expression& expression);
  long integer(const Expression& expression);
  Value pointer_to(const Value& array) const;

  // lanes
  static bool is_lanes(const Value& value) {
    return value.kind == Value::Kind::kPlace && value.type->kind == Type::Kind::kLanes;
  }
  void initialise_lanes(const Value& place, const Expression& list);
  Value lanes_of(const Type* type, const Expression& cast);
  Value lane_by_lane(ir::Op op, const Value& a, const Value& b, const Expression& expression);

  // calls
  Value call(const Expression& expression);
  Value call_c_library(const Expression& expression, const std::vector<Value>& arguments);
  Value call_of_user(const Expression& expression);
  const std::vector<double>* table_of(const Expression& callee);
  Value entry(const std::vector<double>& table, const std::vector<Value>& arguments,
              const Expression& expression);
  Value call_object(const Value& object, const std::vector<Value>& arguments, const Expression& expression);
  static std::vector<Value> as_pointers(const Function& function, const std::vector<Value>& arguments);
  Value invoke(const Candidate& candidate, const std::vector<Value>& arguments);
  void enter(const Function& function, const Bindings& bindings, const StructType* inside);
  Value leave(std::size_t outside_variables);
  const std::vector<const Function*>* overloads(Symbol name, const std::string& scope) const;
  Candidate choose(const std::vector<const Function*>& functions, const std::vector<Value>& arguments,
                   const Bindings& explicit_arguments, const std::string& name);
  bool matches(const Function& function, const std::vector<Value>& arguments, Candidate& candidate,
               std::size_t explicit_count);
  bool matches(const Parameter& parameter, const Value& argument, Candidate& candidate);
  bool unify(const TypeName& pattern, const Type* type, Candidate& candidate);
  const Type* type_of(const Value& value) const;
  Value bound(const Parameter& parameter, const Value& argument);

  Value place_of(const Type* type);
  Value place_with(const Value& scalar);
  Frame& frame() { return frames_.back(); }
  Lookup lookup() const;
  [[noreturn]] void refuse_at(const Place& place, const std::string& message) const;
  void spend(const Place& place);
  long integer_in(const Expression& expression, const Lookup& lookup);

  const Unit& unit_;
  Domain& domain_;
  NumberType number_type_;
  TypeTable types_;
  std::vector<Cell> memory_;
  std::vector<Variable> variables_;
  std::vector<std::size_t> meaning_;  ///< by symbol: 1 + index of its variable
  std::deque<Frame> frames_;          ///< references to them outlive calls
  std::map<std::pair<std::string, Symbol>, std::vector<const Function*>> functions_;
  std::map<const Function*, Standin> standins_;
  struct KnownObject {
    FunctionObject function;
    const Type* result = nullptr;
  };
  std::map<std::size_t, KnownObject> objects_;
  std::map<Symbol, const Constant*> constants_;
  std::map<const Constant*, Value> constant_values_;
  long budget_ = 0;
};

}  // namespace jourdain::readback
