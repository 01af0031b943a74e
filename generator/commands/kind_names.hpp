// The words of the model file for kinds of joints, loops and outputs.
#pragma once

#include <string>

#include "model/mechanism.hpp"

namespace jourdain::commands {

const char* joint_type_name(model::JointType type);
std::string loop_type_name(model::LoopType type);  ///< "planar_pin"
const char* output_kind_name(model::OutputKind kind);

}  // namespace jourdain::commands
