// The keys of functions given by points or by an expression.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection table_section();
KeySection function_section();

}  // namespace jourdain::model
