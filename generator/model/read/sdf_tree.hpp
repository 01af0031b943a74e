// From the links and joints of SDF, which may make any graph, to a tree of bodies with loops.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "model/read/sdf_joint.hpp"

namespace jourdain::model {

struct SdfLink {
  Body body;              ///< without centre of mass and axes of its inertia
  SdfPose pose = {};      ///< in the world, at coordinate zero
  SdfPose inertial = {};  ///< in the link
  SourceRange pose_where = {}, inertial_where = {};
  bool is_static = false;
};

/// A <frame>.
struct SdfNamedFrame {
  std::string name;
  std::optional<BodyIndex> body = {};  ///< none: the world
  SdfPose pose = {};                   ///< in the world, at coordinate zero
  SourceRange where = {}, pose_where = {};
};

struct SdfGraph {
  const std::vector<SdfLink>& links;
  const std::vector<SdfJoint>& joints;
  const std::vector<SdfNamedFrame>& frames;
};

/// Adds bodies, joints, frames, loops, couplers and actuators to `mechanism`. A link that a joint moves has its body's
/// frame at the joint and a frame NAME_link where that is not its own. Joints that would carry a link twice, or in a
/// circle, become loops: first kept in the tree are those that no loop can stand for, then those with springs, dampers
/// or followers, then the others in order. What no joint carries is free, or fixed to the world as `options.root`
/// has it.
void assemble(SdfFile& file, const SdfGraph& graph, const ReadOptions& options, Mechanism& mechanism);

}  // namespace jourdain::model
