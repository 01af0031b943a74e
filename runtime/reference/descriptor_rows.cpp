#include "reference/descriptor_rows.hpp"

namespace jourdain::reference::descriptor {

template <class Scalar>
Pose<TimeJet<Scalar>> coasting(const Body<Scalar>& body, const AbsoluteBody<Scalar>& motion,
                               const Velocity<Scalar>& velocity) {
  using T = TimeJet<Scalar>;
  const Vector3<Scalar> v = velocity.template head<3>();
  const Vector3<Scalar> w = velocity.template tail<3>();
  Matrix3<Scalar> cross;
  cross << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  const Matrix3<Scalar> R = motion.orientation.toRotationMatrix();
  const Matrix3<Scalar> R_rate = R * cross, R_acceleration = R * cross * cross;
  Pose<T> pose;
  for (Eigen::Index i = 0; i < 3; ++i) {
    pose.p_WF[i] = T(motion.p_WC[i], v[i], 0);
    for (Eigen::Index j = 0; j < 3; ++j) pose.R_WF(i, j) = T(R(i, j), R_rate(i, j), R_acceleration(i, j));
  }
  pose.p_WF -= pose.R_WF * body.p_BC.template cast<T>();
  return pose;
}

namespace {

/// Constraints, then coordinates, at given velocities of the two bodies.
template <class Scalar>
class RowProbe {
 public:
  RowProbe(const Joint<Scalar>& joint, const std::vector<Body<Scalar>>& bodies,
           const std::vector<AbsoluteBody<Scalar>>& motions, std::span<const Scalar> near,
           ParallelAxes parallel_axes)
      : joint_(joint), bodies_(bodies), motions_(motions), near_(near), parallel_axes_(parallel_axes) {}

  /// `parent` is ignored where the parent is the world.
  Measurement<Scalar> at(const Velocity<Scalar>& parent, const Velocity<Scalar>& child) const {
    return measure(joint_, joint_.parent ? pose(*joint_.parent, parent) : Pose<TimeJet<Scalar>>(),
                   pose(joint_.child, child), near_, parallel_axes_);
  }
  Measurement<Scalar> at_actual_velocities() const {
    return at(joint_.parent ? velocity(*joint_.parent) : Velocity<Scalar>::Zero(), velocity(joint_.child));
  }

 private:
  Pose<TimeJet<Scalar>> pose(std::size_t body, const Velocity<Scalar>& velocity) const {
    return coasting(bodies_[body], motions_[body], velocity);
  }
  Velocity<Scalar> velocity(std::size_t body) const {
    Velocity<Scalar> result;
    result << motions_[body].v_C, motions_[body].omega;
    return result;
  }

  const Joint<Scalar>& joint_;
  const std::vector<Body<Scalar>>& bodies_;
  const std::vector<AbsoluteBody<Scalar>>& motions_;
  std::span<const Scalar> near_;
  ParallelAxes parallel_axes_;
};

template <class Scalar>
std::vector<TimeJet<Scalar>> stacked(const Measurement<Scalar>& measurement) {
  std::vector<TimeJet<Scalar>> rows = measurement.constraints;
  rows.insert(rows.end(), measurement.coordinates.begin(), measurement.coordinates.end());
  return rows;
}

}  // namespace

template <class Scalar>
JointRows<Scalar> joint_rows(const Joint<Scalar>& joint, const std::vector<Body<Scalar>>& bodies,
                             const std::vector<AbsoluteBody<Scalar>>& motions, std::span<const Scalar> near,
                             ParallelAxes parallel_axes) {
  const RowProbe<Scalar> probe(joint, bodies, motions, near, parallel_axes);
  const Measurement<Scalar> actual = probe.at_actual_velocities();
  const std::vector<TimeJet<Scalar>> rows = stacked(actual);
  const auto count = Eigen::Index(rows.size());
  JointRows<Scalar> result{.jacobian = Eigen::MatrixX<Scalar>::Zero(count, 6 * Eigen::Index(bodies.size())),
                           .value = Eigen::VectorX<Scalar>(count),
                           .rate = Eigen::VectorX<Scalar>(count),
                           .gamma = Eigen::VectorX<Scalar>(count),
                           .constraint_count = Eigen::Index(actual.constraints.size())};
  for (Eigen::Index i = 0; i < count; ++i) {
    result.value[i] = rows[std::size_t(i)].value;
    result.rate[i] = rows[std::size_t(i)].rate;
    result.gamma[i] = rows[std::size_t(i)].acceleration;
  }
  const auto fill_column = [&](std::size_t body, Eigen::Index k, const Measurement<Scalar>& measurement) {
    const std::vector<TimeJet<Scalar>> column = stacked(measurement);
    for (Eigen::Index i = 0; i < count; ++i)
      result.jacobian(i, 6 * Eigen::Index(body) + k) = column[std::size_t(i)].rate;
  };
  const Velocity<Scalar> rest = Velocity<Scalar>::Zero();
  for (Eigen::Index k = 0; k < 6; ++k) {
    const Velocity<Scalar> unit = Velocity<Scalar>::Unit(k);
    fill_column(joint.child, k, probe.at(rest, unit));
    if (joint.parent) fill_column(*joint.parent, k, probe.at(unit, rest));
  }
  return result;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                                   \
  template Pose<TimeJet<S>> coasting(const Body<S>&, const AbsoluteBody<S>&, const Velocity<S>&); \
  template JointRows<S> joint_rows(const Joint<S>&, const std::vector<Body<S>>&,                  \
                                   const std::vector<AbsoluteBody<S>>&, std::span<const S>, ParallelAxes);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference::descriptor
