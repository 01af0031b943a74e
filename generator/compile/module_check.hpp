// The programs of a scene are what its functions may be: sizes of their leaves come from the scene and the arguments.
#pragma once

#include <string>
#include <vector>

#include "ir/module.hpp"
#include "programs/functions.hpp"

namespace jourdain {

/// What is wrong with the programs of a scene, in sentences; see ir::defects.
std::vector<std::string> module_defects(const ir::Module& module, const programs::SceneFacts& scene);

}  // namespace jourdain
