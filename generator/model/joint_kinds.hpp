// The types of joints: one row for each, with what generic code asks. The two numeric references read no row: each
// derives every joint on its own.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// What one coordinate, or one quaternion, does to what the joint moves.
enum class MotionKind {
  kTurn,   ///< rotates by y about a direction
  kSlide,  ///< moves by y along a direction
  kScrew,  ///< both: rotates by y and moves by `Joint::pitch` y
  kCurve,  ///< moves on `Joint::curve`, without turning
  kBall,   ///< rotates by a quaternion
  kFree    ///< moves and rotates freely in the inertial frame
};

/// Where the direction of a turn, slide or screw is given.
enum class Along {
  kNone,           ///< curve, ball, free
  kAxis,           ///< `Joint::axis`
  kSecondAxis,     ///< `Joint::second_axis`
  kFirstInPlane,   ///< the first of the two directions orthogonal to `axis` (see slide_directions)
  kSecondInPlane,  ///< the second
  kFirstAxis,      ///< x, y or z, as the first of `Joint::sequence` says
  kMiddleAxis,     ///< the second
  kLastAxis,       ///< the third
  kX,              ///< of the joint's frame
  kY,
  kZ
};

/// A joint is a chain of these: each moves the frame in which the next one is given.
struct JointMotion {
  MotionKind kind = MotionKind::kTurn;
  Along along = Along::kNone;
  std::string_view suffix = {};  ///< of the coordinate's name; none where the joint has one coordinate

  constexpr bool has_coordinate() const { return kind != MotionKind::kBall && kind != MotionKind::kFree; }
  constexpr bool is_angular() const { return kind == MotionKind::kTurn || kind == MotionKind::kScrew; }
  /// Whether it moves the child's origin.
  constexpr bool displaces() const { return kind != MotionKind::kTurn && kind != MotionKind::kBall; }
};

struct JointKind {
  JointType type = JointType::kFixed;
  std::string_view name;                   ///< as a model file has it
  std::span<const JointMotion> motions;    ///< in the order of the coordinates; none: the child is fixed
  std::span<const std::string_view> keys;  ///< of a file, beside those of all joints and of coordinates
  std::optional<LoopType> as_loop = {};    ///< the loop that leaves two bodies the same freedom

  /// Those that have a scalar coordinate; a ball or a free motion comes last.
  constexpr std::span<const JointMotion> coordinates() const {
    const bool turns_freely = !motions.empty() && !motions.back().has_coordinate();
    return motions.first(motions.size() - (turns_freely ? 1 : 0));
  }
  bool has(MotionKind kind) const;
  bool has(Along along) const;
  bool takes(std::string_view key) const;
  /// Whether `Joint::axis` says where it goes.
  bool has_axis() const;
  /// Spherical, free: a quaternion in y, an angular velocity in z, after the scalar coordinates.
  bool has_quaternion() const { return has(MotionKind::kBall) || has(MotionKind::kFree); }
  /// Free: position of the child's origin in y, its velocity in z, before the quaternion.
  bool has_origin() const { return has(MotionKind::kFree); }
  /// The only motion, if it is one that turns about a direction or slides along it.
  const JointMotion* plain_motion() const;
};

const JointKind& joint_kind(JointType type);
inline const JointKind& joint_kind(const Joint& joint) { return joint_kind(joint.type); }

/// In the order of JointType.
const std::vector<std::string>& joint_type_names();

/// Of a gimbal, such as "xyz".
std::string sequence_text(const Joint& joint);

/// Of a turn, slide or screw, in the frame that it moves; not normalised.
std::array<double, 3> direction(const Joint& joint, const JointMotion& motion);

}  // namespace jourdain::model
