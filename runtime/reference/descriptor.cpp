#include "reference/descriptor.hpp"

#include <tuple>

#include "reference/descriptor_solution.hpp"
#include "support/check.hpp"

namespace jourdain::reference {

namespace {

template <class Scalar>
std::vector<Scalar> parameter_defaults(const model::Mechanism& mechanism) {
  std::vector<Scalar> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(Scalar(parameter.value));
  return values;
}

}  // namespace

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
  const bool snap = mechanism.snap;
  for (const auto& body : mechanism.bodies) bodies_.push_back(descriptor::read_body(body, parameters, snap));
  for (const auto& joint : mechanism.joints)
    joints_.push_back(descriptor::read_joint(joint, parameters, snap));
  for (const auto& frame : mechanism.frames)
    frames_.push_back(descriptor::read_frame(frame, parameters, snap));
  loops_ = descriptor::read_loops<Scalar>(mechanism);
}

template <class Scalar>
void DescriptorReference<Scalar>::add_joint_rows(const Coordinates& coordinates, System& system) const {
  std::vector<Eigen::RowVectorX<Scalar>> G;
  std::vector<Scalar> g, g_rate, gamma;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    std::vector<Scalar> near;
    for (const auto& coordinate : coordinates[j]) near.push_back(coordinate.value);
    system.joints.push_back(descriptor::joint_rows(joints_[j], bodies_, system.motions,
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
}

template <class Scalar>
void DescriptorReference<Scalar>::add_loop_rows(Scalar t, const Coordinates& coordinates,
                                                System& system) const {
  std::vector<std::vector<Scalar>> near(joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (const auto& coordinate : coordinates[j]) near[j].push_back(coordinate.value);
  const descriptor::Parts<Scalar> parts{bodies_, joints_, frames_, loops_, parameters_};
  const descriptor::LoopRows<Scalar> rows = descriptor::loop_rows(parts, t, system.motions, near);
  const Eigen::MatrixX<Scalar> independent =
      descriptor::independent_combinations(system.G, rows.jacobian, options_.dependent);

  const Eigen::Index before = system.G.rows(), count = rows.value.size();
  const auto extend = [&](Eigen::VectorX<Scalar>& column, const Eigen::VectorX<Scalar>& more) {
    column.conservativeResize(before + count);
    column.tail(count) = more;
  };
  system.loop_row_count = count;
  system.G.conservativeResize(before + count, Eigen::NoChange);
  system.G.bottomRows(count) = rows.jacobian;
  extend(system.g, rows.value);
  extend(system.g_rate, rows.rate);
  extend(system.gamma, rows.gamma);
  if (independent.rows() == count) return;
  system.solved = Eigen::MatrixX<Scalar>::Identity(before + independent.rows(), before + count);
  system.solved->bottomRightCorner(independent.rows(), count) = independent;
}

template <class Scalar>
typename DescriptorReference<Scalar>::System DescriptorReference<Scalar>::linearise(
    Scalar t, const std::vector<AbsoluteBody<Scalar>>& motions, const Coordinates& coordinates) const {
  System system;
  system.motions = motions;
  add_joint_rows(coordinates, system);
  if (!loops_.empty()) add_loop_rows(t, coordinates, system);
  return system;
}

template <class Scalar>
descriptor::Scene<Scalar> DescriptorReference<Scalar>::scene_at(Scalar t, const Eigen::VectorX<Scalar>& u,
                                                                const System& system,
                                                                const Eigen::VectorX<Scalar>& states) const {
  JD_CHECK(std::size_t(u.size()) == layout_.input_count(), "{} values for {} inputs", u.size(),
           layout_.input_count());
  descriptor::Scene<Scalar> scene{.t = t,
                                  .parameters = parameters_,
                                  .inputs = {u.begin(), u.end()},
                                  .position = {},
                                  .rate = {},
                                  .frames = descriptor::frame_motions(frames_, bodies_, system.motions),
                                  .states = {states.begin(), states.end()}};
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
  system.state_rates = descriptor::state_rates(mechanism_, scene);
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

template class DescriptorReference<JOURDAIN_SCALAR>;

}  // namespace jourdain::reference
