// The C interface of a model: an instance in the caller's memory and the table of everything that it has, in C99 on top
// of the emitted C functions.
#pragma once

#include <vector>

#include "emit/file_text.hpp"

namespace jourdain::emit::c {

/// jourdain_interface.h, the same for all models, and for each number type that is emitted NAME_interface.h and
/// NAME_interface.c (of floats NAME_f_…).
std::vector<File> interface_files(const ModelText& model,
                                  const std::vector<programs::FunctionInfo>& functions,
                                  const ir::Module& module);

}  // namespace jourdain::emit::c
