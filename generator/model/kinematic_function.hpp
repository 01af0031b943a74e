// Functions of the kinematics and of momentum that a scene asks for: each is emitted on its own.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/indices.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Axes and reference point of velocities, accelerations and Jacobians of a frame; linear before angular components.
enum class Axes {
  kWorldAligned,  ///< of the frame's origin, in world axes
  kFrame,         ///< of the frame's origin, in the frame's axes
  kWorld          ///< of the point of the frame's body that is at the world's origin, in world axes
};

/// What a function computes. Rows of six are linear before angular.
enum class KinematicQuantity {
  kPose,                       ///< position and rotation matrix of a frame
  kVelocity,                   ///< of a frame
  kAcceleration,               ///< of a frame at given ż
  kImu,                        ///< specific force and angular velocity that a sensor fixed to the frame reads
  kJacobian,                   ///< velocity = J z, and + drift where coordinates are driven
  kJacobianBias,               ///< acceleration = J ż + bias: J̇ z
  kCenterOfMass,               ///< of all bodies
  kCenterOfMassJacobian,       ///< its velocity = J z
  kCenterOfMassBias,           ///< J̇ z
  kMomentum,                   ///< linear, and angular about the centre of mass
  kCentroidalMomentumMatrix,   ///< momentum = A z
  kCentroidalMomentumBias,     ///< Ȧ z
  kGravityCompensation,        ///< generalized forces that hold the mechanism at rest against gravity
  kInverseOperationalInertia,  ///< J M⁻¹ Jᵀ of a frame
};

/// One emitted function: its quantities share what they have in common.
struct KinematicFunction {
  std::string name;  ///< a C++ identifier
  std::optional<FrameIndex> frame;
  Axes axes = Axes::kWorldAligned;
  std::vector<KinematicQuantity> quantities;
  support::SourceRange where = {};
};

}  // namespace jourdain::model
