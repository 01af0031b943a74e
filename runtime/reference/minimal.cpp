#include "reference/minimal.hpp"

#include <algorithm>
#include <numbers>

#include "reference/minimal_bushing.hpp"
#include "reference/minimal_elements.hpp"
#include "reference/minimal_forces.hpp"
#include "reference/minimal_kinematics.hpp"
#include "reference/minimal_motion.hpp"
#include "reference/minimal_outputs.hpp"
#include "support/check.hpp"

namespace jourdain::reference {

namespace {

/// m (|c|² 1 − c cᵀ): what a point mass at `c` has about the origin.
template <class Scalar>
Matrix3<Scalar> point_inertia(Scalar mass, const Vector3<Scalar>& c) {
  return mass * (c.squaredNorm() * Matrix3<Scalar>::Identity() - c * c.transpose());
}

/// The columns of velocities that move a frame.
template <class Scalar>
std::vector<Eigen::Index> moving_columns(const Jacobian<Scalar>& J_t, const Jacobian<Scalar>& J_r) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index k = 0; k < J_t.cols(); ++k)
    if (!(J_t.col(k).isZero(0) && J_r.col(k).isZero(0))) columns.push_back(k);
  return columns;
}

template <class Scalar>
std::vector<Scalar> default_parameters(const model::Mechanism& mechanism) {
  std::vector<Scalar> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(Scalar(parameter.value));
  return values;
}

}  // namespace

template <class Scalar>
typename Reference<Scalar>::Body Reference<Scalar>::body_value(const model::Body& body) const {
  const std::span<const Scalar> parameters(parameters_);
  const model::Inertia& given = body.inertia;
  Matrix3<Scalar> tensor;
  tensor << value(given.xx), value(given.xy), value(given.xz),  //
      value(given.xy), value(given.yy), value(given.yz),        //
      value(given.xz), value(given.yz), value(given.zz);
  const Matrix3<Scalar> R = rotation_value(body.inertia_axes, parameters, mechanism_.snap);
  Body result{value(body.mass), vector_value(body.center_of_mass, parameters), R * tensor * R.transpose(),
              R.cwiseAbs() * tensor.cwiseAbs() * R.cwiseAbs().transpose()};
  if (body.inertia_point == model::InertiaPoint::kOrigin) {
    const Matrix3<Scalar> shift = point_inertia(result.mass, result.p_BC);
    result.I -= shift;
    result.I_scale += shift.cwiseAbs();
  }
  return result;
}

template <class Scalar>
Reference<Scalar>::Reference(const model::Mechanism& mechanism)
    : Reference(mechanism, default_parameters<Scalar>(mechanism)) {}

template <class Scalar>
Reference<Scalar>::Reference(const model::Mechanism& mechanism, std::span<const Scalar> parameters)
    : mechanism_(mechanism),
      layout_(model::lay_out_coordinates(mechanism)),
      parameters_(parameters.begin(), parameters.end()),
      order_(model::depth_first(mechanism)),
      gravity_(vector_value(mechanism.gravity, parameters)) {
  JD_CHECK(parameters.size() == mechanism.parameters.size(), "{} values for {} parameters", parameters.size(),
           mechanism.parameters.size());
  for (const model::Body& body : mechanism.bodies) bodies_.push_back(body_value(body));
  for (const model::JointIndex index : order_) {
    const model::Joint& joint = mechanism.joints[index.value];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c)
      if (joint.coordinates[c].motion) prescribed_.emplace_back(index.value, c);
  }
}

template <class Scalar>
State<Scalar> Reference<Scalar>::initial_state() const {
  std::vector<Scalar> y, z;
  for (const model::JointIndex index : order_) {
    const model::Joint& joint = mechanism_.joints[index.value];
    for (const model::Coordinate& coordinate : joint.coordinates) {
      if (coordinate.motion) continue;
      y.push_back(value(coordinate.initial_position));
      z.push_back(value(coordinate.initial_velocity));
    }
    const bool free = joint.type == model::JointType::kFree;
    for (std::size_t k = 0; free && k < 3; ++k) {
      y.push_back(value(joint.initial_origin[k]));
      z.push_back(value(joint.initial_origin_velocity[k]));
    }
    if (!free && joint.type != model::JointType::kSpherical) continue;
    for (const model::Expression& component : joint.initial_orientation) y.push_back(value(component));
    for (const model::Expression& component : joint.initial_spin) z.push_back(value(component));
  }
  for (const model::StateVariable& variable : mechanism_.states) z.push_back(value(variable.initial));
  const auto vector = [](const std::vector<Scalar>& values) {
    return VectorX<Scalar>(Eigen::Map<const VectorX<Scalar>>(values.data(), Eigen::Index(values.size())));
  };
  return {.t = 0, .y = vector(y), .z = vector(z)};
}

template <class Scalar>
typename Reference<Scalar>::Forces Reference<Scalar>::forces(const State<Scalar>& state,
                                                             const VectorX<Scalar>& u) const {
  JD_CHECK(u.size() == Eigen::Index(input_count()), "{} values for {} inputs", u.size(), input_count());
  const State<Scalar> whole{state.t, state.y, state.z, u};
  Forces at{whole, body_frames(whole), {}, VectorX<Scalar>(column_count())};
  for (const model::Frame& frame : mechanism_.frames) at.frames.push_back(placed(at.bodies, frame));
  at.rates.head(state.z.size()) = state.z;
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    at.rates[state.z.size() + Eigen::Index(i)] =
        coordinate(prescribed_[i].first, prescribed_[i].second, at.state).first;
  return at;
}

template <class Scalar>
Scalar Reference<Scalar>::largest_angle(const State<Scalar>& state) const {
  auto largest = Scalar(std::numbers::pi);
  State<Scalar> whole = state;  // angles depend on no input
  if (whole.u.size() == 0) whole.u = VectorX<Scalar>::Zero(Eigen::Index(input_count()));
  for (const auto& [joint, which] : prescribed_)
    if (mechanism_.joints[joint].coordinates[which].angular)
      largest = std::max(largest, Bounded<Scalar>(coordinate(joint, which, whole).value).scale);
  return largest;
}

template <class Scalar>
VectorX<Scalar> Reference<Scalar>::prescribed_accelerations(const State<Scalar>& state) const {
  VectorX<Scalar> accelerations(Eigen::Index(prescribed_.size()));
  for (std::size_t i = 0; i < prescribed_.size(); ++i)
    accelerations[Eigen::Index(i)] = coordinate(prescribed_[i].first, prescribed_[i].second, state).second;
  return accelerations;
}

/// `c` moves with the body, its reference point is the centre of mass.
template <class Scalar>
void Reference<Scalar>::add_body(const Body& body, const FrameMotion& c, const Forces& at,
                                 Terms<Scalar>& sum) const {
  const Scalar m = body.mass;
  const Matrix3<Scalar> R = c.R.transpose(), R_s = R.cwiseAbs();
  const std::vector<Eigen::Index> columns = moving_columns<Scalar>(c.J_t_scale, c.J_r_scale);
  const auto own = [&columns](const Jacobian<Scalar>& J) { return Jacobian<Scalar>(J(Eigen::all, columns)); };
  const Jacobian<Scalar> J_t = own(c.J_t), J_t_s = own(c.J_t_scale);
  const Jacobian<Scalar> J_r = R * own(c.J_r), J_r_s = R_s * own(c.J_r_scale);
  sum.M(columns, columns) += J_t.transpose() * m * J_t + J_r.transpose() * body.I * J_r;
  sum.M_scale(columns, columns) += J_t_s.transpose() * m * J_t_s + J_r_s.transpose() * body.I_scale * J_r_s;

  const Vector3<Scalar> omega = R * c.omega, omega_s = R_s * c.omega_scale;
  const Vector3<Scalar> spin = body.I * omega, spin_s = body.I_scale * omega_s;
  const Vector3<Scalar> moment = body.I * (R * c.zeta_bar) + omega.cross(spin);
  const Vector3<Scalar> moment_s =
      body.I_scale * (R_s * c.zeta_bar_scale) + cross_scale<Scalar>(omega_s, spin_s);
  sum.k_bar(columns) -= J_t.transpose() * m * c.a_bar + J_r.transpose() * moment;
  sum.k_scale(columns) += J_t_s.transpose() * m * c.a_bar_scale + J_r_s.transpose() * moment_s;

  const Vector3<Scalar> weight = m * gravity_;
  sum.q_bar(columns) -= J_t.transpose() * weight;
  sum.q_scale(columns) += J_t_s.transpose() * weight.cwiseAbs();

  const VectorX<Scalar> rates = at.rates(columns);
  const Vector3<Scalar> v = J_t * rates, v_s = J_t_s * rates.cwiseAbs();
  sum.kinetic_energy += (m * v.squaredNorm() + omega.dot(spin)) / 2;
  sum.kinetic_scale += (m * v_s.squaredNorm() + omega_s.dot(spin_s)) / 2;
  sum.potential_energy -= weight.dot(c.p);
  sum.potential_scale += weight.cwiseAbs().dot(c.p_scale);
}

template <class Scalar>
Terms<Scalar> Reference<Scalar>::all_columns(const Forces& at) const {
  const MatrixX<Scalar> square = MatrixX<Scalar>::Zero(column_count(), column_count());
  const VectorX<Scalar> column = VectorX<Scalar>::Zero(column_count());
  Terms<Scalar> sum{
      .M = square, .k_bar = column, .q_bar = column, .M_scale = square, .k_scale = column, .q_scale = column};
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    FrameMotion center = at.bodies[i];
    center.shift(center.R * bodies_[i].p_BC);
    add_body(bodies_[i], center, at, sum);
  }
  for (std::size_t i = 0; i < layout_.state_count; ++i) {
    const auto row = Eigen::Index(layout_.first_state() + i);
    sum.M(row, row) = sum.M_scale(row, row) = 1;
  }
  add_joint_forces(at, sum);
  for_each_force_element(mechanism_, [&](const auto& element) { add(effect(element, at), at, sum); });
  return sum;
}

/// The rows of z; the known accelerations of prescribed coordinates go into k̄.
template <class Scalar>
Terms<Scalar> Reference<Scalar>::evaluate(const State<Scalar>& state, const VectorX<Scalar>& u) const {
  const Forces at = forces(state, u);
  Terms<Scalar> terms = all_columns(at);
  const auto nz = Eigen::Index(coordinate_count()), rest = Eigen::Index(prescribed_.size());
  const VectorX<Scalar> accelerations = prescribed_accelerations(at.state);
  const VectorX<Scalar> k = terms.k_bar.head(nz) - terms.M.topRightCorner(nz, rest) * accelerations;
  const VectorX<Scalar> k_s =
      terms.k_scale.head(nz) + terms.M_scale.topRightCorner(nz, rest) * accelerations.cwiseAbs();
  const MatrixX<Scalar> M = terms.M.topLeftCorner(nz, nz), M_s = terms.M_scale.topLeftCorner(nz, nz);
  terms.M = M;
  terms.M_scale = M_s;
  terms.k_bar = k;
  terms.k_scale = k_s;
  terms.q_bar = terms.q_bar.head(nz).eval();
  terms.q_scale = terms.q_scale.head(nz).eval();
  terms.state_count = Eigen::Index(layout_.state_count);
  return terms;
}

template <class Scalar>
VectorX<Scalar> Reference<Scalar>::sampled_states(const State<Scalar>& state, const VectorX<Scalar>& u,
                                                  const Scalar& h) const {
  Forces at = forces(state, u);
  at.h = h;
  std::vector<Scalar> values;
  for (const model::StateVariable& variable : mechanism_.states)
    if (variable.sampled) values.push_back(general(*variable.sampled, at).value);
  return VectorX<Scalar>(Eigen::Map<const VectorX<Scalar>>(values.data(), Eigen::Index(values.size())));
}

template class Reference<JOURDAIN_SCALAR>;

}  // namespace jourdain::reference
