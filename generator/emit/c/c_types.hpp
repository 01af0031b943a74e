// Types of expressions, which C has to be told: it has no overloads and no references.
#pragma once

#include <map>
#include <string>

#include "emit/tree.hpp"

namespace jourdain::emit::c {

struct CType {
  enum class Kind { kReal, kInteger, kTime, kAngle, kStruct };
  Kind kind = Kind::kReal;
  std::string structure = {};  ///< name of a struct
};

struct CVariable {
  CType type;
  bool is_pointer = false;  ///< to a struct
  std::string text = {};    ///< what it is called, where that is not its name
};

/// What names mean inside a function.
class CScope {
 public:
  void add(const std::string& name, const CVariable& variable);
  void add(const std::string& name, const Type& type, bool is_pointer);
  const CVariable* find(const std::string& name) const;
  CType type_of(const Expression& expression) const;

 private:
  CType type_of_operation(const Expression& expression) const;
  CType type_of_member(const Expression& expression) const;

  std::map<std::string, CVariable> variables_;
};

}  // namespace jourdain::emit::c
