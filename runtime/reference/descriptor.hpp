// The numeric reference in descriptor form: every body in absolute coordinates, every joint a set of constraints.
//
// It takes the mechanism as read and shares no derivation with the reference in minimal coordinates nor with the
// compiler: no recursion over the tree, no Jacobians to minimal velocities. Each constraint is written once, on
// numbers that carry two time derivatives. With x = (v_C inertial, ω body-fixed) of all bodies, C the gradients of the
// joints' scalar coordinates θ and Q the forces on them:
//
//   g(…) = 0     G x + g_t = 0     G ẋ + γ = 0     θ̇ = C x     θ̈ = C ẋ + γ_θ
//
//   [ M + Cᵀ J C   Gᵀ ] [ ẋ ]   [ f − ω × I ω + Cᵀ (Q − J γ_θ) ]     J: rotor inertias, gear² each
//   [ G            0  ] [ λ ] = [ −γ                           ]     constraint force on the system: −Gᵀ λ
//
// A prescribed coordinate is the constraint θ − motion(t) = 0. Loop joints add rows of their own; where some
// of all rows are redundant, independent combinations take their place. Minimal coordinates serve only to set
// up a consistent state and to say what the loops' forces are in them. Clarity over speed.
#pragma once

#include <Eigen/Dense>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "reference/descriptor_forces.hpp"
#include "reference/descriptor_joints.hpp"
#include "reference/descriptor_loops.hpp"
#include "reference/descriptor_rows.hpp"

namespace jourdain::reference {

struct DescriptorOptions {
  ParallelAxes parallel_axes = ParallelAxes::kFixedNormals;
  /// Which loop rows count as redundant. A state that is integrated leaves the constraints a little, and rows
  /// that are redundant on them are not beside them: trajectories of overconstrained mechanisms need a coarser
  /// measure than states that are closed.
  double dependent = descriptor::kDependent;
};

template <class Scalar>
struct BodyAcceleration {
  Vector3<Scalar> a_O;        ///< of the body frame's origin, m/s², inertial frame
  Vector3<Scalar> a_C;        ///< of the centre of mass, m/s², inertial frame
  Vector3<Scalar> omega_dot;  ///< rad/s², body-fixed components
};

/// Force (N) and moment (N m) about the child's origin, in the child's components.
template <class Scalar>
struct JointWrench {
  Vector3<Scalar> force = Vector3<Scalar>::Zero();
  Vector3<Scalar> moment = Vector3<Scalar>::Zero();
};

/// Constraints of the loops in the velocities z of the open tree, rows as model::Loop orders them: ġ = G z + g_t.
template <class Scalar>
struct LoopConstraints {
  Eigen::MatrixX<Scalar> G;        ///< rows × nz
  Eigen::VectorX<Scalar> g, rate;  ///< g, and G z + g_t
};

template <class Scalar>
struct DescriptorSolution {
  std::vector<BodyAcceleration<Scalar>> bodies;  ///< in the order of `Mechanism::bodies`
  Eigen::VectorX<Scalar> zdot;                   ///< ż in the order of model::CoordinateLayout
  /// By joint, what it transmits to its child: constraint forces, drives, joint springs, dampers, friction, actuators,
  /// coordinate forces, spin damping. Not the moment that accelerates rotors, which is in `rotor_wrenches`; the
  /// child's momentum balance has the sum of the two.
  std::vector<JointWrench<Scalar>> reactions;
  /// By joint, −gear² rotor_inertia θ̈ along the gradients of its coordinates.
  std::vector<JointWrench<Scalar>> rotor_wrenches;
  /// By joint and scalar coordinate, what the motion's actuator must apply, positive forward, N m or N: beyond all
  /// other forces on that coordinate, with the rotors' acceleration. None where the coordinate is free.
  std::vector<std::vector<std::optional<Scalar>>> drives;
  /// g and G x + g_t at the given state, joint by joint, constraints before prescribed coordinates: rounding
  /// only. Those of loops are apart.
  Eigen::VectorX<Scalar> g, g_rate;
  LoopConstraints<Scalar> loops;
  Eigen::VectorX<Scalar> loop_gamma;  ///< γ of the loops in z: g̈ = G ż + γ
  /// Multipliers of the loops' rows in M ż = k̄ − q̄ − Gᵀ λ, in z; of redundant rows those of least norm. Reactions and
  /// drives go with them.
  Eigen::VectorX<Scalar> loop_lambda;
  /// Gᵀ λ in z, N or N m, from the bodies' accelerations rather than from λ: what the open tree's equations lack.
  Eigen::VectorX<Scalar> loop_forces;
  Eigen::Index loop_rank = 0;       ///< of the loops' rows on the motions of the tree (see `kDependent`)
  Eigen::Index size = 0, rank = 0;  ///< of the system's matrix; a lower rank leaves ẋ or λ undetermined
  Scalar reciprocal_condition = 0;  ///< of that matrix, estimated in the 1-norm, units taken as they are
};

/// Every body in absolute coordinates; it may leave the constraints.
template <class Scalar>
struct AbsoluteState {
  Scalar t = 0;  ///< s
  std::vector<AbsoluteBody<Scalar>> bodies;
  std::vector<std::vector<Scalar>> near;  ///< by joint, its scalar coordinates approximately (see `measure`)
  Eigen::VectorX<Scalar> states = {};     ///< beside the mechanism
};

/// What the index-1 system gives at an absolute state.
template <class Scalar>
struct AbsoluteRates {
  Eigen::VectorX<Scalar> xdot;       ///< of (v_C, ω) body by body, 6 nb
  Eigen::VectorX<Scalar> g, g_rate;  ///< constraint violation g and G x + g_t, of joints, then of loops
  std::vector<std::vector<Scalar>>
      near;                       ///< scalar coordinates measured there, prescribed ones as prescribed
  Eigen::VectorX<Scalar> states;  ///< their rates
  Eigen::Index unknowns = 0;      ///< of the linear system: accelerations and multipliers
};

/// A mechanism with its parameters' values put in. Evaluations are const and independent of each other. Bodies
/// without mass are taken as they are: `rank` tells whether their accelerations are determined.
template <class Scalar>
class DescriptorReference {
 public:
  /// At the default values of the parameters. The mechanism must have passed `check_mechanism`.
  explicit DescriptorReference(const model::Mechanism& mechanism, const DescriptorOptions& options = {});
  /// At the given values, in the order of `Mechanism::parameters`; another number of them throws InternalError.
  DescriptorReference(const model::Mechanism& mechanism, std::span<const Scalar> parameters,
                      const DescriptorOptions& options = {});

  const model::CoordinateLayout& layout() const { return layout_; }

  /// Every body at time `t` (s), positions `y` and velocities `z`; quaternions in `y` are normalised. Sizes that do not
  /// fit throw InternalError.
  std::vector<AbsoluteBody<Scalar>> absolute_state(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                   const Eigen::VectorX<Scalar>& z) const;

  /// Accelerations and forces at that state with inputs `u` in the order of the layout. The state is one of
  /// the open tree; where it leaves the loops, they hold in accelerations all the same.
  DescriptorSolution<Scalar> solve(Scalar t, const Eigen::VectorX<Scalar>& y, const Eigen::VectorX<Scalar>& z,
                                   const Eigen::VectorX<Scalar>& u) const;

  /// What the states that are sampled are in the step of length `h` (s) that begins there, in their order.
  Eigen::VectorX<Scalar> sampled_states(Scalar t, const Eigen::VectorX<Scalar>& y,
                                        const Eigen::VectorX<Scalar>& z, const Eigen::VectorX<Scalar>& u,
                                        Scalar h) const;

  /// Constraints of the loops at that state.
  LoopConstraints<Scalar> loop_constraints(Scalar t, const Eigen::VectorX<Scalar>& y,
                                           const Eigen::VectorX<Scalar>& z) const;

  /// The same state in absolute coordinates.
  AbsoluteState<Scalar> absolute(Scalar t, const Eigen::VectorX<Scalar>& y,
                                 const Eigen::VectorX<Scalar>& z) const;

  /// Accelerations at an absolute state with inputs `u`.
  AbsoluteRates<Scalar> rates(const AbsoluteState<Scalar>& state, const Eigen::VectorX<Scalar>& u) const;

  /// The state brought back to the constraints: two Newton steps on the positions, then the velocities, each along
  /// M⁻¹ Gᵀ (the smallest change, weighted by mass). Redundant rows of loops are met in the least squares.
  AbsoluteState<Scalar> projected(AbsoluteState<Scalar> state) const;

 private:
  using Coordinates = std::vector<std::vector<descriptor::TimeJet<Scalar>>>;  // by joint
  struct System;

  /// What prescribed motions follow.
  struct Led {
    Scalar t;
    Eigen::VectorX<Scalar> states, inputs;  ///< inputs: empty where accelerations are not asked for
  };
  descriptor::TimeJet<Scalar> prescribed(const model::Expression& motion, const Led& led,
                                         int rates = 2) const;
  Coordinates coordinates_at(const Led& led, const Eigen::VectorX<Scalar>& y,
                             const Eigen::VectorX<Scalar>& z) const;
  Led led(Scalar t, const Eigen::VectorX<Scalar>& z, const Eigen::VectorX<Scalar>& u = {}) const {
    return {t, z.tail(Eigen::Index(layout_.state_count)), u};
  }
  descriptor::Pose<descriptor::TimeJet<Scalar>> body_pose(
      std::size_t joint, const descriptor::Pose<descriptor::TimeJet<Scalar>>& parent,
      const Coordinates& coordinates, const Eigen::VectorX<Scalar>& y, const Eigen::VectorX<Scalar>& z) const;
  Coordinates coordinates_near(const Led& led, const std::vector<std::vector<Scalar>>& near) const;
  Eigen::VectorX<Scalar> correction(const System& system, const Eigen::VectorX<Scalar>& violation) const;
  static Eigen::MatrixX<Scalar> index1_matrix(const System& system);
  System linearise(Scalar t, const std::vector<AbsoluteBody<Scalar>>& motions,
                   const Coordinates& coordinates) const;
  void add_joint_rows(const Coordinates& coordinates, System& system) const;
  void add_loop_rows(Scalar t, const Coordinates& coordinates, System& system) const;
  Eigen::MatrixX<Scalar> tree_velocities(Scalar t, const Eigen::VectorX<Scalar>& y,
                                         const Eigen::VectorX<Scalar>& z) const;
  descriptor::Scene<Scalar> scene_at(Scalar t, const Eigen::VectorX<Scalar>& u, const System& system,
                                     const Eigen::VectorX<Scalar>& states) const;
  Eigen::VectorX<Scalar> spin_damping(std::size_t joint,
                                      const std::vector<AbsoluteBody<Scalar>>& motions) const;
  void add_forces(const descriptor::Scene<Scalar>& scene, System& system) const;
  void add_inertia(System& system) const;
  DescriptorSolution<Scalar> solution(const System& system, const Eigen::MatrixX<Scalar>& X) const;
  JointWrench<Scalar> wrench_on_child(std::size_t joint, const System& system,
                                      const Eigen::VectorX<Scalar>& forces) const;
  static Eigen::VectorX<Scalar> with_least_loop_forces(const System& system, const Eigen::MatrixX<Scalar>& X,
                                                       const Eigen::VectorX<Scalar>& lambda);
  static void add_loops(const System& system, const Eigen::MatrixX<Scalar>& X,
                        const Eigen::VectorX<Scalar>& xdot, const Eigen::VectorX<Scalar>& lambda,
                        DescriptorSolution<Scalar>& result);
  void add_joint_forces(std::size_t joint, const System& system, const Eigen::VectorX<Scalar>& xdot,
                        const Eigen::VectorX<Scalar>& lambda, DescriptorSolution<Scalar>& result) const;
  void recover_velocity_rates(std::size_t joint, const System& system, const Eigen::VectorX<Scalar>& xdot,
                              DescriptorSolution<Scalar>& result) const;

  model::Mechanism mechanism_;
  model::CoordinateLayout layout_;
  DescriptorOptions options_;
  std::vector<Scalar> parameters_;
  std::vector<descriptor::Body<Scalar>> bodies_;
  std::vector<descriptor::Joint<Scalar>> joints_;  // as declared
  std::vector<descriptor::Frame<Scalar>> frames_;
  std::vector<descriptor::Loop<Scalar>> loops_;
  std::vector<Eigen::VectorX<Scalar>> rotor_inertias_;  // by joint and scalar coordinate
};

extern template class DescriptorReference<double>;
extern template class DescriptorReference<long double>;

}  // namespace jourdain::reference
