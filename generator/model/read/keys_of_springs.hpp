// The keys of springs between frames.
#pragma once

#include "model/read/keys.hpp"

namespace jourdain::model {

KeySection spring_section();
KeySection bushing_section();
KeySection cable_section();
KeySection gear_mesh_section();

}  // namespace jourdain::model
