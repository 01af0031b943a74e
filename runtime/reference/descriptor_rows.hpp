// Constraints and coordinates of a joint, linearised in the absolute velocities of its bodies.
#pragma once

#include <Eigen/Dense>

#include <span>
#include <vector>

#include "reference/descriptor_forces.hpp"
#include "reference/descriptor_joints.hpp"

namespace jourdain::reference::descriptor {

template <class Scalar>
using Velocity = Eigen::Matrix<Scalar, 6, 1>;  // v_C, ω

/// The body frame's pose as time goes on: with velocity (v_C, ω) and no acceleration (v̇_C = 0, ω̇ = 0).
template <class Scalar>
Pose<TimeJet<Scalar>> coasting(const Body<Scalar>& body, const AbsoluteBody<Scalar>& motion,
                               const Velocity<Scalar>& velocity);

/// Rows over the absolute velocities x = (v_C, ω) of all bodies: the joint's constraints first, then its scalar
/// coordinates. For each row h: ḣ = jacobian x and ḧ = jacobian ẋ + gamma.
template <class Scalar>
struct JointRows {
  Eigen::MatrixX<Scalar> jacobian;  ///< rows × 6 nb; zero outside the parent's and the child's columns
  Eigen::VectorX<Scalar> value, rate, gamma;  ///< h, ḣ and ḧ − jacobian ẋ at the given state
  Eigen::Index constraint_count = 0;
};

/// Rows of `joint`; `near` as in `measure`.
template <class Scalar>
JointRows<Scalar> joint_rows(const Joint<Scalar>& joint, const std::vector<Body<Scalar>>& bodies,
                             const std::vector<AbsoluteBody<Scalar>>& motions, std::span<const Scalar> near,
                             ParallelAxes parallel_axes);

}  // namespace jourdain::reference::descriptor
