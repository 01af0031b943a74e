#include "reference/descriptor.hpp"

#include <tuple>

#include "support/check.hpp"

namespace jourdain::reference {

namespace {

using descriptor::JointRows;

template <class Scalar>
std::vector<Scalar> parameter_defaults(const model::Mechanism& mechanism) {
  std::vector<Scalar> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(Scalar(parameter.value));
  return values;
}

template <class Scalar>
Eigen::Index coordinate_count(const JointRows<Scalar>& rows) {
  return rows.jacobian.rows() - rows.constraint_count;
}

/// Gradient c of a scalar coordinate: θ̇ = c x. Shape 6 nb.
template <class Scalar>
Eigen::VectorX<Scalar> gradient(const JointRows<Scalar>& rows, Eigen::Index coordinate) {
  return rows.jacobian.row(rows.constraint_count + coordinate).transpose();
}

}  // namespace

/// The index-1 system at one state. Constraint rows are ordered joint by joint, constraints before prescribed
/// coordinates.
template <class Scalar>
struct DescriptorReference<Scalar>::System {
  std::vector<AbsoluteBody<Scalar>> motions;
  std::vector<JointRows<Scalar>> joints;
  std::vector<Eigen::Index> first_row;               ///< of each joint's constraints in G
  Eigen::MatrixX<Scalar> G;                          ///< rows × 6 nb
  Eigen::VectorX<Scalar> g, g_rate, gamma;           ///< g, G x + g_t, γ
  Eigen::MatrixX<Scalar> M;                          ///< 6 nb × 6 nb, with rotors
  Eigen::VectorX<Scalar> forces;                     ///< right-hand side of M ẋ + Gᵀ λ, 6 nb
  std::vector<Eigen::VectorX<Scalar>> joint_forces;  ///< by joint, its share Cᵀ Q of `forces`, 6 nb
};

template <class Scalar>
DescriptorReference<Scalar>::DescriptorReference(const model::Mechanism& mechanism,
                                                 const DescriptorOptions& options)
    : DescriptorReference(mechanism, parameter_defaults<Scalar>(mechanism), options) {}

template <class Scalar>
DescriptorReference<Scalar>::DescriptorReference(const model::Mechanism& mechanism,
                                                 std::span<const Scalar> parameters,
                                                 const DescriptorOptions& options)
    : mechanism_(mechanism),
      layout_(model::lay_out_coordinates(mechanism)),
      options_(options),
      parameters_(parameters.begin(), parameters.end()),
      rotor_inertias_(descriptor::rotor_inertias(mechanism, parameters)) {
  JD_CHECK(parameters.size() == mechanism.parameters.size(), "{} values for {} parameters", parameters.size(),
           mechanism.parameters.size());
  const bool snap = options.snap && mechanism.snap;
  for (const auto& body : mechanism.bodies) bodies_.push_back(descriptor::read_body(body, parameters, snap));
  for (const auto& joint : mechanism.joints)
    joints_.push_back(descriptor::read_joint(joint, parameters, snap));
  for (const auto& frame : mechanism.frames)
    frames_.push_back(descriptor::read_frame(frame, parameters, snap));
}

template <class Scalar>
typename DescriptorReference<Scalar>::System DescriptorReference<Scalar>::linearise(
    const std::vector<AbsoluteBody<Scalar>>& motions, const Coordinates& coordinates) const {
  System system;
  system.motions = motions;
  std::vector<Eigen::RowVectorX<Scalar>> G;
  std::vector<Scalar> g, g_rate, gamma;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    std::vector<Scalar> near;
    for (const auto& coordinate : coordinates[j]) near.push_back(coordinate.value);
    system.joints.push_back(descriptor::joint_rows(joints_[j], bodies_, motions,
                                                   std::span<const Scalar>(near), options_.parallel_axes));
    const JointRows<Scalar>& rows = system.joints.back();
    system.first_row.push_back(Eigen::Index(G.size()));
    const auto add = [&](Eigen::Index row, const descriptor::TimeJet<Scalar>& target) {
      G.push_back(rows.jacobian.row(row));
      g.push_back(rows.value[row] - target.value);
      g_rate.push_back(rows.rate[row] - target.rate);
      gamma.push_back(rows.gamma[row] - target.acceleration);
    };
    for (Eigen::Index row = 0; row < rows.constraint_count; ++row) add(row, {});
    for (std::size_t i = 0; i < coordinates[j].size(); ++i)
      if (mechanism_.joints[j].coordinates[i].motion)
        add(rows.constraint_count + Eigen::Index(i), coordinates[j][i]);
  }
  const auto count = Eigen::Index(G.size());
  system.G.resize(count, 6 * Eigen::Index(bodies_.size()));
  for (Eigen::Index row = 0; row < count; ++row) system.G.row(row) = G[std::size_t(row)];
  system.g = Eigen::Map<Eigen::VectorX<Scalar>>(g.data(), count);
  system.g_rate = Eigen::Map<Eigen::VectorX<Scalar>>(g_rate.data(), count);
  system.gamma = Eigen::Map<Eigen::VectorX<Scalar>>(gamma.data(), count);
  return system;
}

template <class Scalar>
descriptor::Scene<Scalar> DescriptorReference<Scalar>::scene_at(Scalar t, const Eigen::VectorX<Scalar>& u,
                                                                const System& system) const {
  JD_CHECK(std::size_t(u.size()) == layout_.input_count(), "{} values for {} inputs", u.size(),
           layout_.input_count());
  descriptor::Scene<Scalar> scene{.t = t,
                                  .parameters = parameters_,
                                  .inputs = {u.begin(), u.end()},
                                  .position = {},
                                  .rate = {},
                                  .frames = descriptor::frame_motions(frames_, bodies_, system.motions)};
  for (const JointRows<Scalar>& rows : system.joints) {
    const auto position = rows.value.tail(coordinate_count(rows));
    const auto rate = rows.rate.tail(coordinate_count(rows));
    scene.position.emplace_back(position.begin(), position.end());
    scene.rate.emplace_back(rate.begin(), rate.end());
  }
  return scene;
}

/// Moments of a spherical joint's spin damping on its two bodies; shape 6 nb.
template <class Scalar>
Eigen::VectorX<Scalar> DescriptorReference<Scalar>::spin_damping(
    std::size_t joint, const std::vector<AbsoluteBody<Scalar>>& motions) const {
  Eigen::VectorX<Scalar> forces = Eigen::VectorX<Scalar>::Zero(6 * Eigen::Index(bodies_.size()));
  const auto& [type, parent, child] =
      std::tie(joints_[joint].type, joints_[joint].parent, joints_[joint].child);
  if (type != model::JointType::kSpherical) return forces;
  const Scalar damping = mechanism_.joints[joint].spin_damping.evaluate(std::span<const Scalar>(parameters_));
  const auto inertial_spin = [&](std::size_t body) -> Vector3<Scalar> {
    return motions[body].orientation * motions[body].omega;
  };
  Vector3<Scalar> moment = -damping * inertial_spin(child);
  if (parent) moment += damping * inertial_spin(*parent);
  const auto add = [&](std::size_t body, const Vector3<Scalar>& inertial) {
    forces.template segment<3>(6 * Eigen::Index(body) + 3) +=
        motions[body].orientation.conjugate() * inertial;
  };
  add(child, moment);
  if (parent) add(*parent, -moment);
  return forces;
}

template <class Scalar>
void DescriptorReference<Scalar>::add_forces(const descriptor::Scene<Scalar>& scene, System& system) const {
  system.forces = descriptor::body_forces(mechanism_, scene, frames_, bodies_, system.motions);
  const std::vector<Eigen::VectorX<Scalar>> Q = descriptor::coordinate_forces(mechanism_, scene);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Eigen::VectorX<Scalar> share = spin_damping(j, system.motions);
    for (Eigen::Index i = 0; i < Q[j].size(); ++i) share += Q[j][i] * gradient(system.joints[j], i);
    system.forces += share;
    system.joint_forces.push_back(share);
  }
}

template <class Scalar>
void DescriptorReference<Scalar>::add_inertia(System& system) const {
  const auto size = 6 * Eigen::Index(bodies_.size());
  system.M = Eigen::MatrixX<Scalar>::Zero(size, size);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const Eigen::Index first = 6 * Eigen::Index(b);
    const Matrix3<Scalar>& I = bodies_[b].I_C;
    const Vector3<Scalar>& omega = system.motions[b].omega;
    system.M.template block<3, 3>(first, first).diagonal().setConstant(bodies_[b].mass);
    system.M.template block<3, 3>(first + 3, first + 3) = I;
    system.forces.template segment<3>(first + 3) -= omega.cross(I * omega);
  }
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (Eigen::Index i = 0; i < rotor_inertias_[j].size(); ++i) {
      const JointRows<Scalar>& rows = system.joints[j];
      const Eigen::VectorX<Scalar> c = gradient(rows, i);
      system.M += rotor_inertias_[j][i] * c * c.transpose();
      system.forces -= rotor_inertias_[j][i] * rows.gamma[rows.constraint_count + i] * c;
    }
}

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
  const Eigen::Index nx = system.M.rows(), constraints = system.G.rows();
  Eigen::MatrixX<Scalar> matrix = Eigen::MatrixX<Scalar>::Zero(nx + constraints, nx + constraints);
  matrix.topLeftCorner(nx, nx) = system.M;
  matrix.topRightCorner(nx, constraints) = system.G.transpose();
  matrix.bottomLeftCorner(constraints, nx) = system.G;
  return matrix;
}

template <class Scalar>
DescriptorSolution<Scalar> DescriptorReference<Scalar>::solution(const System& system) const {
  const Eigen::Index nx = system.M.rows(), constraints = system.G.rows();
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right(nx + constraints);
  right << system.forces, -system.gamma;
  const Eigen::FullPivLU<Eigen::MatrixX<Scalar>> factors(matrix);
  const Eigen::VectorX<Scalar> unknowns = factors.solve(right);
  const Eigen::VectorX<Scalar> xdot = unknowns.head(nx), lambda = unknowns.tail(constraints);

  DescriptorSolution<Scalar> result;
  result.zdot.resize(Eigen::Index(layout_.velocity_count()));
  result.g = system.g;
  result.g_rate = system.g_rate;
  result.size = matrix.rows();
  result.rank = factors.rank();
  result.reciprocal_condition = factors.rcond();
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
  return result;
}

template <class Scalar>
DescriptorSolution<Scalar> DescriptorReference<Scalar>::solve(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                              const Eigen::VectorX<Scalar>& z,
                                                              const Eigen::VectorX<Scalar>& u) const {
  System system = linearise(absolute_state(t, y, z), coordinates_at(t, y, z));
  add_forces(scene_at(t, u, system), system);
  add_inertia(system);
  return solution(system);
}

template <class Scalar>
AbsoluteRates<Scalar> DescriptorReference<Scalar>::rates(const AbsoluteState<Scalar>& state,
                                                         const Eigen::VectorX<Scalar>& u) const {
  System system = linearise(state.bodies, coordinates_near(state.t, state.near));
  const descriptor::Scene<Scalar> scene = scene_at(state.t, u, system);
  add_forces(scene, system);
  add_inertia(system);
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right(matrix.rows());
  right << system.forces, -system.gamma;
  const Eigen::VectorX<Scalar> unknowns = matrix.partialPivLu().solve(right);
  return {unknowns.head(system.M.rows()), system.g, system.g_rate, scene.position, matrix.rows()};
}

/// Change of x that moves the constraints' linearisation by −violation.
template <class Scalar>
Eigen::VectorX<Scalar> DescriptorReference<Scalar>::correction(
    const System& system, const Eigen::VectorX<Scalar>& violation) const {
  const Eigen::MatrixX<Scalar> matrix = index1_matrix(system);
  Eigen::VectorX<Scalar> right = Eigen::VectorX<Scalar>::Zero(matrix.rows());
  right.tail(violation.size()) = -violation;
  return matrix.partialPivLu().solve(right).head(system.M.rows());
}

template <class Scalar>
AbsoluteState<Scalar> DescriptorReference<Scalar>::projected(AbsoluteState<Scalar> state) const {
  constexpr int kNewtonSteps = 2;
  const auto at_state = [&] {
    System system = linearise(state.bodies, coordinates_near(state.t, state.near));
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

template class DescriptorReference<double>;
template class DescriptorReference<long double>;

}  // namespace jourdain::reference
