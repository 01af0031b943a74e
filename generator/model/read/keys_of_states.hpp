// The keys of states beside the mechanism, and of what is made of them.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection state_section();
KeySection memory_section();
KeySection signal_section();
KeySection friction_section();

}  // namespace jourdain::model
