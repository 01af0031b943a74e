// The keys of tables that bring in other files, and of those that write others out.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection import_section();
KeySection override_section();
KeySection repeat_section();

}  // namespace jourdain::model
