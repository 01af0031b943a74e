// The keys of functions given by points.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection table_section();

}  // namespace jourdain::model
