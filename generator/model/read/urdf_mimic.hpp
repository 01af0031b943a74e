// <mimic>: joints of a URDF file that follow others.
#pragma once

#include <vector>

#include "model/mechanism.hpp"
#include "model/read/urdf_file.hpp"

namespace jourdain::model {

struct UrdfMimic {
  JointIndex joint;  ///< the follower
  const XmlElement* element = nullptr;
};

/// Adds a coupler for each, named after the follower, and lets it start where it follows to: coordinate =
/// multiplier · leader + offset; it takes no input. A joint that follows a fixed one is locked where the offset is
/// zero, one that follows an unknown joint moves freely after a warning. Joints that have not one coordinate or follow
/// themselves are errors. All joints are there.
void read_mimics(UrdfFile& file, const std::vector<UrdfMimic>& mimics, Mechanism& mechanism);

}  // namespace jourdain::model
