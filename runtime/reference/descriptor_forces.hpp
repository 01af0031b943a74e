// Applied forces of the descriptor form: what expressions see at one state, forces on single bodies, forces on
// joints' coordinates.
#pragma once

#include <Eigen/Dense>

#include <optional>
#include <span>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/rotation.hpp"

namespace jourdain::reference {

/// A body in absolute coordinates: four position and orientation, six velocity components.
template <class Scalar>
struct AbsoluteBody {
  Vector3<Scalar> p_WC;                   ///< centre of mass, m, inertial frame
  Eigen::Quaternion<Scalar> orientation;  ///< unit length, body to inertial components
  Vector3<Scalar> v_C;                    ///< velocity of the centre of mass, m/s, inertial frame
  Vector3<Scalar> omega;                  ///< angular velocity, rad/s, body-fixed components
};

}  // namespace jourdain::reference

namespace jourdain::reference::descriptor {

/// A body's inertia at given parameter values.
template <class Scalar>
struct Body {
  Scalar mass = 0;       ///< kg
  Vector3<Scalar> p_BC;  ///< centre of mass, m, body-fixed components
  Matrix3<Scalar> I_C;   ///< about the centre of mass, kg m², body-fixed components
};

/// With `snap`, constant rotations are `snapped`.
template <class Scalar>
Body<Scalar> read_body(const model::Body& body, std::span<const Scalar> parameters, bool snap);

/// A named frame on its body (none: the world).
template <class Scalar>
struct Frame {
  std::optional<std::size_t> body;
  Matrix3<Scalar> R_BF;
  Vector3<Scalar> p_BF;  ///< m
};

/// With `snap`, constant rotations are `snapped`.
template <class Scalar>
Frame<Scalar> read_frame(const model::Frame& frame, std::span<const Scalar> parameters, bool snap);

/// Motion of a named frame.
template <class Scalar>
struct FrameMotion {
  Matrix3<Scalar> R_WF;
  Vector3<Scalar> p_WF, v_F;  ///< origin, m, and its velocity, m/s, inertial frame
  Vector3<Scalar> omega;      ///< rad/s, frame components
};

/// All that expressions refer to, at one state.
template <class Scalar>
struct Scene {
  Scalar t = 0;                                     ///< s
  std::vector<Scalar> parameters, inputs;           ///< as in the mechanism and its CoordinateLayout
  std::vector<std::vector<Scalar>> position, rate;  ///< by joint and scalar coordinate, prescribed ones too
  std::vector<FrameMotion<Scalar>> frames;          ///< as in the mechanism
  std::vector<Scalar> states = {};                  ///< as in the mechanism
  Scalar h = 0;                                     ///< s, of the step that begins; of samples
};

/// Motion of each of the frames on the given bodies.
template <class Scalar>
std::vector<FrameMotion<Scalar>> frame_motions(const std::vector<Frame<Scalar>>& frames,
                                               const std::vector<Body<Scalar>>& bodies,
                                               const std::vector<AbsoluteBody<Scalar>>& motions);

/// Forces on the bodies that pass through no joint: weight and force elements. For each body six rows: force (N,
/// inertial frame), moment about the centre of mass (N m, body-fixed components). Shape 6 nb.
template <class Scalar>
Eigen::VectorX<Scalar> body_forces(const model::Mechanism& mechanism, const Scene<Scalar>& scene,
                                   const std::vector<Frame<Scalar>>& frames,
                                   const std::vector<Body<Scalar>>& bodies,
                                   const std::vector<AbsoluteBody<Scalar>>& motions);

/// Generalized forces on the scalar coordinates of each joint, positive forward, N m or N: joint springs, dampers,
/// friction, actuators and coordinate forces, on prescribed coordinates too. Neither rotor inertia nor spin damping.
template <class Scalar>
std::vector<Eigen::VectorX<Scalar>> coordinate_forces(const model::Mechanism& mechanism,
                                                      const Scene<Scalar>& scene);

/// Rates of the states.
template <class Scalar>
Eigen::VectorX<Scalar> state_rates(const model::Mechanism& mechanism, const Scene<Scalar>& scene);

/// What the states that are sampled are in the step of length `h` of the scene, in their order.
template <class Scalar>
Eigen::VectorX<Scalar> sampled_states(const model::Mechanism& mechanism, const Scene<Scalar>& scene);

/// gear_ratio² rotor_inertia of the actuators, summed on each scalar coordinate of each joint; kg m² or kg.
template <class Scalar>
std::vector<Eigen::VectorX<Scalar>> rotor_inertias(const model::Mechanism& mechanism,
                                                   std::span<const Scalar> parameters);

}  // namespace jourdain::reference::descriptor
