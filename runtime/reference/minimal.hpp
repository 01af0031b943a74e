// The numeric reference in minimal coordinates: Jourdain's sums over bodies, evaluated as they are written.
//
// It takes the mechanism as read: every body on its own, fixed joints included, frames where the file puts
// them. It shares no formula with the compiler's recursion, so that agreement of the two means something.
// Clarity over speed.
//
//   v_C = J_t z + v̄   ω = J_r z + ω̄   a_C = J_t ż + ā   ω̇ = J_r ż + ζ̄
//   (v, a inertial; ω, ω̇ body-fixed components)
//
//   M  =  Σ J_tᵀ m J_t + J_rᵀ I J_r
//   k̄  = −Σ J_tᵀ m ā + J_rᵀ (I ζ̄ + ω × I ω)      inertia terms only
//   q̄  = −Σ J_tᵀ f + J_rᵀ ℓ                       gravity, springs, dampers, loads, inputs
//   M ż = k̄ − q̄
#pragma once

#include <Eigen/Dense>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "model/taylor.hpp"
#include "reference/bounded.hpp"
#include "reference/decompositions.hpp"
#include "reference/rotation.hpp"
#include "reference/scaled_scalar.hpp"

namespace jourdain::reference {

using model::Taylor;

template <class Scalar>
using Jacobian = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

/// y and z as in model::CoordinateLayout.
template <class Scalar>
struct State {
  Scalar t = 0;       ///< s
  VectorX<Scalar> y;  ///< rad or m; unit quaternions w x y z
  VectorX<Scalar> z;  ///< rad/s or m/s
  /// Inputs, where prescribed accelerations depend on them; `evaluate` and `outputs` have their own.
  VectorX<Scalar> u = {};
};

/// Motion of a point and of the frame that it is fixed in: v = J_t z + v̄, ω = J_r z + ω̄, a = J_t ż + ā, ω̇ =
/// J_r ż + ζ̄. A `*_scale` bounds its quantity from above, component by component: the same sums with every
/// product replaced by its absolute value, so that cancellation shows.
template <class Scalar>
struct BodyMotion {
  Matrix3<Scalar> R_WB;  ///< body to inertial components
  Vector3<Scalar> p_WC;  ///< centre of mass (origin of a frame), m, inertial frame
  Jacobian<Scalar> J_t;  ///< 3 × nz, v_C per unit of z, inertial frame; columns off the body's path are zero
  Jacobian<Scalar> J_r;  ///< 3 × nz, ω per unit of z, body-fixed components
  Vector3<Scalar> v_bar, a_bar;         ///< v̄, m/s, and ā, m/s², inertial frame
  Vector3<Scalar> omega_bar, zeta_bar;  ///< ω̄, rad/s, and ζ̄, rad/s², body-fixed components
  Vector3<Scalar> v, omega;             ///< of the state, as v̄ and ω̄
  Jacobian<Scalar> J_t_scale, J_r_scale;
  Vector3<Scalar> p_scale, v_scale, a_bar_scale, omega_scale, zeta_bar_scale;
};

/// The equations of motion M ż = k̄ − q̄ at one state; N or N m per row. A `*_scale` is the sum of the absolute
/// values of the terms: rounding moves an entry by a small multiple of its scale times the unit roundoff.
template <class Scalar>
struct Terms {
  MatrixX<Scalar> M;      ///< nz × nz
  VectorX<Scalar> k_bar;  ///< Coriolis, centrifugal and rheonomic terms; no gravity
  VectorX<Scalar> q_bar;  ///< applied forces: one that pushes a coordinate forward is negative
  MatrixX<Scalar> M_scale;
  VectorX<Scalar> k_scale, q_scale;
  Scalar kinetic_energy = 0;    ///< J
  Scalar potential_energy = 0;  ///< J: −m g·p_C, zero at the inertial origin, springs, elements
  Scalar kinetic_scale = 0, potential_scale = 0;
  Eigen::Index state_count = 0;  ///< last rows: ẋ = −q̄, a unit inertia each
};

/// Entries of one output of the mechanism, member by member, matrices row by row: pose: position, rotation;
/// velocity: v, ω; acceleration: a, ω̇; jacobian: J_t, J_r, v̄, ω̄, ā, ζ̄; reaction: force, moment; otherwise
/// one number.
template <class Scalar>
struct OutputValue {
  std::vector<Scalar> values, scales;
};

/// Arrays of one function of the kinematics by name, row by row; of the operational inertia the Jacobian.
template <class Scalar>
using KinematicArrays = std::vector<std::pair<std::string, std::vector<Scalar>>>;

namespace detail {
template <class Scalar>
struct CentroidalMotion;
}

/// A mechanism with its parameters' values put in. Evaluations are const and independent of each other.
template <class Scalar>
class Reference {
 public:
  /// At the default values of the parameters.
  explicit Reference(const model::Mechanism& mechanism);
  /// At the given values, in the order of `Mechanism::parameters`; another number of them throws
  /// InternalError.
  Reference(const model::Mechanism& mechanism, std::span<const Scalar> parameters);

  std::size_t position_count() const { return layout_.position_count(); }
  std::size_t coordinate_count() const { return layout_.velocity_count(); }
  std::size_t input_count() const { return layout_.input_count(); }
  /// The state in which the model starts, t = 0.
  State<Scalar> initial_state() const;
  /// Largest prescribed angle, rad, at least π: rounding an angle moves everything by its size times the unit roundoff.
  Scalar largest_angle(const State<Scalar>& state) const;
  /// ẏ = Z z.
  VectorX<Scalar> position_rate(const State<Scalar>& state) const;
  /// Motion of every body's centre of mass, in the order of `Mechanism::bodies`.
  std::vector<BodyMotion<Scalar>> motion(const State<Scalar>& state) const;
  /// Motion of every frame's origin, in the order of `Mechanism::frames`.
  std::vector<BodyMotion<Scalar>> frame_motion(const State<Scalar>& state) const;
  /// `u` as in model::CoordinateLayout (N or N m); sizes that do not fit throw InternalError.
  Terms<Scalar> evaluate(const State<Scalar>& state, const VectorX<Scalar>& u) const;
  /// What the states that are sampled are in the step of length `h` (s) that begins there, in their order.
  VectorX<Scalar> sampled_states(const State<Scalar>& state, const VectorX<Scalar>& u, const Scalar& h) const;
  /// In the order of `Mechanism::outputs`, with the accelerations ż and a bound `zdot_scale` of what those come from.
  std::vector<OutputValue<Scalar>> outputs(const State<Scalar>& state, const VectorX<Scalar>& u,
                                           const VectorX<Scalar>& zdot,
                                           const VectorX<Scalar>& zdot_scale) const;
  /// In the order of `Mechanism::kinematics`, with the accelerations ż; biases with `bias_zdot`.
  std::vector<KinematicArrays<Scalar>> kinematics(const State<Scalar>& state, const VectorX<Scalar>& zdot,
                                                  const VectorX<Scalar>& bias_zdot) const;

 private:
  struct Body {
    Scalar mass;
    Vector3<Scalar> p_BC;  // centre of mass
    Matrix3<Scalar> I;     // about the centre of mass, body-fixed components
    Matrix3<Scalar> I_scale;
  };
  struct FrameMotion;
  struct Forces;
  struct Effect;

  // Columns of all scalar velocities: those of z, then the prescribed ones.
  Eigen::Index column_count() const;
  Eigen::Index column_of(std::size_t joint, std::size_t coordinate) const;
  Taylor<Scalar> coordinate(std::size_t joint, std::size_t coordinate, const State<Scalar>& state) const;
  Taylor<Scalar> taylor(const model::Expression& expression, Scalar variable) const;
  Scalar value(const model::Expression& expression) const { return expression.evaluate<Scalar>(parameters_); }
  Bounded<Scalar> general(const model::Expression& expression, const Forces& at) const;

  Body body_value(const model::Body& body) const;
  FrameMotion world_motion() const;
  std::vector<FrameMotion> body_frames(const State<Scalar>& state) const;
  FrameMotion child_motion(const FrameMotion& parent, std::size_t joint, const State<Scalar>& state) const;
  void turn_freely(FrameMotion& child, std::size_t joint, const State<Scalar>& state) const;
  FrameMotion placed(const std::vector<FrameMotion>& bodies, const model::Frame& frame) const;
  BodyMotion<Scalar> seen(const FrameMotion& frame, const State<Scalar>& state) const;

  detail::CentroidalMotion<Scalar> centroidal_motion(const State<Scalar>& state) const;

  Forces forces(const State<Scalar>& state, const VectorX<Scalar>& u) const;
  VectorX<Scalar> prescribed_accelerations(const State<Scalar>& state) const;
  Terms<Scalar> all_columns(const Forces& at) const;
  void add_body(const Body& body, const FrameMotion& center, const Forces& at, Terms<Scalar>& sum) const;
  void add_joint_forces(const Forces& at, Terms<Scalar>& sum) const;
  void add(const Effect& effect, const Forces& at, Terms<Scalar>& sum) const;

  // By kind of force element.
  Effect effect(const model::Actuator& actuator, const Forces& at) const;
  Effect effect(const model::CoordinateForce& force, const Forces& at) const;
  Effect effect(const model::Spring& spring, const Forces& at) const;
  Effect effect(const model::Load& load, const Forces& at) const;
  Effect effect(const model::Bushing& bushing, const Forces& at) const;
  Effect effect(const model::StateVariable& state, const Forces& at) const;

  /// Second derivatives of all scalar velocities, with their scales.
  struct Accelerations {
    VectorX<Scalar> values, scales;
  };
  OutputValue<Scalar> output(const model::Output& output, const Forces& at, const Terms<Scalar>& terms,
                             const Accelerations& accelerations) const;
  OutputValue<Scalar> reaction(std::size_t joint, const Forces& at, const Accelerations& accelerations) const;

  model::Mechanism mechanism_;
  model::CoordinateLayout layout_;
  std::vector<Scalar> parameters_;
  std::vector<std::pair<std::size_t, std::size_t>> prescribed_;  // joint, scalar coordinate
  std::vector<model::JointIndex> order_;                         // depth first
  std::vector<Body> bodies_;
  Vector3<Scalar> gravity_;
};

extern template class Reference<double>;
extern template class Reference<long double>;
extern template class Reference<support::ScaledReal>;

/// Share of an entry's natural size that `widen_scales` adds to its term sum.
inline constexpr long double kNaturalShare = 1e-3L;

/// Where every term of an entry vanishes with the same cosine, its term sum says nothing: rounding an angle of size 1
/// moves the entry by the unit roundoff times its natural size, sqrt(M_ii M_jj) for M and as much for rows of
/// k̄ and q̄, measured by M_scale. Adds kNaturalShare of that to the scales, but of states.
template <class Scalar>
void widen_scales(Terms<Scalar>& terms);

/// ż = M⁻¹ (k̄ − q̄) by LDLᵀ of M.
template <class Scalar>
VectorX<Scalar> forward_dynamics(const Terms<Scalar>& terms);

/// Largest over the rows of |M ż − k̄ + q̄| / (M_scale |ż| + k_scale + q_scale); rows that are zero throughout
/// count 0.
template <class Scalar>
Scalar backward_error(const Terms<Scalar>& terms, const VectorX<Scalar>& zdot);

/// Condition number of a symmetric matrix in the 2-norm, units taken as they are; infinite when it is not
/// positive definite, 1 when it is empty.
template <class Scalar>
Scalar condition(const MatrixX<Scalar>& M);

}  // namespace jourdain::reference
