// The keys of tables that push and never pull.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection stop_section();
KeySection contact_section();
KeySection tyre_section();

}  // namespace jourdain::model
