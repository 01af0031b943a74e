// What an emitted model computes, between programs and the languages that print it: functions of statements over
// reals, arrays and structs. The tree says what is computed, in which order and where it goes; a language says how
// that is spelt.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ir/program.hpp"

namespace jourdain::emit {

struct Expression {
  enum class Kind {
    kReal,           ///< `number`
    kInteger,        ///< `number`
    kPositionCount,  ///< entries of y
    kVelocityCount,  ///< entries of z
    kName,           ///< a variable or parameter
    kMember,         ///< member `name` of the struct operands[0]
    kEntry,          ///< entry operands[1] of the array operands[0]
    kFrom,           ///< the array operands[0] from its entry operands[1] on
    kOperation,      ///< `operation` of the operands, reals, integers or lanes
    kLanes,          ///< numbers that are computed with at once: the operands, reals
    kToReal,         ///< an angle, a time or an integer as a real
    kToAngle,        ///< a time as an angle
    kInvoke,         ///< member `name` of the object operands[0], called with the other operands, reals
    kInputsAt        ///< what the inputs are at the state operands[0]: held over the step, or sampled there
  };
  Kind kind = Kind::kInteger;
  double number = 0;
  std::string name;
  ir::Op operation = ir::Op::kLiteral;
  std::vector<Expression> operands;

  // Out of line, as those of Statement: the sources that make trees would take three times as long to compile.
  Expression();
  Expression(double real);
  Expression(int integer);
  Expression(std::size_t integer);
  Expression(Kind kind, std::string name, std::vector<Expression> operands = {});
  Expression(const Expression& other);
  Expression(Expression&& other) noexcept;
  Expression& operator=(const Expression& other);
  Expression& operator=(Expression&& other) noexcept;
  ~Expression();

  Expression operator[](const Expression& index) const;
  Expression from(const Expression& index) const;
  Expression dot(const std::string& member) const;
};

Expression name(const std::string& variable);
Expression operation(ir::Op op, std::vector<Expression> operands);
Expression operator+(const Expression& a, const Expression& b);
Expression operator-(const Expression& a, const Expression& b);
Expression operator*(const Expression& a, const Expression& b);
Expression operator/(const Expression& a, const Expression& b);
Expression operator-(const Expression& a);
Expression square_root(const Expression& a);
Expression lanes(std::vector<Expression> numbers);
Expression to_real(const Expression& a);
Expression to_angle(const Expression& time);
Expression invoke(const Expression& object, const std::string& function, std::vector<Expression> arguments);
Expression inputs_at(const Expression& state);
Expression position_count();
Expression velocity_count();

/// Whether the variable or parameter `variable` is read or written.
bool mentions(const Expression& expression, const std::string& variable);

struct Type {
  enum class Kind { kReal, kAngle, kInteger, kStruct, kLanes };
  Kind kind = Kind::kReal;
  std::string name = {};    ///< of a struct
  bool is_support = false;  ///< a struct that only emitted functions use
  int depth = 0;            ///< steps that a struct of that kind remembers; number of lanes
};

struct Variable {
  std::string name;
  std::vector<Expression> extents = {};
  std::optional<Expression> value = {};
  std::vector<Expression> entries = {};  ///< of an array that is constant
};

struct Statement;

/// Variables of one type, each with its extents and value.
struct Declare {
  enum class Change {
    kNever,
    kConstant,
    kFree
  };  ///< known to the compiler; constant from here on; a variable
  Type type;
  Change change = Change::kFree;
  std::vector<Variable> variables;
  std::string comment = {};
};

struct Set {
  std::vector<Expression> targets;  ///< all become `value`
  Expression value;
};

/// Both of one angle, which may be an angle or a real.
struct SineCosine {
  Expression angle;
  std::string sine, cosine;
};

/// `variable` runs over first, first + 1, …, end − 1, or the other way.
struct Loop {
  std::string variable;
  Expression first, end;
  bool descends = false;
  std::vector<Statement> body;
};

/// A condition that holds in the first steps of a trajectory only: left < right, or left = right.
struct AtStart {
  Expression left, right;
  bool is_less = false;
  std::vector<Statement> then, otherwise;
};

/// Of a function of the model, or of one that only emitted functions use.
struct Call {
  std::string function;
  std::vector<Expression> arguments;
  bool is_support = false;
};

struct Return {
  Expression value;
};

/// `variable` is the array `window` of `extent` numbers, addressed anew.
struct Nearby {
  Type type;  ///< of an entry
  std::size_t extent = 0;
  std::string variable, window;
};

struct Statement {
  std::variant<Declare, Set, SineCosine, Loop, AtStart, Call, Return, Nearby> is;

  Statement(Declare declare);
  Statement(Set set);
  Statement(SineCosine pair);
  Statement(Loop loop);
  Statement(AtStart start);
  Statement(Call call);
  Statement(Return result);
  Statement(Nearby nearby);
  Statement(const Statement& other);
  Statement(Statement&& other) noexcept;
  Statement& operator=(const Statement& other);
  Statement& operator=(Statement&& other) noexcept;
  ~Statement();
};

using Statements = std::vector<Statement>;

Statement set(const Expression& target, const Expression& value);
Statement constant(const std::string& variable, const Expression& value);
Statement loop(const std::string& variable, const Expression& end, Statements body);

bool mentions(const Statements& statements, const std::string& variable);

struct Parameter {
  enum class Access {
    kRead,   ///< by reference
    kValue,  ///< a copy
    kWrite   ///< by reference, read and written
  };
  Type type;
  std::string name;
  Access access = Access::kRead;
  std::vector<std::size_t> extents = {};  ///< of an array; without entries here
  bool is_slice = false;                  ///< a part of an array, as long as the function wants it
  bool is_inputs = false;                 ///< the inputs: held, or sampled at states
};

struct Function {
  std::string name;
  std::string comment;  ///< empty where the table of functions has it
  std::vector<Parameter> parameters;
  std::optional<Type> result = {};  ///< nothing, a real or a struct
  Statements body = {};
  bool only_sampled = false;  ///< does nothing where inputs are held over a step
  bool is_inlined = false;    ///< compiled into whatever calls it
  bool has_stages = false;    ///< a step that holds inlined functions
};

/// Members declared together, e.g. five arrays of one length.
struct Members {
  std::vector<Variable> variables;
  Type type = {};
  std::string comment = {};
};

struct Struct {
  std::string name, comment;
  std::vector<Members> members;
  bool has_depth = false;  ///< a template of `depth`, which functions name, whether members have it or not
};

/// The names of all tables.
inline constexpr const char *kCoupled = "coupled", *kFirstCoupled = "first_coupled";
inline constexpr std::array<const char*, 2> kTables{kCoupled, kFirstCoupled};

/// Integers that are known when the model is emitted. C++ has functions of them, which device code may call.
struct Table {
  std::string name, comment;
  std::vector<std::size_t> entries;
};

}  // namespace jourdain::emit
