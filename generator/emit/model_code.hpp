// Everything that an emitted model computes, as trees.
#pragma once

#include <string>
#include <vector>

#include "emit/step_functions.hpp"

namespace jourdain::emit {

/// A function, with the parts that a long body is cut into: they are called by it alone, in their order.
struct CutFunction {
  Function function;
  std::vector<Function> parts = {};
};

struct ModelCode {
  std::vector<std::string> constants;  ///< values that depend on the parameters only: members of Model
  CutFunction constructor;             ///< sets them from `parameters`
  std::vector<CutFunction> functions;  ///< in the order of those asked for
  Support support;
  std::vector<Struct> memories;  ///< of what methods remember
  bool has_angle = false;        ///< some angle follows from time
};

/// `functions` are those to emit; each but steps has a program of the same name in `module`.
ModelCode model_code(const programs::SceneFacts& scene, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module);

}  // namespace jourdain::emit
