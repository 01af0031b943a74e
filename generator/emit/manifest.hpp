// The manifest: what a program that uses an emitted model wants to know about it, as JSON.
#pragma once

#include <string>

#include "emit/model_files.hpp"

namespace jourdain::emit {

/// A step and the operations of one call.
struct StepRecord {
  const programs::Stepper* stepper = nullptr;
  long operations = 0;
};

std::string manifest(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module, const std::vector<StepRecord>& steps);

}  // namespace jourdain::emit
