#include "passes/pipeline.hpp"

#include <algorithm>
#include <functional>

#include "passes/angles.hpp"
#include "passes/constants.hpp"
#include "passes/factor.hpp"
#include "passes/hoist.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Module;
using ir::Program;

namespace {

std::function<Module(const Module&)> each_function(Program (*pass)(const Program&)) {
  return [pass](const Module& module) {
    Module result;
    result.constants = module.constants;
    for (const Program& function : module.functions) result.functions.push_back(pass(function));
    return result;
  };
}

struct Pass {
  const char* name;
  Effect effect;
  std::function<Module(const Module&)> run;
};

/// The pipeline: a new pass is one line here.
const std::vector<Pass>& pipeline() {
  static const std::vector<Pass> passes = {
      {"split_angles", Effect::kReassociating, each_function(split_angles)},
      {"factor", Effect::kReassociating, each_function(factor)},
      {"group_constants", Effect::kReassociating, each_function(group_constants)},
      {"remove_dead_code", Effect::kExact, each_function(remove_dead_code)},
      {"hoist", Effect::kExact, hoist},
  };
  return passes;
}

}  // namespace

std::size_t arithmetic(const Module& module) {
  std::size_t total = ir::count_operations(module.constants).arithmetic();
  for (const Program& function : module.functions) total += ir::count_operations(function).arithmetic();
  return total;
}

Optimised optimise(Module module, const std::vector<std::string>& switched_off) {
  Optimised result;
  for (const Pass& pass : pipeline()) {
    if (std::find(switched_off.begin(), switched_off.end(), pass.name) != switched_off.end()) continue;
    PassRecord record{pass.name, pass.effect, arithmetic(module), 0};
    module = pass.run(module);
    record.operations_after = arithmetic(module);
    result.records.push_back(record);
  }
  result.module = std::move(module);
  return result;
}

}  // namespace jourdain::passes
