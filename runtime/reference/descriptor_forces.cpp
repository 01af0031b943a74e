#include "reference/descriptor_forces.hpp"

#include <cmath>

#include "reference/descriptor_bushing.hpp"
#include "reference/descriptor_elements.hpp"

namespace jourdain::reference::descriptor {

namespace {

/// Adds forces at points of bodies into their six rows each.
template <class Scalar>
class BodyForces {
 public:
  BodyForces(const std::vector<Body<Scalar>>& bodies, const std::vector<AbsoluteBody<Scalar>>& motions)
      : bodies_(bodies),
        motions_(motions),
        rows_(Eigen::VectorX<Scalar>::Zero(6 * Eigen::Index(bodies.size()))) {}

  void add_weight(const Vector3<Scalar>& gravity) {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      rows_.template segment<3>(6 * Eigen::Index(i)) += bodies_[i].mass * gravity;
  }

  /// Force and moment (inertial components) at the origin of `frame`; nothing moves if it is the world's.
  void add(const Frame<Scalar>& frame, const Vector3<Scalar>& force, const Vector3<Scalar>& moment) {
    if (!frame.body) return;
    const std::size_t i = *frame.body;
    const Matrix3<Scalar> R_BW = motions_[i].orientation.toRotationMatrix().transpose();
    const Vector3<Scalar> arm = frame.p_BF - bodies_[i].p_BC;
    rows_.template segment<3>(6 * Eigen::Index(i)) += force;
    rows_.template segment<3>(6 * Eigen::Index(i) + 3) += R_BW * moment + arm.cross(R_BW * force);
  }

  const Eigen::VectorX<Scalar>& rows() const { return rows_; }

 private:
  const std::vector<Body<Scalar>>& bodies_;
  const std::vector<AbsoluteBody<Scalar>>& motions_;
  Eigen::VectorX<Scalar> rows_;
};

/// −stiffness (y − rest) − damping z − friction z/√(z² + friction_speed²)
template <class Scalar>
Scalar passive_force(const model::Coordinate& coordinate, Scalar y, Scalar z, const Scene<Scalar>& scene) {
  using std::sqrt;
  Scalar force = -value(coordinate.stiffness, scene) * (y - value(coordinate.rest, scene)) -
                 value(coordinate.damping, scene) * z;
  if (coordinate.friction.is_zero()) return force;
  const Scalar speed = value(coordinate.friction_speed, scene);
  return force - value(coordinate.friction, scene) * z / sqrt(z * z + speed * speed);
}

}  // namespace

template <class Scalar>
Body<Scalar> read_body(const model::Body& body, std::span<const Scalar> parameters, bool snap) {
  const auto number = [&](const model::Expression& expression) { return expression.evaluate(parameters); };
  const Scalar xy = number(body.inertia.xy), xz = number(body.inertia.xz), yz = number(body.inertia.yz);
  Matrix3<Scalar> tensor;
  tensor << number(body.inertia.xx), xy, xz, xy, number(body.inertia.yy), yz, xz, yz, number(body.inertia.zz);
  const Matrix3<Scalar> R_BI = rotation_value(body.inertia_axes, parameters, snap);
  Body<Scalar> result{.mass = number(body.mass),
                      .p_BC = vector_value(body.center_of_mass, parameters),
                      .I_C = R_BI * tensor * R_BI.transpose()};
  if (body.inertia_point == model::InertiaPoint::kOrigin) {
    const Vector3<Scalar>& c = result.p_BC;
    result.I_C -= result.mass * (c.dot(c) * Matrix3<Scalar>::Identity() - c * c.transpose());
  }
  return result;
}

template <class Scalar>
Frame<Scalar> read_frame(const model::Frame& frame, std::span<const Scalar> parameters, bool snap) {
  Frame<Scalar> result{.body = {},
                       .R_BF = rotation_value(frame.placement.rotation, parameters, snap),
                       .p_BF = vector_value(frame.placement.position, parameters)};
  if (frame.body) result.body = frame.body->value;
  return result;
}

template <class Scalar>
std::vector<FrameMotion<Scalar>> frame_motions(const std::vector<Frame<Scalar>>& frames,
                                               const std::vector<Body<Scalar>>& bodies,
                                               const std::vector<AbsoluteBody<Scalar>>& motions) {
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  std::vector<FrameMotion<Scalar>> result;
  for (const Frame<Scalar>& frame : frames) {
    if (!frame.body) {
      result.push_back({frame.R_BF, frame.p_BF, zero, zero});
      continue;
    }
    const AbsoluteBody<Scalar>& motion = motions[*frame.body];
    const Matrix3<Scalar> R_WB = motion.orientation.toRotationMatrix();
    const Vector3<Scalar> arm = frame.p_BF - bodies[*frame.body].p_BC;
    result.push_back({R_WB * frame.R_BF, motion.p_WC + R_WB * arm,
                      motion.v_C + R_WB * motion.omega.cross(arm), frame.R_BF.transpose() * motion.omega});
  }
  return result;
}

template <class Scalar>
Eigen::VectorX<Scalar> body_forces(const model::Mechanism& mechanism, const Scene<Scalar>& scene,
                                   const std::vector<Frame<Scalar>>& frames,
                                   const std::vector<Body<Scalar>>& bodies,
                                   const std::vector<AbsoluteBody<Scalar>>& motions) {
  BodyForces<Scalar> sum(bodies, motions);
  sum.add_weight(value(mechanism.gravity, scene));
  for_each_force_element(mechanism, [&](const auto& element) {
    const Effect<Scalar> effect = descriptor::effect(element, mechanism, scene);
    for (const auto& [frame, force, moment] : effect.at_frames) sum.add(frames[frame.value], force, moment);
  });
  return sum.rows();
}

template <class Scalar>
std::vector<Eigen::VectorX<Scalar>> coordinate_forces(const model::Mechanism& mechanism,
                                                      const Scene<Scalar>& scene) {
  std::vector<Eigen::VectorX<Scalar>> forces;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    const auto& coordinates = mechanism.joints[j].coordinates;
    forces.emplace_back(Eigen::Index(coordinates.size()));
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      forces[j][Eigen::Index(i)] =
          passive_force(coordinates[i], scene.position[j][i], scene.rate[j][i], scene);
  }
  for_each_force_element(mechanism, [&](const auto& element) {
    const Effect<Scalar> effect = descriptor::effect(element, mechanism, scene);
    for (const auto& [at, force] : effect.on_coordinates)
      forces[at.joint.value][Eigen::Index(at.coordinate)] += force;
  });
  return forces;
}

template <class Scalar>
Eigen::VectorX<Scalar> state_rates(const model::Mechanism& mechanism, const Scene<Scalar>& scene) {
  Eigen::VectorX<Scalar> rates(Eigen::Index(mechanism.states.size()));
  for (Eigen::Index i = 0; i < rates.size(); ++i)
    rates[i] = value(mechanism.states[std::size_t(i)].rate, scene);
  return rates;
}

template <class Scalar>
Eigen::VectorX<Scalar> sampled_states(const model::Mechanism& mechanism, const Scene<Scalar>& scene) {
  std::vector<Scalar> values;
  for (const model::StateVariable& state : mechanism.states)
    if (state.sampled) values.push_back(value(*state.sampled, scene));
  return Eigen::Map<const Eigen::VectorX<Scalar>>(values.data(), Eigen::Index(values.size()));
}

template <class Scalar>
std::vector<Eigen::VectorX<Scalar>> rotor_inertias(const model::Mechanism& mechanism,
                                                   std::span<const Scalar> parameters) {
  std::vector<Eigen::VectorX<Scalar>> inertias;
  for (const model::Joint& joint : mechanism.joints)
    inertias.push_back(Eigen::VectorX<Scalar>::Zero(Eigen::Index(joint.coordinates.size())));
  for (const model::Actuator& actuator : mechanism.actuators) {
    const Scalar gear = actuator.gear_ratio.evaluate(parameters);
    inertias[actuator.joint.value][Eigen::Index(actuator.coordinate)] +=
        gear * gear * actuator.rotor_inertia.evaluate(parameters);
  }
  return inertias;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                                        \
  template Body<S> read_body(const model::Body&, std::span<const S>, bool);                            \
  template Frame<S> read_frame(const model::Frame&, std::span<const S>, bool);                         \
  template std::vector<FrameMotion<S>> frame_motions(                                                  \
      const std::vector<Frame<S>>&, const std::vector<Body<S>>&, const std::vector<AbsoluteBody<S>>&); \
  template Eigen::VectorX<S> body_forces(const model::Mechanism&, const Scene<S>&,                     \
                                         const std::vector<Frame<S>>&, const std::vector<Body<S>>&,    \
                                         const std::vector<AbsoluteBody<S>>&);                         \
  template std::vector<Eigen::VectorX<S>> coordinate_forces(const model::Mechanism&, const Scene<S>&); \
  template Eigen::VectorX<S> state_rates(const model::Mechanism&, const Scene<S>&);                    \
  template Eigen::VectorX<S> sampled_states(const model::Mechanism&, const Scene<S>&);                 \
  template std::vector<Eigen::VectorX<S>> rotor_inertias(const model::Mechanism&, std::span<const S>);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference::descriptor
