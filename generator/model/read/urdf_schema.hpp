// What URDF files may say, and what of it is not read.
#pragma once

#include "model/read/urdf_file.hpp"

namespace jourdain::model {

/// Says what of links and joints is not read: warns of attributes that look misspelt, notes others where they may be
/// meant to change the motion. Warns of elements of other programs that would: springs and weightless links of
/// Gazebo's, inertias of motors, joints that close loops. Pictures and shapes are not looked at.
void check_urdf(UrdfFile& file, const XmlElement& robot);

}  // namespace jourdain::model
