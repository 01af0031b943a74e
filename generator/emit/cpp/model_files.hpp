// The emitted files of a model in C++.
#pragma once

#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit::cpp {

/// NAME.hpp, NAME_kernels.hpp, NAME.cpp and NAME.json, in this order. `functions` are those to emit; each but
/// steps has a program of the same name in `module`.
std::vector<File> model_files(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                              const ir::Module& module);

}  // namespace jourdain::emit::cpp
