// All programs of one emitted model: what depends on parameters only, and the functions that use it.
#pragma once

#include <algorithm>
#include <vector>

#include "ir/function_id.hpp"
#include "ir/program.hpp"

namespace jourdain::ir {

struct Module {
  /// Computes the model's constants from its parameters; output i is leaf {kConstant, i} of the functions.
  Program constants;
  std::vector<Program> functions;
};

/// The function of that name, or null.
inline const Program* find_program(const Module& module, const std::string& name) {
  for (const Program& program : module.functions)
    if (program.name == name) return &program;
  return nullptr;
}

inline const Program* find_program(const Module& module, FunctionId function) {
  return find_program(module, name_of(function));
}

/// Has any of the module's programs an arctangent?
inline bool has_arctangent(const Module& module) {
  std::size_t count = count_operations(module.constants).atan2;
  for (const Program& program : module.functions) count += count_operations(program).atan2;
  return count > 0;
}

/// Has any of them a sine, cosine or arctangent?
inline bool has_angles(const Module& module) {
  const auto angles = [](const Program& program) {
    const Operations count = count_operations(program);
    return count.sin + count.cos + count.atan2 > 0;
  };
  return angles(module.constants) || std::any_of(module.functions.begin(), module.functions.end(), angles);
}

}  // namespace jourdain::ir
