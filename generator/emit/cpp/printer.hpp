// Trees as C++.
#pragma once

#include <string>

#include "emit/tree.hpp"

namespace jourdain::emit::cpp {

/// What a text may take for granted.
struct Place {
  bool in_detail = false;       ///< inside namespace detail, where support is found without its name
  bool samples_inputs = false;  ///< the inputs may be a function of the state
};

/// Shortest decimal that reads back as `value`.
std::string digits_text(double value);

/// The same as a Real.
std::string literal_text(double value);

std::string expression_text(const Expression& expression, const Place& place);

/// Lines from column `indent` on, each ended.
std::string statements_text(const Statements& statements, const Place& place, std::size_t indent = 2);

/// For number type `real`, which is a template's parameter or a built-in type.
std::string type_text(const Type& type, const std::string& real, const Place& place);

/// "name[3][4]".
std::string declared(const Variable& variable, const Place& place);

}  // namespace jourdain::emit::cpp
