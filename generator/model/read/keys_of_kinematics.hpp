// The keys of tables that ask for functions of motion, momentum and weight.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection kinematics_section();

}  // namespace jourdain::model
