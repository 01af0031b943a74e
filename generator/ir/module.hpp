// All programs of one emitted model: what depends on parameters only, and the functions that use it.
#pragma once

#include <vector>

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

}  // namespace jourdain::ir
