// Numbers of inputs: actuators come first, then inputs that only expressions use.
#pragma once

#include <cstddef>
#include <functional>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Calls `change` with each expression that may name coordinates, inputs and frames.
void for_general_expressions(Mechanism& mechanism, const std::function<void(Expression&)>& change);

/// Puts another expression in place of each input, by its number.
void replace_inputs(Mechanism& mechanism, const std::function<Expression(std::size_t)>& replacement);

/// Expressions name the same inputs as before.
void add_actuator(Mechanism& mechanism, const Actuator& actuator);

/// What expressions name stays, as an input that pushes nothing itself; they name the same inputs as before.
void remove_actuators(Mechanism& mechanism, const std::function<bool(const Actuator&)>& goes);

}  // namespace jourdain::model
