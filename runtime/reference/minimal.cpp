#include "reference/minimal.hpp"

#include <algorithm>
#include <limits>

#include "support/check.hpp"

namespace jourdain::reference {

namespace {

/// Absolute values of the products of a cross product, added up.
template <class Scalar>
Vector3<Scalar> cross_scale(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
  const Vector3<Scalar> l = a.cwiseAbs(), r = b.cwiseAbs();
  return {l.y() * r.z() + l.z() * r.y(), l.z() * r.x() + l.x() * r.z(), l.x() * r.y() + l.y() * r.x()};
}

/// m (|c|² 1 − c cᵀ): what a point mass at `c` has about the origin.
template <class Scalar>
Matrix3<Scalar> point_inertia(Scalar mass, const Vector3<Scalar>& c) {
  return mass * (c.squaredNorm() * Matrix3<Scalar>::Identity() - c * c.transpose());
}

template <class Scalar>
std::vector<Scalar> default_parameters(const model::Mechanism& mechanism) {
  std::vector<Scalar> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(Scalar(parameter.value));
  return values;
}

}  // namespace

/// Motion of a frame's origin and of the frame, all in inertial components.
template <class Scalar>
struct Reference<Scalar>::FrameMotion {
  Matrix3<Scalar> R;
  Vector3<Scalar> p;
  Jacobian<Scalar> J_t, J_r;
  Vector3<Scalar> a_bar, omega, zeta_bar;
  Jacobian<Scalar> J_t_scale, J_r_scale;
  Vector3<Scalar> a_bar_scale, omega_scale, zeta_bar_scale;

  /// Moves the reference point by `r` (m, inertial components), as if fixed in the frame.
  void shift(const Vector3<Scalar>& r) {
    p += r;
    for (Eigen::Index i = 0; i < J_t.cols(); ++i) {
      J_t.col(i) += Vector3<Scalar>(J_r.col(i)).cross(r);
      J_t_scale.col(i) += cross_scale<Scalar>(J_r_scale.col(i), r);
    }
    a_bar += zeta_bar.cross(r) + omega.cross(omega.cross(r));
    a_bar_scale += cross_scale<Scalar>(zeta_bar_scale, r) +
                   cross_scale<Scalar>(omega_scale, cross_scale<Scalar>(omega_scale, r));
  }
};

template <class Scalar>
typename Reference<Scalar>::Body Reference<Scalar>::body_value(const model::Body& body,
                                                               std::span<const Scalar> parameters,
                                                               bool snap) {
  const auto value = [&](const model::Expression& expression) { return expression.evaluate(parameters); };
  const model::Inertia& given = body.inertia;
  Matrix3<Scalar> tensor;
  tensor << value(given.xx), value(given.xy), value(given.xz),  //
      value(given.xy), value(given.yy), value(given.yz),        //
      value(given.xz), value(given.yz), value(given.zz);
  const Matrix3<Scalar> R = rotation_value(body.inertia_axes, parameters, snap);
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
typename Reference<Scalar>::Joint Reference<Scalar>::joint_value(const model::Joint& joint,
                                                                 std::span<const Scalar> parameters,
                                                                 bool snap) {
  const auto value = [&](const model::Expression& expression) { return expression.evaluate(parameters); };
  const model::Coordinate coordinate = joint.coordinates.empty() ? model::Coordinate() : joint.coordinates[0];
  const Vector3<Scalar> axis{Scalar(joint.axis[0]), Scalar(joint.axis[1]), Scalar(joint.axis[2])};
  return {.type = joint.type,
          .parent = joint.parent ? std::ptrdiff_t(joint.parent->value) : -1,
          .child = joint.child.value,
          .coordinate = -1,
          .R_PJ = rotation_value(joint.placement.rotation, parameters, snap),
          .p_PJ = vector_value(joint.placement.position, parameters),
          .axis = axis.stableNormalized(),
          .stiffness = value(coordinate.stiffness),
          .rest = value(coordinate.rest),
          .damping = value(coordinate.damping),
          .initial_position = value(coordinate.initial_position),
          .initial_velocity = value(coordinate.initial_velocity)};
}

template <class Scalar>
Reference<Scalar>::Reference(const model::Mechanism& mechanism, Snap snap)
    : Reference(mechanism, default_parameters<Scalar>(mechanism), snap) {}

template <class Scalar>
Reference<Scalar>::Reference(const model::Mechanism& mechanism, std::span<const Scalar> parameters, Snap snap)
    : gravity_(vector_value(mechanism.gravity, parameters)) {
  JD_CHECK(parameters.size() == mechanism.parameters.size(), "{} values for {} parameters", parameters.size(),
           mechanism.parameters.size());
  const bool snapping = snap == Snap::kAsModel && mechanism.snap;
  for (const model::Body& body : mechanism.bodies) bodies_.push_back(body_value(body, parameters, snapping));
  std::vector<Eigen::Index> coordinate_of(mechanism.joints.size(), -1);
  for (const model::JointIndex index : model::moving_joints(mechanism))
    coordinate_of[index.value] = Eigen::Index(coordinate_count_++);
  for (const model::JointIndex index : model::depth_first(mechanism)) {
    joints_.push_back(joint_value(mechanism.joints[index.value], parameters, snapping));
    joints_.back().coordinate = coordinate_of[index.value];
  }
  for (const model::Actuator& actuator : mechanism.actuators)
    inputs_.push_back(coordinate_of[actuator.joint.value]);
}

template <class Scalar>
State<Scalar> Reference<Scalar>::initial_state() const {
  const auto nz = Eigen::Index(coordinate_count_);
  State<Scalar> state{.t = 0, .y = VectorX<Scalar>::Zero(nz), .z = VectorX<Scalar>::Zero(nz)};
  for (const Joint& joint : joints_) {
    if (joint.coordinate < 0) continue;
    state.y[joint.coordinate] = joint.initial_position;
    state.z[joint.coordinate] = joint.initial_velocity;
  }
  return state;
}

template <class Scalar>
typename Reference<Scalar>::FrameMotion Reference<Scalar>::world_motion() const {
  const Jacobian<Scalar> J = Jacobian<Scalar>::Zero(3, Eigen::Index(coordinate_count_));
  const Vector3<Scalar> zero = Vector3<Scalar>::Zero();
  return {Matrix3<Scalar>::Identity(), zero, J, J, zero, zero, zero, J, J, zero, zero, zero};
}

template <class Scalar>
typename Reference<Scalar>::FrameMotion Reference<Scalar>::child_motion(const FrameMotion& parent,
                                                                        const Joint& joint,
                                                                        const State<Scalar>& state) const {
  FrameMotion child = parent;
  child.shift(parent.R * joint.p_PJ);
  child.R = parent.R * joint.R_PJ;
  if (joint.type == model::JointType::kFixed) return child;

  const Scalar y = state.y[joint.coordinate], z = state.z[joint.coordinate];
  const Vector3<Scalar> axis = child.R * joint.axis;
  if (joint.type == model::JointType::kRevolute) {
    child.R = child.R * rotation_about(joint.axis, y);
    child.J_r.col(joint.coordinate) = axis;
    child.J_r_scale.col(joint.coordinate) = axis.cwiseAbs();
    child.omega += axis * z;
    child.omega_scale += (axis * z).cwiseAbs();
    child.zeta_bar += parent.omega.cross(axis * z);
    child.zeta_bar_scale += cross_scale<Scalar>(parent.omega_scale, axis * z);
  } else {
    child.shift(axis * y);
    child.J_t.col(joint.coordinate) = axis;
    child.J_t_scale.col(joint.coordinate) = axis.cwiseAbs();
    child.a_bar += 2 * parent.omega.cross(axis * z);
    child.a_bar_scale += 2 * cross_scale<Scalar>(parent.omega_scale, axis * z);
  }
  return child;
}

template <class Scalar>
BodyMotion<Scalar> Reference<Scalar>::body_motion(const FrameMotion& frame, const Body& body) {
  FrameMotion center = frame;
  center.shift(frame.R * body.p_BC);
  const Matrix3<Scalar> R_BW = frame.R.transpose();
  const Matrix3<Scalar> R_BW_scale = R_BW.cwiseAbs();
  return {.R_WB = frame.R,
          .p_WC = center.p,
          .J_t = center.J_t,
          .J_r = R_BW * center.J_r,
          .a_bar = center.a_bar,
          .omega = R_BW * center.omega,
          .zeta_bar = R_BW * center.zeta_bar,
          .J_t_scale = center.J_t_scale,
          .J_r_scale = R_BW_scale * center.J_r_scale,
          .a_bar_scale = center.a_bar_scale,
          .omega_scale = R_BW_scale * center.omega_scale,
          .zeta_bar_scale = R_BW_scale * center.zeta_bar_scale};
}

template <class Scalar>
std::vector<BodyMotion<Scalar>> Reference<Scalar>::motion(const State<Scalar>& state) const {
  JD_CHECK(
      state.y.size() == Eigen::Index(coordinate_count_) && state.z.size() == Eigen::Index(coordinate_count_),
      "{} positions, {} velocities for {} coordinates", state.y.size(), state.z.size(), coordinate_count_);
  const FrameMotion world = world_motion();
  std::vector<FrameMotion> frames(bodies_.size(), world);
  for (const Joint& joint : joints_)
    frames[joint.child] =
        child_motion(joint.parent < 0 ? world : frames[std::size_t(joint.parent)], joint, state);
  std::vector<BodyMotion<Scalar>> motions;
  for (std::size_t i = 0; i < bodies_.size(); ++i) motions.push_back(body_motion(frames[i], bodies_[i]));
  return motions;
}

template <class Scalar>
void Reference<Scalar>::add_body(const Body& body, const BodyMotion<Scalar>& motion,
                                 const State<Scalar>& state, Terms<Scalar>& sum) const {
  const Scalar m = body.mass;
  const Matrix3<Scalar>& I = body.I;
  const auto& [R_WB, p_WC, J_t, J_r, a_bar, omega, zeta_bar, J_t_s, J_r_s, a_bar_s, omega_s, zeta_bar_s] =
      motion;

  sum.M += J_t.transpose() * m * J_t + J_r.transpose() * I * J_r;
  sum.M_scale += J_t_s.transpose() * m * J_t_s + J_r_s.transpose() * body.I_scale * J_r_s;

  const Vector3<Scalar> spin = I * omega;
  const Vector3<Scalar> moment = I * zeta_bar + omega.cross(spin);
  sum.k_bar -= J_t.transpose() * m * a_bar + J_r.transpose() * moment;
  const Vector3<Scalar> spin_s = body.I_scale * omega_s;
  const Vector3<Scalar> moment_s = body.I_scale * zeta_bar_s + cross_scale<Scalar>(omega_s, spin_s);
  sum.k_scale += J_t_s.transpose() * m * a_bar_s + J_r_s.transpose() * moment_s;

  const Vector3<Scalar> weight = m * gravity_;
  sum.q_bar -= J_t.transpose() * weight;
  sum.q_scale += J_t_s.transpose() * weight.cwiseAbs();

  const Vector3<Scalar> v = J_t * state.z;
  sum.kinetic_energy += (m * v.squaredNorm() + omega.dot(spin)) / 2;
  sum.potential_energy -= weight.dot(p_WC);
}

template <class Scalar>
void Reference<Scalar>::add_joint_forces(const State<Scalar>& state, const VectorX<Scalar>& u,
                                         Terms<Scalar>& sum) const {
  using std::abs;
  for (const Joint& joint : joints_) {
    const Eigen::Index i = joint.coordinate;
    if (i < 0) continue;
    const Scalar stretch = state.y[i] - joint.rest;
    sum.q_bar[i] += joint.stiffness * stretch + joint.damping * state.z[i];
    sum.q_scale[i] +=
        abs(joint.stiffness) * (abs(state.y[i]) + abs(joint.rest)) + abs(joint.damping * state.z[i]);
    sum.potential_energy += joint.stiffness * stretch * stretch / 2;
  }
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    sum.q_bar[inputs_[i]] -= u[Eigen::Index(i)];
    sum.q_scale[inputs_[i]] += abs(u[Eigen::Index(i)]);
  }
}

template <class Scalar>
Terms<Scalar> Reference<Scalar>::evaluate(const State<Scalar>& state, const VectorX<Scalar>& u) const {
  JD_CHECK(u.size() == Eigen::Index(inputs_.size()), "{} values for {} inputs", u.size(), inputs_.size());
  const std::vector<BodyMotion<Scalar>> motions = motion(state);
  const auto nz = Eigen::Index(coordinate_count_);
  const MatrixX<Scalar> square = MatrixX<Scalar>::Zero(nz, nz);
  const VectorX<Scalar> column = VectorX<Scalar>::Zero(nz);
  Terms<Scalar> sum{.M = square,
                    .k_bar = column,
                    .q_bar = column,  //
                    .M_scale = square,
                    .k_scale = column,
                    .q_scale = column};
  for (std::size_t i = 0; i < bodies_.size(); ++i) add_body(bodies_[i], motions[i], state, sum);
  add_joint_forces(state, u, sum);
  return sum;
}

template <class Scalar>
void widen_scales(Terms<Scalar>& terms) {
  const Scalar share = Scalar(kNaturalShare);
  const VectorX<Scalar> size = terms.M_scale.diagonal().cwiseSqrt();
  for (VectorX<Scalar>* scale : {&terms.k_scale, &terms.q_scale}) {
    const Scalar relative = (scale->array() / size.array()).maxCoeff();
    *scale += share * relative * size;
  }
  terms.M_scale += share * size * size.transpose();
}

template <class Scalar>
VectorX<Scalar> forward_dynamics(const Terms<Scalar>& terms) {
  return terms.M.ldlt().solve(terms.k_bar - terms.q_bar);
}

template <class Scalar>
Scalar backward_error(const Terms<Scalar>& terms, const VectorX<Scalar>& zdot) {
  const VectorX<Scalar> residual = (terms.M * zdot - terms.k_bar + terms.q_bar).cwiseAbs();
  const VectorX<Scalar> scale = terms.M_scale * zdot.cwiseAbs() + terms.k_scale + terms.q_scale;
  Scalar worst = 0;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (residual[i] == 0) continue;
    const Scalar ratio = residual[i] / scale[i];
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

template <class Scalar>
Scalar condition(const MatrixX<Scalar>& M) {
  if (M.size() == 0) return 1;
  const VectorX<Scalar> values =
      Eigen::SelfAdjointEigenSolver<MatrixX<Scalar>>(M, Eigen::EigenvaluesOnly).eigenvalues();
  const Scalar smallest = values[0];
  return smallest > 0 ? values[values.size() - 1] / smallest : std::numeric_limits<Scalar>::infinity();
}

template class Reference<double>;
template class Reference<long double>;
template VectorX<double> forward_dynamics(const Terms<double>&);
template VectorX<long double> forward_dynamics(const Terms<long double>&);
template void widen_scales(Terms<double>&);
template void widen_scales(Terms<long double>&);
template double backward_error(const Terms<double>&, const VectorX<double>&);
template long double backward_error(const Terms<long double>&, const VectorX<long double>&);
template double condition(const MatrixX<double>&);
template long double condition(const MatrixX<long double>&);

}  // namespace jourdain::reference
