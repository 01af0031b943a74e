// The numeric reference in minimal coordinates: Jourdain's sums over bodies, evaluated as they are written.
//
// It takes the mechanism as read: every body on its own, fixed joints included, frames where the file puts
// them. It shares no formula with the compiler's recursion, so that agreement of the two means something.
// Clarity over speed.
//
//   v_C = J_t z   ω = J_r z   a_C = J_t ż + ā   ω̇ = J_r ż + ζ̄    (v, a inertial; ω, ω̇ body-fixed components)
//
//   M  =  Σ J_tᵀ m J_t + J_rᵀ I J_r
//   k̄  = −Σ J_tᵀ m ā + J_rᵀ (I ζ̄ + ω × I ω)      inertia terms only
//   q̄  = −Σ J_tᵀ f + J_rᵀ ℓ                       gravity, springs, dampers, inputs
//   M ż = k̄ − q̄
#pragma once

#include <Eigen/Dense>

#include <cstddef>
#include <span>
#include <vector>

#include "model/mechanism.hpp"
#include "reference/rotation.hpp"

namespace jourdain::reference {

template <class Scalar>
using VectorX = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar>
using MatrixX = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Scalar>
using Jacobian = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;

/// Coordinates in the order of model::moving_joints.
template <class Scalar>
struct State {
  Scalar t = 0;       ///< s
  VectorX<Scalar> y;  ///< rad or m
  VectorX<Scalar> z;  ///< rad/s or m/s
};

/// Motion of one body. A `*_scale` bounds its quantity from above, component by component: the same sums with
/// every product replaced by its absolute value, so that cancellation shows.
template <class Scalar>
struct BodyMotion {
  Matrix3<Scalar> R_WB;  ///< body to inertial components
  Vector3<Scalar> p_WC;  ///< centre of mass, m, inertial frame
  Jacobian<Scalar> J_t;  ///< 3 × nz, v_C per unit of z, inertial frame; columns off the body's path are zero
  Jacobian<Scalar> J_r;  ///< 3 × nz, ω per unit of z, body-fixed components
  Vector3<Scalar> a_bar;     ///< ā, m/s², inertial frame
  Vector3<Scalar> omega;     ///< ω, rad/s, body-fixed components
  Vector3<Scalar> zeta_bar;  ///< ζ̄, rad/s², body-fixed components
  Jacobian<Scalar> J_t_scale, J_r_scale;
  Vector3<Scalar> a_bar_scale, omega_scale, zeta_bar_scale;
};

/// The equations of motion M ż = k̄ − q̄ at one state; N or N m per row. A `*_scale` is the sum of the absolute
/// values of the terms: rounding moves an entry by a small multiple of its scale times the unit roundoff.
template <class Scalar>
struct Terms {
  MatrixX<Scalar> M;      ///< nz × nz
  VectorX<Scalar> k_bar;  ///< Coriolis and centrifugal terms; no gravity
  VectorX<Scalar>
      q_bar;  ///< gravity, +stiffness (y − rest), +damping z, −u: a force that pushes forward is negative
  MatrixX<Scalar> M_scale;
  VectorX<Scalar> k_scale, q_scale;
  Scalar kinetic_energy = 0;  ///< J
  Scalar potential_energy = 0;  ///< J: −m g·p_C, zero at the inertial origin, and ½ stiffness (y − rest)²
};

/// kOff reads the rotations as the file's numbers give them, whatever `Mechanism::snap` says.
enum class Snap { kAsModel, kOff };

/// A mechanism with its parameters' values put in. Evaluations are const and independent of each other.
template <class Scalar>
class Reference {
 public:
  /// At the default values of the parameters.
  explicit Reference(const model::Mechanism& mechanism, Snap snap = Snap::kAsModel);
  /// At the given values, in the order of `Mechanism::parameters`; another number of them throws
  /// InternalError.
  Reference(const model::Mechanism& mechanism, std::span<const Scalar> parameters,
            Snap snap = Snap::kAsModel);

  std::size_t coordinate_count() const { return coordinate_count_; }
  std::size_t input_count() const { return inputs_.size(); }
  /// The state in which the model starts, t = 0.
  State<Scalar> initial_state() const;
  /// Motion of every body, in the order of `Mechanism::bodies`.
  std::vector<BodyMotion<Scalar>> motion(const State<Scalar>& state) const;
  /// `u` in the order of `Mechanism::actuators` (N or N m); sizes that do not fit throw InternalError.
  Terms<Scalar> evaluate(const State<Scalar>& state, const VectorX<Scalar>& u) const;

 private:
  struct Body {
    Scalar mass;
    Vector3<Scalar> p_BC;  // centre of mass
    Matrix3<Scalar> I;     // about the centre of mass, body-fixed components
    Matrix3<Scalar> I_scale;
  };
  struct Joint {
    model::JointType type;
    std::ptrdiff_t parent;  // body, −1 for the world
    std::size_t child;
    Eigen::Index coordinate;  // −1 for a fixed joint
    Matrix3<Scalar> R_PJ;
    Vector3<Scalar> p_PJ;
    Vector3<Scalar> axis;  // unit vector, in the joint frame
    Scalar stiffness, rest, damping;
    Scalar initial_position, initial_velocity;
  };
  struct FrameMotion;

  static Body body_value(const model::Body& body, std::span<const Scalar> parameters, bool snap);
  static Joint joint_value(const model::Joint& joint, std::span<const Scalar> parameters, bool snap);
  FrameMotion world_motion() const;
  FrameMotion child_motion(const FrameMotion& parent, const Joint& joint, const State<Scalar>& state) const;
  static BodyMotion<Scalar> body_motion(const FrameMotion& frame, const Body& body);
  void add_body(const Body& body, const BodyMotion<Scalar>& motion, const State<Scalar>& state,
                Terms<Scalar>& sum) const;
  void add_joint_forces(const State<Scalar>& state, const VectorX<Scalar>& u, Terms<Scalar>& sum) const;

  std::vector<Body> bodies_;
  std::vector<Joint> joints_;         // depth first
  std::vector<Eigen::Index> inputs_;  // coordinate of each actuator
  std::size_t coordinate_count_ = 0;
  Vector3<Scalar> gravity_;
};

extern template class Reference<double>;
extern template class Reference<long double>;

/// Share of an entry's natural size that `widen_scales` adds to its term sum.
inline constexpr long double kNaturalShare = 1e-3L;

/// Where every term of an entry vanishes with the same cosine, its term sum says nothing: rounding an angle of size 1
/// moves the entry by the unit roundoff times its natural size, sqrt(M_ii M_jj) for M and as much for rows of k̄ and q̄,
/// measured by M_scale. Adds kNaturalShare of that to the scales.
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
