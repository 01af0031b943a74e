// The manifest: what a program that uses an emitted model wants to know about it, as JSON.
#pragma once

#include <string>

#include "emit/files.hpp"

namespace jourdain::emit {

std::string manifest(const ModelText& model, const std::vector<FunctionInfo>& functions,
                     const ir::Module& module);

}  // namespace jourdain::emit
