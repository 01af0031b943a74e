// Types and expressions by recursive descent: one function per level of precedence.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "readback/syntax.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

/// Stands in front of every function; empty unless somebody defines it.
inline constexpr std::string_view kFunctionMacro = "JOURDAIN_FUNCTION";
/// In front of what steps compute in themselves.
inline constexpr std::string_view kInlinedMacro = "JOURDAIN_INLINED";
inline constexpr std::string_view kStagesMacro = "JOURDAIN_STAGES";

/// What C text is read for.
struct CText {
  std::string prefix;  ///< of all that has external linkage: "panda_"
  bool is_float = false;

  std::string internal() const { return prefix + "detail_"; }  ///< prefix of the rest
  const char* real() const { return is_float ? "float" : "double"; }
};

/// A cursor over one file's tokens, with the names that stand for types and templates so far: C++ needs them to tell
/// declarations from expressions and `a < b` from template arguments.
class ExpressionParser {
 public:
  struct Known {
    std::set<Symbol> types;  ///< in scope without a namespace in front: parameters of templates, aliases
    std::set<Symbol> struct_templates, function_templates;
    std::set<Symbol> tables;                        ///< functions of the entries of constants
    std::set<std::pair<Symbol, Symbol>> qualified;  ///< struct templates by namespace
    const CText* c = nullptr;                       ///< null: the text is C++
    bool packs = false;                             ///< C++ whose conversions to Real packs may customize
    std::map<Symbol, TypeName> c_types;             ///< of C, by their whole name
    std::set<std::string> c_operations;             ///< functions of sums of numbers that are defined
  };

  ExpressionParser(Unit& unit, Known& known, const Tokens& tokens, int file)
      : unit_(unit), known_(known), tokens_(tokens), file_(file) {}

  const Expression* expression();
  TypeName type();

 protected:
  const Token& peek(std::size_t ahead = 0) const;
  const Token& take();
  bool is(std::string_view punctuation, std::size_t ahead = 0) const;
  bool is_word(std::string_view word, std::size_t ahead = 0) const;
  bool accept(std::string_view punctuation);
  bool accept_word(std::string_view word);
  void expect(std::string_view punctuation);
  void expect_word(std::string_view word);
  Symbol expect_name();
  [[noreturn]] void refuse_here(const std::string& expected) const;
  Place place() const { return {file_, peek().line}; }

  bool starts_type() const;
  Declarator declarator(bool may_be_unnamed);
  void bounds(Declarator& declarator);
  void expect_text(const std::string& text);
  /// Takes a function that takes entries of an array of constants, if one begins here.
  bool table_function();

  Unit& unit_;
  Known& known_;

 private:
  const Expression* level(int precedence);
  const Expression* unary();
  const Expression* postfix();
  const Expression* primary();
  const Expression* name();
  const Expression* number(bool is_negative = false);
  Expression& plain_number(bool is_negative);
  const Expression* list();
  void arguments(Expression& call, std::string_view close);
  void template_arguments(TypeName& type);
  bool is_known_type(Symbol name) const;
  // in table_functions.cpp
  bool begins_table() const;
  std::vector<double> listed_numbers();
  // of C, in c_expression_parser.cpp
  TypeName c_type();
  const Expression* c_name();
  const Expression* c_call(Expression& call);
  const Expression* c_call_of_user(Expression& call);
  const Expression* cpp_call(Expression& call);
  const Expression* c_parenthesis();
  const Expression* dereferenced(const Expression* pointer);
  const Expression* as_real(const Expression* value);
  bool is_struct_template(const std::vector<Symbol>& path) const;
  Expression& make(ExpressionKind kind);

  const Tokens& tokens_;
  int file_ = 0;
  std::size_t at_ = 0;
  int angle_brackets_ = 0;  ///< inside template arguments '>' ends them
};

}  // namespace jourdain::readback
