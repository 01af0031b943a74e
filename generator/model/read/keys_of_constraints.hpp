// The keys of tables that bind velocities.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection constraint_section();

}  // namespace jourdain::model
