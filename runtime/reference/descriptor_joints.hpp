// Joints of the descriptor form: the pose that a joint's coordinates give its child, and, the other way round, the
// constraints and coordinates that two bodies' absolute poses imply.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/rotation.hpp"
#include "reference/time_jet.hpp"

namespace jourdain::reference {

/// How revolute, screw, cylindrical and planar joints keep the axis w_l of the child parallel to the axis w_k of the
/// parent.
enum class ParallelAxes {
  kFixedNormals,  ///< u₁·w_l = u₂·w_l = 0 with u₁, u₂ ⟂ w_k fixed in the parent: always regular
  kCrossProduct  ///< rows of w_k × w_l = 0 (inertial components, eq. 2.79): the two that the current w_k makes regular
};

}  // namespace jourdain::reference

namespace jourdain::reference::descriptor {

/// Pose of frame F in the inertial frame: components of F to inertial ones, and F's origin (m).
template <class T>
struct Pose {
  Matrix3<T> R_WF = Matrix3<T>::Identity();
  Vector3<T> p_WF = Vector3<T>::Zero();

  /// Pose of a frame that is at (R_FG, p_FG) in F.
  Pose moved(const Matrix3<T>& R_FG, const Vector3<T>& p_FG) const {
    return {R_WF * R_FG, p_WF + R_WF * p_FG};
  }
};

/// A joint at given parameter values; directions are unit vectors in the joint frame.
template <class Scalar>
struct Joint {
  model::JointType type = model::JointType::kFixed;
  std::optional<std::size_t> parent;  ///< body; none: the world
  std::size_t child = 0;
  Matrix3<Scalar> R_PJ;  ///< joint frame to parent components
  Vector3<Scalar> p_PJ;  ///< m
  Vector3<Scalar> axis, second_axis;
  Vector3<Scalar> normals[2];              ///< right-handed with `axis`; planar: the directions of sliding
  Scalar pitch = 0;                        ///< m/rad
  std::array<Eigen::Index, 3> sequence{};  ///< gimbal: x, y or z as 0, 1, 2, of each turn
  model::Vector3 curve;
  std::vector<Scalar> parameters;  ///< for `curve`
};

/// With `snap`, constant rotations are `snapped`.
template <class Scalar>
Joint<Scalar> read_joint(const model::Joint& joint, std::span<const Scalar> parameters, bool snap);

/// The joint frame on the parent whose pose is `parent`.
template <class Scalar>
Pose<TimeJet<Scalar>> joint_frame(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent);

/// The child where the scalar coordinates (rad or m) put it. Not for spherical and free joints, which have none.
template <class Scalar>
Pose<TimeJet<Scalar>> child_pose(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent,
                                 std::span<const TimeJet<Scalar>> coordinates);

/// What absolute poses say about a joint.
template <class Scalar>
struct Measurement {
  std::vector<TimeJet<Scalar>>
      constraints;  ///< g, ġ, g̈; zero where the joint holds; m, or the sine of an angle
  std::vector<TimeJet<Scalar>> coordinates;  ///< the joint's scalar coordinates, rad or m
};

/// Constraints and coordinates from the poses of the parent (identity for the world) and the child. `near` are
/// approximate coordinates: an angle is the one within half a turn of them, and a curve is followed from there (its
/// tangent must not vanish). Six minus the number of degrees of freedom constraints, independent of each other where
/// the joint holds. A coordinate's gradient does no work along the constraints: on a turning coordinate it is a moment
/// along the axis (universal joint: the moment without component along the locked direction; gimbal: the one without
/// component along the two other axes, where the three span space), on a sliding one a force at the child's origin
/// along the direction (curve: along the tangent).
template <class Scalar>
Measurement<Scalar> measure(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent,
                            const Pose<TimeJet<Scalar>>& child, std::span<const Scalar> near,
                            ParallelAxes parallel_axes);

}  // namespace jourdain::reference::descriptor
