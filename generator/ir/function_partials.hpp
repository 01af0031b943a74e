// Partial derivatives of functions, as values of a program.
#pragma once

#include <utility>

#include "ir/builder.hpp"

namespace jourdain::ir {

/// ∂f/∂a and ∂f/∂b; `value` is f(a, b). Without `by_b` the second is not asked for. At a kink those of the side that
/// the value is taken from: f(a, b) = |a| has slope 1 at 0, max(a, b) that of a where both are equal.
std::pair<Signed, Signed> partials(Builder& builder, support::Function function, Signed a, Signed b,
                                   Signed value, bool by_b);

}  // namespace jourdain::ir
