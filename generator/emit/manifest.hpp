// The manifest: what a program that uses an emitted model wants to know about it, as JSON.
#pragma once

#include <string>

#include "emit/file_text.hpp"
#include "emit/operations.hpp"

namespace jourdain::emit {

std::string manifest(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                     const ir::Module& module, const std::vector<StepRecord>& steps);

}  // namespace jourdain::emit
