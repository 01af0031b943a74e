// Which elements and attributes an MJCF file may have, and what becomes of those that are not read.
#pragma once

#include "model/read/mjcf_file.hpp"

namespace jourdain::model {

/// Walks the whole file. Warns of elements and attributes that MJCF does not have, and of what changes the motion and
/// is not read; default classes that are missing and elements that bring bodies of their own are errors. Silent about
/// appearance, contacts, limits, sensors and solvers.
void check_mjcf(MjcfFile& file);

}  // namespace jourdain::model
