// Constants of the emitted header that say where an entry of y, z or u stands.
#pragma once

#include <string>

#include "emit/file_text.hpp"

namespace jourdain::emit::cpp {

/// A namespace `index` with y_NAME, z_NAME and u_NAME for each position, velocity and input; empty where there
/// is none. The first letter keeps them apart from keywords and from what macros are usually called.
std::string index_constants(const ModelText& model);

}  // namespace jourdain::emit::cpp
