// The programs of a scene are what its functions may be: sizes of their leaves come from the scene and the arguments.
#pragma once

#include <string>
#include <vector>

#include "emit/functions.hpp"
#include "ir/module.hpp"

namespace jourdain {

/// What is wrong with the programs of a scene with that many parameters, in sentences; see ir::defects.
std::vector<std::string> module_defects(const ir::Module& module, const emit::SceneShape& shape,
                                        std::size_t parameters);

}  // namespace jourdain
