// <joint> of SDF.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "model/read/read.hpp"
#include "model/read/sdf_frames.hpp"

namespace jourdain::model {

/// That one coordinate of a joint follows another one: coordinate = multiplier · leader + offset.
struct SdfMimic {
  std::size_t coordinate = 0;
  std::string leader;  ///< a joint, whole name
  std::size_t leader_coordinate = 0;
  double multiplier = 1, offset = 0;
  SourceRange where = {};
};

/// That θ₂ = −ratio θ₁: the angles from the reference to the parent about `Joint::axis` and to the child about
/// `Joint::second_axis`.
struct SdfGearbox {
  std::optional<BodyIndex> reference;
  double ratio = 1;
};

struct SdfJoint {
  Joint joint;        ///< parent and child as the file has them; no placement yet
  SdfPose pose = {};  ///< of its frame in the world, at coordinate zero
  SourceRange pose_where = {};
  std::vector<std::optional<std::array<double, 2>>> limits = {};  ///< by coordinate
  std::vector<SdfMimic> mimics = {};
  std::optional<SdfGearbox> gearbox = {};  ///< a gearbox carries nothing
};

/// A <joint> element in a model.
struct SdfJointElement {
  const XmlElement* element = nullptr;
  std::string scope;
};

/// Nothing after a diagnostic. The frames are settled.
std::optional<SdfJoint> read_sdf_joint(SdfFile& file, SdfFrames& frames, const SdfJointElement& given,
                                       const ReadOptions& options);

}  // namespace jourdain::model
