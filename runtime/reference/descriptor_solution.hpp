// Implementation of DescriptorReference: accelerations, forces and projection from the index-1 system. For
// descriptor.cpp only.
#pragma once

#include "reference/decompositions.hpp"
#include "reference/descriptor_system.hpp"

namespace jourdain::reference {

template <class Scalar>
JointWrench<Scalar> DescriptorReference<Scalar>::wrench_on_child(std::size_t joint, const System& system,
                                                                 const Eigen::VectorX<Scalar>& forces) const {
  const std::size_t child = joints_[joint].child;
  const Eigen::Index first = 6 * Eigen::Index(child);
  const Vector3<Scalar> inertial = forces.template segment<3>(first);
  const Vector3<Scalar> force = system.motions[child].orientation.conjugate() * inertial;
  return {.force = force, .moment = forces.template segment<3>(first + 3) + bodies_[child].p_BC.cross(force)};
}

template <class Scalar>
void DescriptorReference<Scalar>::add_joint_forces(std::size_t joint, const System& system,
                                                   const Eigen::VectorX<Scalar>& xdot,
                                                   const Eigen::VectorX<Scalar>& lambda,
                                                   DescriptorSolution<Scalar>& result) const {
  const JointRows<Scalar>& rows = system.joints[joint];
  const auto& coordinates = mechanism_.joints[joint].coordinates;
  const Eigen::Index first = system.first_row[joint];
  Eigen::Index last = first + rows.constraint_count;
  result.drives.emplace_back(coordinates.size());
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    if (coordinates[i].motion) result.drives[joint][i] = -lambda[last++];

  Eigen::VectorX<Scalar> transmitted = system.joint_forces[joint];
  for (Eigen::Index row = first; row < last; ++row)
    transmitted -= lambda[row] * system.G.row(row).transpose();
  result.reactions.push_back(wrench_on_child(joint, system, transmitted));

  Eigen::VectorX<Scalar> rotors = Eigen::VectorX<Scalar>::Zero(xdot.size());
  for (Eigen::Index i = 0; i < rotor_inertias_[joint].size(); ++i) {
    const Eigen::VectorX<Scalar> c = gradient(rows, i);
    const Scalar acceleration = c.dot(xdot) + rows.gamma[rows.constraint_count + i];
    rotors -= rotor_inertias_[joint][i] * acceleration * c;
  }
  result.rotor_wrenches.push_back(wrench_on_child(joint, system, rotors));
}

/// Joint by joint from the two bodies' accelerations: scalar coordinates by their rows, θ̈ = c ẋ + γ_θ; the spin ω_C −
/// R_CP ω_P of a spherical joint by differentiating it in the child; a free joint's v and ω are the child's own.
template <class Scalar>
void DescriptorReference<Scalar>::recover_velocity_rates(std::size_t joint, const System& system,
                                                         const Eigen::VectorX<Scalar>& xdot,
                                                         DescriptorSolution<Scalar>& result) const {
  const model::JointEntries& entries = layout_.joints[joint];
  const JointRows<Scalar>& rows = system.joints[joint];
  for (std::size_t i = 0; i < entries.velocity.size(); ++i) {
    if (!entries.velocity[i]) continue;
    const Eigen::Index row = rows.constraint_count + Eigen::Index(i);
    result.zdot[Eigen::Index(*entries.velocity[i])] = rows.jacobian.row(row).dot(xdot) + rows.gamma[row];
  }
  const auto first = Eigen::Index(entries.first_velocity);
  const BodyAcceleration<Scalar>& child = result.bodies[joints_[joint].child];
  if (joints_[joint].type == model::JointType::kFree) {
    result.zdot.template segment<3>(first) = child.a_O;
    result.zdot.template segment<3>(first + 3) = child.omega_dot;
  }
  if (joints_[joint].type != model::JointType::kSpherical) return;
  result.zdot.template segment<3>(first) = child.omega_dot;
  if (!joints_[joint].parent) return;
  const std::size_t parent = *joints_[joint].parent;
  const AbsoluteBody<Scalar>& motion = system.motions[joints_[joint].child];
  const Matrix3<Scalar> R_CP =
      (motion.orientation.conjugate() * system.motions[parent].orientation).toRotationMatrix();
  const Vector3<Scalar> carried = R_CP * system.motions[parent].omega;
  const Vector3<Scalar> spin = motion.omega - carried;
  result.zdot.template segment<3>(first) -= R_CP * result.bodies[parent].omega_dot - spin.cross(carried);
}

template <class Scalar>
Eigen::MatrixX<Scalar> DescriptorReference<Scalar>::index1_matrix(const System& system) {
  const Eigen::MatrixX<Scalar> G = system.as_solved(system.G);
  const Eigen::Index nx = system.M.rows(), constraints = G.rows();
  Eigen::MatrixX<Scalar> matrix = Eigen::MatrixX<Scalar>::Zero(nx + constraints, nx + constraints);
  matrix.topLeftCorner(nx, nx) = system.M;
  matrix.topRightCorner(nx, constraints) = G.transpose();
  matrix.bottomLeftCorner(constraints, nx) = G;
  return matrix;
}

/// The multipliers of least norm among those of the loops that give the open tree the same forces, and those of the
/// joints that go with them: Gᵀ λ stays what it is.
template <class Scalar>
Eigen::VectorX<Scalar> DescriptorReference<Scalar>::with_least_loop_forces(
    const System& system, const Eigen::MatrixX<Scalar>& X, const Eigen::VectorX<Scalar>& lambda) {
  using Matrix = Eigen::MatrixX<Scalar>;
  const Eigen::Index joints = system.joint_row_count(), loops = system.loop_row_count;
  const Eigen::Index rank = system.solved->rows() - joints;
  const Matrix of_joints = system.G.topRows(joints), of_loops = system.G.bottomRows(loops);
  const Matrix kept = left_singular_vectors<Scalar>(of_loops * X).leftCols(rank);
  Eigen::VectorX<Scalar> least = lambda;
  least.tail(loops) = kept * (kept.transpose() * lambda.tail(loops));
  const Eigen::VectorX<Scalar> moved = of_loops.transpose() * (lambda.tail(loops) - least.tail(loops));
  least.head(joints) += least_squares<Scalar>(of_joints.transpose(), moved);
  return least;
}

/// What holds of the loops in the velocities z of the open tree, x = X z + x̄. As the joints' constraint
/// forces do no work along X, what the bodies' momentum balance lacks along it is the loops' share.
template <class Scalar>
void DescriptorReference<Scalar>::add_loops(const System& system, const Eigen::MatrixX<Scalar>& X,
                                            const Eigen::VectorX<Scalar>& xdot,
                                            const Eigen::VectorX<Scalar>& lambda,
                                            DescriptorSolution<Scalar>& result) {
  const Eigen::Index count = system.loop_row_count;
  const Eigen::MatrixX<Scalar> G = system.G.bottomRows(count);
  result.loops = {G * X, system.g.tail(count), system.g_rate.tail(count)};
  const Eigen::VectorX<Scalar> convective = xdot - X * result.zdot;
  result.loop_gamma = G * convective + system.gamma.tail(count);
  result.loop_lambda = lambda.tail(count);
  result.loop_forces = X.transpose() * (system.forces - system.M * xdot);
  result.loop_rank = (system.solved ? system.solved->rows() : system.G.rows()) - system.joint_row_count();
}

template <class Scalar>
DescriptorSolution<Scalar> DescriptorReference<Scalar>::solution(const System& system,
                                                                 const Eigen::MatrixX<Scalar>& X) const {
  const Eigen::Index nx = system.M.rows();
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right(matrix.rows());
  right << system.forces, -system.as_solved(system.gamma);
  const PivotedSolution<Scalar> unknowns = solved_by_full_lu<Scalar>(matrix, right);
  const Eigen::VectorX<Scalar> xdot = unknowns.x.head(nx);
  Eigen::VectorX<Scalar> lambda = unknowns.x.tail(matrix.rows() - nx);
  if (system.solved) lambda = with_least_loop_forces(system, X, system.solved->transpose() * lambda);

  DescriptorSolution<Scalar> result;
  result.zdot.resize(Eigen::Index(layout_.velocity_count()));
  result.zdot.tail(system.state_rates.size()) = system.state_rates;
  result.g = system.g.head(system.joint_row_count());
  result.g_rate = system.g_rate.head(system.joint_row_count());
  result.size = nx + system.G.rows();
  result.rank = unknowns.rank;
  result.reciprocal_condition = unknowns.reciprocal_condition;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Vector3<Scalar> a_C = xdot.template segment<3>(6 * Eigen::Index(b));
    const Vector3<Scalar> omega_dot = xdot.template segment<3>(6 * Eigen::Index(b) + 3);
    const Vector3<Scalar>& omega = system.motions[b].omega;
    const Vector3<Scalar> arm = -bodies_[b].p_BC;
    const Vector3<Scalar> relative = omega_dot.cross(arm) + omega.cross(omega.cross(arm));
    result.bodies.push_back({a_C + system.motions[b].orientation * relative, a_C, omega_dot});
  }
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    add_joint_forces(j, system, xdot, lambda, result);
    recover_velocity_rates(j, system, xdot, result);
  }
  add_loops(system, X, xdot, lambda, result);
  return result;
}

template <class Scalar>
DescriptorSolution<Scalar> DescriptorReference<Scalar>::solve(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                              const Eigen::VectorX<Scalar>& z,
                                                              const Eigen::VectorX<Scalar>& u) const {
  System system = linearise(t, absolute_state(t, y, z), coordinates_at(led(t, z, u), y, z));
  add_forces(scene_at(t, u, system, z.tail(Eigen::Index(layout_.state_count))), system);
  add_inertia(system);
  return solution(system, tree_velocities(t, y, z));
}

template <class Scalar>
Eigen::VectorX<Scalar> DescriptorReference<Scalar>::sampled_states(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                                   const Eigen::VectorX<Scalar>& z,
                                                                   const Eigen::VectorX<Scalar>& u,
                                                                   Scalar h) const {
  const System system = linearise(t, absolute_state(t, y, z), coordinates_at(led(t, z, u), y, z));
  descriptor::Scene<Scalar> scene = scene_at(t, u, system, z.tail(Eigen::Index(layout_.state_count)));
  scene.h = h;
  return descriptor::sampled_states(mechanism_, scene);
}

template <class Scalar>
LoopConstraints<Scalar> DescriptorReference<Scalar>::loop_constraints(Scalar t,
                                                                      const Eigen::VectorX<Scalar>& y,
                                                                      const Eigen::VectorX<Scalar>& z) const {
  const System system = linearise(t, absolute_state(t, y, z), coordinates_at(led(t, z), y, z));
  const Eigen::Index count = system.loop_row_count;
  return {system.G.bottomRows(count) * tree_velocities(t, y, z), system.g.tail(count),
          system.g_rate.tail(count)};
}

template <class Scalar>
AbsoluteRates<Scalar> DescriptorReference<Scalar>::rates(const AbsoluteState<Scalar>& state,
                                                         const Eigen::VectorX<Scalar>& u) const {
  System system = linearise(state.t, state.bodies, coordinates_near({state.t, state.states, u}, state.near));
  const descriptor::Scene<Scalar> scene = scene_at(state.t, u, system, state.states);
  add_forces(scene, system);
  add_inertia(system);
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right(matrix.rows());
  right << system.forces, -system.as_solved(system.gamma);
  const Eigen::VectorX<Scalar> unknowns = solved_by_lu<Scalar>(matrix, right);
  return {unknowns.head(system.M.rows()),
          system.g,
          system.g_rate,
          scene.position,
          system.state_rates,
          matrix.rows()};
}

/// Change of x that moves the constraints' linearisation by −violation.
template <class Scalar>
Eigen::VectorX<Scalar> DescriptorReference<Scalar>::correction(
    const System& system, const Eigen::VectorX<Scalar>& violation) const {
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right = Eigen::VectorX<Scalar>::Zero(matrix.rows());
  right.tail(matrix.rows() - system.M.rows()) = -system.as_solved(violation);
  return solved_by_lu<Scalar>(matrix, right).head(system.M.rows());
}

template <class Scalar>
AbsoluteState<Scalar> DescriptorReference<Scalar>::projected(AbsoluteState<Scalar> state) const {
  constexpr int kNewtonSteps = 2;
  const auto at_state = [&] {
    System system =
        linearise(state.t, state.bodies, coordinates_near({state.t, state.states, {}}, state.near));
    system.forces = Eigen::VectorX<Scalar>::Zero(6 * Eigen::Index(bodies_.size()));
    add_inertia(system);
    return system;
  };
  for (int i = 0; i < kNewtonSteps; ++i) {
    const System system = at_state();
    const Eigen::VectorX<Scalar> change = correction(system, system.g);
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      AbsoluteBody<Scalar>& body = state.bodies[b];
      const Vector3<Scalar> turn = change.template segment<3>(6 * Eigen::Index(b) + 3) / 2;
      body.p_WC += change.template segment<3>(6 * Eigen::Index(b));
      body.orientation =
          (body.orientation * Eigen::Quaternion<Scalar>(1, turn.x(), turn.y(), turn.z())).normalized();
    }
  }
  const System system = at_state();
  const Eigen::VectorX<Scalar> change = correction(system, system.g_rate);
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    state.bodies[b].v_C += change.template segment<3>(6 * Eigen::Index(b));
    state.bodies[b].omega += change.template segment<3>(6 * Eigen::Index(b) + 3);
  }
  return state;
}

}  // namespace jourdain::reference
