// Where functions stand in the tables of the emitted C interface.
#pragma once

#include <optional>
#include <string>

#include "compile/compile.hpp"

namespace jourdain::commands {

/// Number of a function among `jourdain_interface::functions`; none where it is not emitted.
std::optional<std::size_t> function_index(const CompiledModel& compiled, ir::FunctionId id);

/// Number of a step, "rk4_step", among `jourdain_interface::steppers`. Asserts that it is emitted.
std::size_t stepper_index(const CompiledModel& compiled, const std::string& step);

}  // namespace jourdain::commands
