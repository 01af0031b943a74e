// From minimal coordinates to a consistent state in absolute ones: the only place of the descriptor form that walks
// the tree.
#include <limits>

#include "reference/descriptor.hpp"
#include "support/check.hpp"

namespace jourdain::reference {

namespace {

using descriptor::Pose;
using descriptor::TimeJet;

template <class T, class Scalar>
Vector3<T> moving(const Vector3<Scalar>& value, const Vector3<Scalar>& rate) {
  return {T(value.x(), rate.x(), 0), T(value.y(), rate.y(), 0), T(value.z(), rate.z(), 0)};
}

/// R and Ṙ = R ω̃ of a quaternion (w, x, y, z), ω in turned components; the acceleration is left at zero.
template <class Scalar>
Matrix3<TimeJet<Scalar>> turning(const Eigen::Vector4<Scalar>& wxyz, const Vector3<Scalar>& omega) {
  const Eigen::Quaternion<Scalar> quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  const Matrix3<Scalar> R = quaternion.normalized().toRotationMatrix();
  Matrix3<TimeJet<Scalar>> result;
  for (Eigen::Index row = 0; row < 3; ++row) {
    const Vector3<Scalar> direction = R.row(row).transpose();
    const Vector3<Scalar> rate = direction.cross(omega);
    for (Eigen::Index i = 0; i < 3; ++i) result(row, i) = {direction[i], rate[i], 0};
  }
  return result;
}

/// Position and velocity of the body whose frame moves like `pose`.
template <class Scalar>
AbsoluteBody<Scalar> absolute_body(const descriptor::Body<Scalar>& body, const Pose<TimeJet<Scalar>>& pose) {
  using T = TimeJet<Scalar>;
  const Vector3<T> center = pose.p_WF + pose.R_WF * body.p_BC.template cast<T>();
  const Matrix3<Scalar> R = pose.R_WF.unaryExpr([](const T& entry) { return entry.value; });
  const Matrix3<Scalar> R_rate = pose.R_WF.unaryExpr([](const T& entry) { return entry.rate; });
  const Matrix3<Scalar> spin = R.transpose() * R_rate;
  return {.p_WC = {center.x().value, center.y().value, center.z().value},
          .orientation = Eigen::Quaternion<Scalar>(R).normalized(),
          .v_C = {center.x().rate, center.y().rate, center.z().rate},
          .omega =
              Vector3<Scalar>(spin(2, 1) - spin(1, 2), spin(0, 2) - spin(2, 0), spin(1, 0) - spin(0, 1)) / 2};
}

}  // namespace

/// With as many of its derivatives as `rates` says; the others are not known. A state moves on by its rate.
template <class Scalar>
TimeJet<Scalar> DescriptorReference<Scalar>::prescribed(const model::Expression& motion, const Led& led,
                                                        int rates) const {
  using T = TimeJet<Scalar>;
  using Kind = model::Variable::Kind;
  const std::vector<T> parameters(parameters_.begin(), parameters_.end());
  return motion.evaluate<T>(
      parameters, [](double value) { return T(Scalar(value)); },
      [&](const model::Variable& variable) {
        const auto i = Eigen::Index(variable.index);
        if (variable.kind == Kind::kTime) return T(led.t, 1, 0);
        if (variable.kind == Kind::kState) {
          if (rates == 0) return T(led.states[i]);
          const T rate = prescribed(mechanism_.states[variable.index].rate, led, rates - 1);
          return T(led.states[i], rate.value, rate.rate);
        }
        JD_CHECK(variable.kind == Kind::kInput, "a motion depends on variable kind {}", int(variable.kind));
        return T(i < led.inputs.size() ? led.inputs[i] : std::numeric_limits<Scalar>::quiet_NaN());
      });
}

template <class Scalar>
typename DescriptorReference<Scalar>::Coordinates DescriptorReference<Scalar>::coordinates_at(
    const Led& led, const Eigen::VectorX<Scalar>& y, const Eigen::VectorX<Scalar>& z) const {
  JD_CHECK(
      std::size_t(y.size()) == layout_.position_count() && std::size_t(z.size()) == layout_.velocity_count(),
      "{} positions, {} velocities for {} and {}", y.size(), z.size(), layout_.position_count(),
      layout_.velocity_count());
  Coordinates result(joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto& coordinates = mechanism_.joints[j].coordinates;
    const model::JointEntries& entries = layout_.joints[j];
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      result[j].push_back(coordinates[i].motion ? prescribed(*coordinates[i].motion, led)
                                                : TimeJet<Scalar>(y[Eigen::Index(*entries.position[i])],
                                                                  z[Eigen::Index(*entries.velocity[i])], 0));
  }
  return result;
}

template <class Scalar>
typename DescriptorReference<Scalar>::Coordinates DescriptorReference<Scalar>::coordinates_near(
    const Led& led, const std::vector<std::vector<Scalar>>& near) const {
  Coordinates result(joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const auto& coordinates = mechanism_.joints[j].coordinates;
    for (std::size_t i = 0; i < coordinates.size(); ++i)
      result[j].push_back(coordinates[i].motion ? prescribed(*coordinates[i].motion, led)
                                                : TimeJet<Scalar>(near[j][i], 0, 0));
  }
  return result;
}

template <class Scalar>
AbsoluteState<Scalar> DescriptorReference<Scalar>::absolute(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                            const Eigen::VectorX<Scalar>& z) const {
  AbsoluteState<Scalar> state{t, absolute_state(t, y, z), {}, z.tail(Eigen::Index(layout_.state_count))};
  for (const auto& joint : coordinates_at(led(t, z), y, z)) {
    state.near.emplace_back();
    for (const TimeJet<Scalar>& coordinate : joint) state.near.back().push_back(coordinate.value);
  }
  return state;
}

template <class Scalar>
Pose<TimeJet<Scalar>> DescriptorReference<Scalar>::body_pose(std::size_t joint,
                                                             const Pose<TimeJet<Scalar>>& parent,
                                                             const Coordinates& coordinates,
                                                             const Eigen::VectorX<Scalar>& y,
                                                             const Eigen::VectorX<Scalar>& z) const {
  using T = TimeJet<Scalar>;
  const auto first_position = Eigen::Index(layout_.joints[joint].first_position);
  const auto first_velocity = Eigen::Index(layout_.joints[joint].first_velocity);
  if (joints_[joint].type == model::JointType::kSpherical)
    return descriptor::joint_frame(joints_[joint], parent)
        .moved(turning<Scalar>(y.template segment<4>(first_position), z.template segment<3>(first_velocity)),
               Vector3<T>::Zero());
  if (joints_[joint].type == model::JointType::kFree)
    return {
        turning<Scalar>(y.template segment<4>(first_position + 3), z.template segment<3>(first_velocity + 3)),
        moving<T, Scalar>(y.template segment<3>(first_position), z.template segment<3>(first_velocity))};
  return descriptor::child_pose(joints_[joint], parent, std::span<const T>(coordinates[joint]));
}

template <class Scalar>
std::vector<AbsoluteBody<Scalar>> DescriptorReference<Scalar>::absolute_state(
    Scalar t, const Eigen::VectorX<Scalar>& y, const Eigen::VectorX<Scalar>& z) const {
  const Coordinates coordinates = coordinates_at(led(t, z), y, z);
  std::vector<Pose<TimeJet<Scalar>>> poses(bodies_.size());
  for (const model::JointIndex index : model::depth_first(mechanism_)) {
    const auto& joint = joints_[index.value];
    poses[joint.child] = body_pose(index.value, joint.parent ? poses[*joint.parent] : Pose<TimeJet<Scalar>>(),
                                   coordinates, y, z);
  }
  std::vector<AbsoluteBody<Scalar>> bodies;
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies.push_back(absolute_body(bodies_[i], poses[i]));
  return bodies;
}

/// X of x = X z + x̄, the velocities (v_C, ω) of all bodies: 6 nb × nz. Velocities are linear in z, so
/// differences say it.
template <class Scalar>
Eigen::MatrixX<Scalar> DescriptorReference<Scalar>::tree_velocities(Scalar t, const Eigen::VectorX<Scalar>& y,
                                                                    const Eigen::VectorX<Scalar>& z) const {
  const auto velocities = [&](const Eigen::VectorX<Scalar>& at) {
    Eigen::VectorX<Scalar> x(6 * Eigen::Index(bodies_.size()));
    Eigen::Index row = 0;
    for (const AbsoluteBody<Scalar>& body : absolute_state(t, y, at)) {
      x.template segment<3>(row) = body.v_C;
      x.template segment<3>(row + 3) = body.omega;
      row += 6;
    }
    return x;
  };
  Eigen::MatrixX<Scalar> X(6 * Eigen::Index(bodies_.size()), z.size());
  Eigen::VectorX<Scalar> at_rest = z;  // but for states, which motions may follow
  at_rest.head(Eigen::Index(layout_.first_state())).setZero();
  const Eigen::VectorX<Scalar> still = velocities(at_rest);
  X.rightCols(Eigen::Index(layout_.state_count)).setZero();
  for (Eigen::Index k = 0; k < Eigen::Index(layout_.first_state()); ++k) {
    Eigen::VectorX<Scalar> moving = at_rest;
    moving[k] = 1;
    X.col(k) = velocities(moving) - still;
  }
  return X;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                                        \
  template TimeJet<S> DescriptorReference<S>::prescribed(                                              \
      const model::Expression&, const typename DescriptorReference<S>::Led&, int) const;               \
  template typename DescriptorReference<S>::Coordinates DescriptorReference<S>::coordinates_at(        \
      const typename DescriptorReference<S>::Led&, const Eigen::VectorX<S>&, const Eigen::VectorX<S>&) \
      const;                                                                                           \
  template typename DescriptorReference<S>::Coordinates DescriptorReference<S>::coordinates_near(      \
      const typename DescriptorReference<S>::Led&, const std::vector<std::vector<S>>&) const;          \
  template AbsoluteState<S> DescriptorReference<S>::absolute(S, const Eigen::VectorX<S>&,              \
                                                             const Eigen::VectorX<S>&) const;          \
  template Pose<TimeJet<S>> DescriptorReference<S>::body_pose(                                         \
      std::size_t, const Pose<TimeJet<S>>&, const DescriptorReference<S>::Coordinates&,                \
      const Eigen::VectorX<S>&, const Eigen::VectorX<S>&) const;                                       \
  template Eigen::MatrixX<S> DescriptorReference<S>::tree_velocities(S, const Eigen::VectorX<S>&,      \
                                                                     const Eigen::VectorX<S>&) const;  \
  template std::vector<AbsoluteBody<S>> DescriptorReference<S>::absolute_state(                        \
      S, const Eigen::VectorX<S>&, const Eigen::VectorX<S>&) const;
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference
