#include "emit/inlining.hpp"

#include <algorithm>

namespace jourdain::emit {

namespace {

bool is_short(const ir::Module& module, const CutFunction& cut) {
  const ir::Program* program = ir::find_program(module, cut.function.name);
  return program && cut.parts.empty() && ir::count_operations(*program).arithmetic() <= kShortFunction;
}

}  // namespace

void inline_short_functions(const std::vector<programs::FunctionInfo>& functions, const ir::Module& module,
                            ModelCode& code) {
  const auto accelerations =
      std::find_if(code.support.functions.begin(), code.support.functions.end(),
                   [](const Function& function) { return function.name == kAccelerations; });
  if (accelerations == code.support.functions.end()) return;
  for (CutFunction& cut : code.functions) {
    const bool is_forward = cut.function.name == name_of(ir::FunctionId::kForwardDynamics);
    if (!is_forward && cut.function.name != name_of(ir::FunctionId::kPositionRate) &&
        cut.function.name != name_of(ir::FunctionId::kCloseLoops))
      continue;
    cut.function.is_inlined = is_short(module, cut);
    if (is_forward) accelerations->is_inlined = cut.function.is_inlined;
  }
  for (std::size_t k = 0; k < functions.size(); ++k)
    code.functions[k].function.has_stages = functions[k].stepper && accelerations->is_inlined;
}

}  // namespace jourdain::emit
