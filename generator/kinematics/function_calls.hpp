// The functions of support/elementary_functions.hpp in symbols, where GiNaC knows nothing of them: none is rewritten.
#pragma once

#include <optional>

#include "kinematics/statements.hpp"
#include "support/elementary_functions.hpp"

namespace jourdain::kinematics {

/// f(a, b), or f(a); of numbers a number of 77 digits, unless there is none: what has no value need not be taken.
Ex applied(support::Function function, const Ex& a, const Ex& b);

/// The function of a call made by `applied`, whose operands are a (and b).
std::optional<support::Function> function_in(const Ex& call);

}  // namespace jourdain::kinematics
