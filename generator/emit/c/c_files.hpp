// The emitted files of a model in C99.
#pragma once

#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit::c {

/// For each number type NAME.h and NAME.c (of floats NAME_f.h, NAME_f.c), then NAME.json. `functions` are those to
/// emit; each but steps has a program of the same name in `module`.
std::vector<File> model_files(const ModelText& model, const std::vector<programs::FunctionInfo>& functions,
                              const ir::Module& module);

}  // namespace jourdain::emit::c
