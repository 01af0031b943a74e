// What was read: expressions, statements, functions and structs, as C++'s grammar has them.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "support/called_function.hpp"

namespace jourdain::readback {

/// A name, by number; 0 is no name.
using Symbol = std::uint32_t;

/// Names and their numbers.
class SymbolTable {
 public:
  Symbol operator[](std::string_view name);
  const std::string& text(Symbol symbol) const { return texts_[symbol]; }
  std::size_t size() const { return texts_.size(); }

 private:
  std::deque<std::string> texts_ = {""};
  std::unordered_map<std::string_view, Symbol> known_;
};

struct Place {
  int file = 0, line = 0;
};

struct Expression;

struct TemplateArgument;

/// A type without what a declarator adds to it: `const Model<Real>`.
struct TypeName {
  bool is_const = false;
  std::vector<Symbol> path;  ///< `detail::Increment` has two entries
  std::vector<TemplateArgument> arguments;
};

/// A type or an integer.
struct TemplateArgument {
  TypeName type;
  const Expression* value = nullptr;
};

enum class ExpressionKind : std::uint8_t {
  kInteger,
  kFloating,
  kString,
  kNull,
  kBool,
  kName,         ///< path, template arguments
  kNegate,       ///< −a
  kNot,          ///< !a
  kAddress,      ///< &a
  kDereference,  ///< *a
  kIncrement,    ///< ++a
  kDecrement,    ///< −−a
  kBinary,       ///< a `operation` b
  kAssign,       ///< a = b
  kCall,         ///< a(arguments)
  kCast,         ///< type(a)
  kSubscript,    ///< a[b]
  kMember,       ///< a.name
  kList          ///< {arguments}
};

enum class BinaryOp : std::uint8_t {
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kLess,
  kGreater,
  kLessEqual,
  kGreaterEqual,
  kEqual,
  kNotEqual,
  kAnd,
  kOr
};

struct Expression {
  ExpressionKind kind = ExpressionKind::kInteger;
  BinaryOp operation = BinaryOp::kAdd;
  Place place;
  Symbol name = 0;  ///< kMember; kName: last entry of the path
  long integer = 0;
  double floating = 0;  ///< kFloating: the nearest double of the decimal text
  const Expression *a = nullptr, *b = nullptr;
  std::vector<const Expression*> arguments;  ///< kCall, kList
  const TypeName* type =
      nullptr;              ///< kCast; kName: its path and template arguments unless it is one plain name
  bool global = false;      ///< kName: begins with "::"
  bool moves_time = false;  ///< kBinary of C: adds to a time
  std::string_view text;    ///< kString
};

/// What stands between a type and a comma: `(&M)[7][7] = …`.
struct Declarator {
  Symbol name = 0;
  char indirection = 0;  ///< '&', '*' or none
  std::vector<const Expression*> bounds;
  const Expression* initial = nullptr;
  Place place;
};

enum class StatementKind : std::uint8_t { kBlock, kDeclaration, kExpression, kIf, kFor, kRangeFor, kReturn };

struct Statement {
  StatementKind kind = StatementKind::kBlock;
  Place place;
  std::vector<const Statement*> body;  ///< kBlock; kIf: then, else; loops: one
  TypeName type;                       ///< kDeclaration, kRangeFor
  bool is_constexpr = false;
  std::vector<Declarator> declarators;  ///< kDeclaration; kRangeFor: one
  const Statement* first = nullptr;     ///< kFor: its declaration
  const Expression* a = nullptr;        ///< expression, condition, range, value returned (or none)
  const Expression* step = nullptr;     ///< kFor
};

struct TemplateParameter {
  bool is_type = true;  ///< or an int
  Symbol name = 0;
  const TypeName* standard = nullptr;  ///< default
};

struct Parameter {
  TypeName type;
  Declarator declarator;
};

struct Function {
  Symbol name = 0;
  std::string scope;  ///< "", "detail", or the struct's name
  std::vector<TemplateParameter> parameters_of_template;
  bool is_template = false, is_static = false, is_inline = false, is_explicit = false, is_noexcept = false;
  bool is_constructor = false;
  bool has_stages = false;  ///< is marked as a step that holds inlined functions
  TypeName result;
  char result_indirection = 0;
  std::vector<Parameter> parameters;
  const Statement* body = nullptr;  ///< null: declared only
  std::string comment;
  Place place;
};

struct Struct;

struct Member {
  TypeName type;  ///< unless anonymous
  const Struct* anonymous = nullptr;
  Declarator declarator;
  bool is_static = false, is_constexpr = false;
};

struct Struct {
  Symbol name = 0;
  std::string scope;
  std::vector<TemplateParameter> parameters_of_template;
  std::vector<Member> members;
  std::vector<const Function*> functions;
  std::map<Symbol, TypeName> aliases;
  Place place;
};

/// A variable of a namespace.
struct Constant {
  TypeName type;
  Declarator declarator;
  std::string scope;
  bool is_inline = false;
  bool is_enumerator = false;
};

/// All that the files hold.
struct Unit {
  bool is_c = false;  ///< C, for one number type; read as templates over it
  SymbolTable symbols;
  std::vector<std::string> files;
  std::vector<std::vector<std::string>> directives;  ///< by file
  std::string name_of_namespace;
  std::string opening_comment;                  ///< of the first file
  std::vector<const Function*> functions;       ///< declared or defined in namespaces, in order
  std::vector<const Function*> instantiations;  ///< explicit ones of functions
  std::vector<TypeName> struct_instantiations;
  std::vector<const Struct*> structs;
  std::vector<const Constant*> constants;
  std::vector<const Constant*> declared_constants;  ///< of C: without their values
  std::set<Symbol> numbers;  ///< struct templates that stand for the type of their numbers
  std::map<std::string, std::vector<double>>
      tables;  ///< of namespace detail: functions that take entries, with these
  /// Of C: pointers to functions that the user defines, with the names of their arguments.
  std::vector<std::pair<std::string, std::vector<std::string>>> user_functions;
  std::map<std::string, support::CalledFunction> called;  ///< what the text may call of its user
  bool has_own_sines = false;                             ///< sines that are written out, not the C library's
  // Where all of it lives.
  std::deque<Expression> expressions;
  std::deque<Statement> statements;
  std::deque<TypeName> types;
  std::deque<Function> all_functions;
  std::deque<Struct> all_structs;
  std::deque<Constant> all_constants;
};

/// The type as text with "Real" for the first template parameter where `real` is given that name: "const
/// Model<double>".
std::string text_of(const Unit& unit, const TypeName& type);

/// "const Real (&)[7][7]"; bounds must be integers.
std::string text_of(const Unit& unit, const TypeName& type, const Declarator& declarator);

/// "void mass_matrix(const Model<Real>&, const State<Real>&, Real (&)[7][7]) noexcept", without names of parameters.
std::string signature_of(const Unit& unit, const Function& function);

}  // namespace jourdain::readback
