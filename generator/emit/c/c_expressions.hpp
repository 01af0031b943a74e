// Expressions as C.
#pragma once

#include <string>

#include "emit/c/c_types.hpp"
#include "emit/c/spelling.hpp"

namespace jourdain::emit::c {

class CExpressions {
 public:
  CExpressions(const CNames& names, const CScope& scope) : names_(names), scope_(scope) {}

  std::string text(const Expression& expression) const { return print(expression).text; }
  /// As an angle.
  std::string angle(const Expression& expression) const;
  /// A pointer to the struct.
  std::string address(const Expression& structure) const;
  /// The struct itself.
  std::string object(const Expression& structure) const;

 private:
  /// Binding strength of an expression's outermost operation.
  enum class Strength { kSum, kProduct, kAtom };
  struct Text {
    std::string text;
    Strength strength = Strength::kAtom;
  };

  bool is_pointer(const Expression& expression) const;
  std::string name(const std::string& name) const;
  Text print(const Expression& expression) const;
  Text operation(const Expression& expression) const;
  Text infix(const Expression& expression, const char* sign, Strength strength) const;
  std::string angle_operation(const Expression& expression) const;
  std::string call(const std::string& function, const Expression& expression) const;
  std::string whole(const Expression& expression, std::size_t operand) const;
  std::string at_least(const Expression& operand, Strength strength) const;

  const CNames& names_;
  const CScope& scope_;
};

}  // namespace jourdain::emit::c
