#include "reference/descriptor_joints.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "support/check.hpp"

namespace jourdain::reference::descriptor {

namespace {

using model::JointType;

template <class Scalar>
using Jet = TimeJet<Scalar>;

template <class Scalar>
Vector3<Scalar> unit_vector(const std::array<double, 3>& direction) {
  return Vector3<Scalar>(Scalar(direction[0]), Scalar(direction[1]), Scalar(direction[2])).stableNormalized();
}

/// The point of the curve at `argument`, joint frame, m.
template <class Scalar>
Vector3<Jet<Scalar>> curve_point(const Joint<Scalar>& joint, const Jet<Scalar>& argument) {
  const std::vector<Jet<Scalar>> parameters(joint.parameters.begin(), joint.parameters.end());
  Vector3<Jet<Scalar>> point;
  for (std::size_t i = 0; i < 3; ++i)
    point[Eigen::Index(i)] = joint.curve[i].template evaluate<Jet<Scalar>>(
        parameters, [](double value) { return Jet<Scalar>(Scalar(value)); },
        [&](const model::Variable& variable) {
          JD_CHECK(variable.kind == model::Variable::Kind::kArgument, "a curve depends on variable kind {}",
                   int(variable.kind));
          return argument;
        });
  return point;
}

/// Collects what the pose of the child in the joint frame says, one geometric condition at a time.
template <class Scalar>
class Measuring {
 public:
  using T = Jet<Scalar>;

  Measuring(const Joint<Scalar>& joint, const Pose<T>& frame, const Pose<T>& child,
            std::span<const Scalar> near, ParallelAxes parallel_axes)
      : joint_(joint),
        near_(near),
        parallel_axes_(parallel_axes),
        R_WJ_(frame.R_WF),
        R_WC_(child.R_WF),
        R_JC_(frame.R_WF.transpose() * child.R_WF),
        p_JC_(frame.R_WF.transpose() * (child.p_WF - frame.p_WF)),
        axis_(joint.axis.template cast<T>()),
        normals_{joint.normals[0].template cast<T>(), joint.normals[1].template cast<T>()} {}

  Measurement<Scalar> run() {
    switch (joint_.type) {
      case JointType::kFixed:
        points_coincide();
        orientation_is_locked();
        break;
      case JointType::kRevolute:
        points_coincide();
        axes_are_parallel();
        add_coordinate(turn());
        break;
      case JointType::kPrismatic:
        point_is_on_axis();
        orientation_is_locked();
        add_coordinate(axis_.dot(p_JC_));
        break;
      case JointType::kScrew:
        point_is_on_axis();
        axes_are_parallel();
        add_coordinate(turn());
        add_constraint(axis_.dot(p_JC_) - T(joint_.pitch) * result_.coordinates[0]);
        break;
      case JointType::kCylindrical:
        point_is_on_axis();
        axes_are_parallel();
        add_coordinate(turn());
        add_coordinate(axis_.dot(p_JC_));
        break;
      case JointType::kUniversal:
        points_coincide();
        measure_cross();
        break;
      case JointType::kPlanar:
        add_constraint(axis_.dot(p_JC_));
        axes_are_parallel();
        add_coordinate(normals_[0].dot(p_JC_));
        add_coordinate(normals_[1].dot(p_JC_));
        add_coordinate(turn());
        break;
      case JointType::kSpherical:
        points_coincide();
        break;
      case JointType::kFree:
        break;
      case JointType::kCurve:
        orientation_is_locked();
        measure_curve();
        break;
      case JointType::kGimbal:
        points_coincide();
        measure_gimbal();
        break;
      case JointType::kPoint:
        orientation_is_locked();
        for (const T& component : p_JC_) add_coordinate(component);
        break;
    }
    return std::move(result_);
  }

 private:
  void add_constraint(const T& g) { result_.constraints.push_back(g); }
  void add_coordinate(const T& y) { result_.coordinates.push_back(y); }

  void points_coincide() {
    for (const T& component : p_JC_) add_constraint(component);
  }

  void point_is_on_axis() {
    for (const Vector3<T>& normal : normals_) add_constraint(normal.dot(p_JC_));
  }

  /// Axial vector of R: regular while the angle between the frames stays below a right angle.
  void orientation_is_locked() {
    const T half(Scalar(1) / 2);
    add_constraint(half * (R_JC_(2, 1) - R_JC_(1, 2)));
    add_constraint(half * (R_JC_(0, 2) - R_JC_(2, 0)));
    add_constraint(half * (R_JC_(1, 0) - R_JC_(0, 1)));
  }

  void axes_are_parallel() {
    switch (parallel_axes_) {
      case ParallelAxes::kFixedNormals: {
        const Vector3<T> w_l = R_JC_ * axis_;
        for (const Vector3<T>& normal : normals_) add_constraint(normal.dot(w_l));
        return;
      }
      case ParallelAxes::kCrossProduct: {
        const Vector3<T> w_k = R_WJ_ * axis_;
        const Vector3<T> w_l = R_WC_ * axis_;
        const Vector3<T> rows = w_k.cross(w_l);
        const Eigen::Index left_out = largest_component(w_k);
        for (Eigen::Index i = 0; i < 3; ++i)
          if (i != left_out) add_constraint(rows[i]);
        return;
      }
    }
  }

  /// The rows of w_k × w_l are dependent with w_k as factors: the row with the largest factor can be left out.
  static Eigen::Index largest_component(const Vector3<T>& w) {
    using std::abs;
    Eigen::Index largest = 0;
    for (Eigen::Index i = 1; i < 3; ++i)
      if (abs(w[i].value) > abs(w[largest].value)) largest = i;
    return largest;
  }

  /// Angle about the axis, the next coordinate.
  T turn() {
    const Vector3<T> turned = R_JC_ * normals_[0];
    return unwrapped(atan2(normals_[1].dot(turned), normals_[0].dot(turned)));
  }

  /// The next coordinate: `angle` plus the whole turns that bring it within half a turn of what is expected.
  T unwrapped(const T& angle) const {
    using std::round;
    const Scalar turn = 2 * std::numbers::pi_v<Scalar>;
    return angle + T(turn * round((near_[result_.coordinates.size()] - angle.value) / turn));
  }

  /// Universal joint R = Rot(axis, first) Rot(second_axis, second): the image of the second axis turns about the
  /// first one by the first angle, the first axis seen from the child about the second one by minus the second.
  void measure_cross() {
    const Vector3<T> second = joint_.second_axis.template cast<T>();
    const T cosine(joint_.axis.dot(joint_.second_axis));
    const Vector3<T> across = axis_.cross(second);
    const Vector3<T> second_seen = R_JC_ * second;
    const Vector3<T> first_seen = R_JC_.transpose() * axis_;
    add_constraint(axis_.dot(second_seen) - cosine);
    add_coordinate(unwrapped(atan2(across.dot(second_seen), (second - cosine * axis_).dot(second_seen))));
    add_coordinate(unwrapped(atan2(across.dot(first_seen), (axis_ - cosine * second).dot(first_seen))));
  }

  /// The middle axis is the direction across the outer two, i fixed in the joint frame and k in the child: e_i × w_k is
  /// along it or against it, as the angle near by says. Whether i = k or not decides from where the middle turn counts.
  void measure_gimbal() {
    const auto unit = [](Eigen::Index i) -> Vector3<T> {
      return Vector3<Scalar>::Unit(i).template cast<T>();
    };
    const auto [i, j, k] = joint_.sequence;
    const Vector3<T> e_i = unit(i), e_j = unit(j), e_k = unit(k), w_k = R_JC_ * e_k;
    const bool proper = i == k;
    const T hand = proper ? T(1) : e_i.cross(e_j).dot(e_k);
    using std::cos;
    using std::sin;
    const Scalar across_near = proper ? sin(near_[1]) : -hand.value * cos(near_[1]);
    const T sense(across_near < 0 ? -1 : 1);
    const Vector3<T> middle = sense * e_i.cross(w_k);
    const T across = sense * sqrt(middle.dot(middle)), along = e_i.dot(w_k);
    const Vector3<T> middle_seen = R_JC_.transpose() * middle;
    add_coordinate(unwrapped(atan2(middle.dot(e_i.cross(e_j)), middle.dot(e_j))));
    add_coordinate(unwrapped(proper ? atan2(across, along) : atan2(hand * along, -hand * across)));
    add_coordinate(unwrapped(atan2(middle_seen.dot(e_j.cross(e_k)), middle_seen.dot(e_j))));
  }

  /// The coordinate follows the foot of the perpendicular on the tangent; the origin may not leave the curve across it.
  void measure_curve() {
    const Scalar s0 = near_[0];
    const Vector3<T> probe = curve_point(joint_, T(s0, 1, 0));
    Vector3<Scalar> start, tangent, bend;
    for (Eigen::Index i = 0; i < 3; ++i) {
      start[i] = probe[i].value;
      tangent[i] = probe[i].rate;
      bend[i] = probe[i].acceleration;
    }
    const Vector3<Scalar> foot = tangent / tangent.squaredNorm();
    T s = foot.template cast<T>().dot(p_JC_ - start.template cast<T>()) + T(s0);
    s.acceleration -= foot.dot(bend) * s.rate * s.rate;
    add_coordinate(s);

    const Vector3<T> deviation = p_JC_ - curve_point(joint_, s);
    const Vector3<Scalar> normal = tangent.unitOrthogonal();
    const Vector3<Scalar> binormal = tangent.stableNormalized().cross(normal);
    add_constraint(normal.template cast<T>().dot(deviation));
    add_constraint(binormal.template cast<T>().dot(deviation));
  }

  const Joint<Scalar>& joint_;
  std::span<const Scalar> near_;
  ParallelAxes parallel_axes_;
  Matrix3<T> R_WJ_, R_WC_, R_JC_;
  Vector3<T> p_JC_;
  Vector3<T> axis_;
  Vector3<T> normals_[2];
  Measurement<Scalar> result_;
};

}  // namespace

template <class Scalar>
Joint<Scalar> read_joint(const model::Joint& joint, std::span<const Scalar> parameters, bool snap) {
  Joint<Scalar> result{.type = joint.type,
                       .parent = {},
                       .child = joint.child.value,
                       .R_PJ = rotation_value(joint.placement.rotation, parameters, snap),
                       .p_PJ = vector_value(joint.placement.position, parameters),
                       .axis = unit_vector<Scalar>(joint.axis),
                       .second_axis = unit_vector<Scalar>(joint.second_axis),
                       .normals = {},
                       .pitch = joint.pitch.evaluate(parameters),
                       .sequence = {Eigen::Index(joint.sequence[0]), Eigen::Index(joint.sequence[1]),
                                    Eigen::Index(joint.sequence[2])},
                       .curve = joint.curve,
                       .parameters = {parameters.begin(), parameters.end()}};
  if (joint.parent) result.parent = joint.parent->value;
  result.normals[0] = result.axis.unitOrthogonal();
  result.normals[1] = result.axis.cross(result.normals[0]);
  if (joint.type == JointType::kPlanar) {
    const Vector3<double> n = unit_vector<double>(joint.axis);
    const auto directions = model::plane_axes({n.x(), n.y(), n.z()});
    for (std::size_t i = 0; i < 2; ++i)
      result.normals[i] = Vector3<double>(directions[i].data()).template cast<Scalar>();
  }
  return result;
}

template <class Scalar>
Pose<TimeJet<Scalar>> joint_frame(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent) {
  return parent.moved(joint.R_PJ.template cast<Jet<Scalar>>(), joint.p_PJ.template cast<Jet<Scalar>>());
}

template <class Scalar>
Pose<TimeJet<Scalar>> child_pose(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent,
                                 std::span<const TimeJet<Scalar>> y) {
  using T = Jet<Scalar>;
  Pose<T> frame = joint_frame(joint, parent);
  const Matrix3<T> aligned = Matrix3<T>::Identity();
  const Vector3<T> zero = Vector3<T>::Zero();
  const Vector3<T> axis = joint.axis.template cast<T>();
  switch (joint.type) {
    case JointType::kFixed:
      return frame;
    case JointType::kRevolute:
      return frame.moved(rotation_about<T>(axis, y[0]), zero);
    case JointType::kPrismatic:
      return frame.moved(aligned, axis * y[0]);
    case JointType::kScrew:
      return frame.moved(rotation_about<T>(axis, y[0]), axis * (T(joint.pitch) * y[0]));
    case JointType::kCylindrical:
      return frame.moved(rotation_about<T>(axis, y[0]), axis * y[1]);
    case JointType::kUniversal:
      return frame.moved(rotation_about<T>(axis, y[0]), zero)
          .moved(rotation_about<T>(joint.second_axis.template cast<T>(), y[1]), zero);
    case JointType::kPlanar:
      return frame.moved(rotation_about<T>(axis, y[2]), joint.normals[0].template cast<T>() * y[0] +
                                                            joint.normals[1].template cast<T>() * y[1]);
    case JointType::kCurve:
      return frame.moved(aligned, curve_point(joint, y[0]));
    case JointType::kGimbal:
      for (std::size_t k = 0; k < 3; ++k)
        frame.R_WF *= rotation_about<T>(Vector3<Scalar>::Unit(joint.sequence[k]).template cast<T>(), y[k]);
      return frame;
    case JointType::kPoint:
      return frame.moved(aligned, {y[0], y[1], y[2]});
    case JointType::kSpherical:
    case JointType::kFree:
      break;
  }
  throw support::InternalError("a spherical or free joint has no scalar coordinates");
}

template <class Scalar>
Measurement<Scalar> measure(const Joint<Scalar>& joint, const Pose<TimeJet<Scalar>>& parent,
                            const Pose<TimeJet<Scalar>>& child, std::span<const Scalar> near,
                            ParallelAxes parallel_axes) {
  return Measuring<Scalar>(joint, joint_frame(joint, parent), child, near, parallel_axes).run();
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                                      \
  template Joint<S> read_joint(const model::Joint&, std::span<const S>, bool);                       \
  template Pose<TimeJet<S>> joint_frame(const Joint<S>&, const Pose<TimeJet<S>>&);                   \
  template Pose<TimeJet<S>> child_pose(const Joint<S>&, const Pose<TimeJet<S>>&,                     \
                                       std::span<const TimeJet<S>>);                                 \
  template Measurement<S> measure(const Joint<S>&, const Pose<TimeJet<S>>&, const Pose<TimeJet<S>>&, \
                                  std::span<const S>, ParallelAxes);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference::descriptor
