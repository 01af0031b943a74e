// Every joint as a chain of elementary motions: those of its row in model/joint_kinds.cpp, with their directions.
#pragma once

#include <array>
#include <vector>

#include "kinematics/link_tree.hpp"

namespace jourdain::kinematics {

struct JointStep {
  LinkKind kind = LinkKind::kTurn;
  std::array<double, 3> axis{0, 0,
                             1};  ///< turn, slide, screw: in the frame that the joint moves, not normalised
  std::size_t coordinate = 0;     ///< scalar coordinate of the joint
};

/// In the order of the joint's coordinates; none for a fixed joint.
std::vector<JointStep> joint_steps(const model::Joint& joint);

}  // namespace jourdain::kinematics
