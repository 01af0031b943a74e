// Derivatives of expressions, as expressions.
#pragma once

#include <functional>

#include "model/expression.hpp"

namespace jourdain::model {

/// The rate at which `expression` changes where its variables change at the rates `rate`: forward differentiation,
/// node by node. At a kink it is that of the side that the value is taken from; where a function has no derivative it
/// has none.
Expression derivative(const Expression& expression, const std::function<Expression(const Variable&)>& rate);

/// With respect to one variable.
Expression derivative(const Expression& expression, const Variable& by);

}  // namespace jourdain::model
