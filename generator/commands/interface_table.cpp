#include "commands/interface_table.hpp"

#include "support/check.hpp"

namespace jourdain::commands {

using programs::FunctionInfo;

std::optional<std::size_t> function_index(const CompiledModel& compiled, ir::FunctionId id) {
  std::size_t index = 0;
  for (const FunctionInfo& function : compiled.functions) {
    if (function.id == id) return index;
    if (is_listed(function)) ++index;
  }
  return std::nullopt;
}

std::size_t stepper_index(const CompiledModel& compiled, const std::string& step) {
  std::size_t index = 0;
  for (const FunctionInfo& function : compiled.functions) {
    if (function.name == step) return index;
    if (function.stepper) ++index;
  }
  JD_CHECK(false, "{} is not emitted", step);
  return index;
}

}  // namespace jourdain::commands
