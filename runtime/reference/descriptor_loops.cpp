#include "reference/descriptor_loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/loop_kinds.hpp"
#include "reference/decompositions.hpp"
#include "reference/descriptor_rows.hpp"
#include "support/check.hpp"

namespace jourdain::reference::descriptor {

namespace {

using model::LoopType;

template <class Scalar>
void read_direction(const std::array<double, 3>& given, Vector3<Scalar>& axis,
                    Vector3<Scalar> (&normals)[2]) {
  const Vector3<double> n = Vector3<double>(given.data()).stableNormalized();
  const auto across = model::plane_axes({n.x(), n.y(), n.z()});
  axis = Vector3<double>(given.data()).template cast<Scalar>().stableNormalized();
  for (std::size_t i = 0; i < 2; ++i) normals[i] = Vector3<double>(across[i].data()).template cast<Scalar>();
}

/// A row: g, or what is kept at zero where velocities alone are bound; its last derivative is not known then.
template <class Scalar>
struct Row {
  TimeJet<Scalar> value;
  bool is_velocity = false;
};

template <class Scalar>
TimeJet<Scalar> rate_of(const TimeJet<Scalar>& x) {
  return {x.rate, x.acceleration, 0};
}

/// Writes down the rows of loops where all bodies move as given.
template <class Scalar>
class Closing {
 public:
  using T = TimeJet<Scalar>;
  using Direction = Vector3<T>;
  using Rotation = Matrix3<T>;

  Closing(const Parts<Scalar>& parts, const std::vector<Pose<T>>& bodies, const T& time,
          const std::vector<std::vector<Scalar>>& near)
      : parts_(parts), bodies_(bodies), time_(time), near_(near) {}

  std::vector<Row<Scalar>> run() {
    for (const Loop<Scalar>& loop : parts_.loops) add(loop);
    return std::move(rows_);
  }

 private:
  /// A loop's frames at present, all in inertial components.
  struct Ends {
    Direction delta, n, a[2], w, b[2];
  };

  Pose<T> body(const std::optional<std::size_t>& index) const { return index ? bodies_[*index] : Pose<T>(); }
  Pose<T> frame(std::size_t index) const {
    const Frame<Scalar>& frame = parts_.frames[index];
    return body(frame.body).moved(frame.R_BF.template cast<T>(), frame.p_BF.template cast<T>());
  }

  Ends ends(const Loop<Scalar>& loop) const {
    const Pose<T> from = frame(loop.from), to = frame(loop.to);
    const auto seen = [](const Pose<T>& pose, const Vector3<Scalar>& direction) {
      return Direction(pose.R_WF * direction.template cast<T>());
    };
    return {.delta = to.p_WF - from.p_WF,
            .n = seen(from, loop.axis),
            .a = {seen(from, loop.normals[0]), seen(from, loop.normals[1])},
            .w = seen(to, loop.to_axis),
            .b = {seen(to, loop.to_normals[0]), seen(to, loop.to_normals[1])}};
  }

  void add(const Loop<Scalar>& loop) {
    if (loop.type == LoopType::kResidual) return add_row(value(loop.residual));
    if (loop.type == LoopType::kVelocity) return add_velocity(value(loop.residual));
    const Ends at = ends(loop);
    switch (loop.type) {
      case LoopType::kBall:
        points_coincide(loop, at);
        break;
      case LoopType::kRevolute:
        points_coincide(loop, at);
        for (const Direction& a : at.a) add_row(a.dot(at.w));
        break;
      case LoopType::kUniversal:
        points_coincide(loop, at);
        add_row(at.n.dot(at.w));
        break;
      case LoopType::kPrismatic:
      case LoopType::kCylindrical:
        for (const Direction& a : at.a) add_row(a.dot(at.delta));
        for (const Direction& a : at.a) add_row(a.dot(at.w));
        if (loop.type == LoopType::kPrismatic) add_row(at.a[0].dot(at.b[1]));
        break;
      case LoopType::kPlanarPin:
        for (const Vector3<Scalar>& c : loop.normals)
          add_row((body(loop.carrier).R_WF * c.template cast<T>()).dot(at.delta));
        break;
      case LoopType::kPointInPlane:
        add_row(at.n.dot(at.delta));
        break;
      case LoopType::kPointOnLine:
        for (const Direction& a : at.a) add_row(a.dot(at.delta));
        break;
      case LoopType::kRod: {
        const T length = value(loop.length);
        add_row((at.delta.dot(at.delta) - length * length) / (T(2) * length));
        break;
      }
      case LoopType::kKnifeEdge:
        add_velocity(at.w.dot(slip(loop, at.delta, Direction(T(0), T(0), T(0)))));
        break;
      case LoopType::kRollingWheel:
      case LoopType::kRollingBall:
      case LoopType::kRollingEllipsoid:
        if (loop.height.is_zero())
          touch(loop, at, at.n, at.a, lowest(loop, at, at.n));
        else
          touch_ground(loop, at);
        break;
      case LoopType::kResidual:
      case LoopType::kVelocity:
        break;
    }
  }

  /// From the centre to where it is lowest over a plane with the normal n.
  Direction lowest(const Loop<Scalar>& loop, const Ends& at, const Direction& n) const {
    if (loop.type == LoopType::kRollingBall) return n * -value(loop.length);
    if (loop.type == LoopType::kRollingEllipsoid) return lowest_of_ellipsoid(loop, n);
    const Direction along = n - at.w * n.dot(at.w);
    return along * (-value(loop.length) / sqrt(along.dot(along)));
  }

  /// Of an ellipsoid x·S⁻² x = 1 in its own axes, S of its radii: −S m/|m| with m = S n.
  Direction lowest_of_ellipsoid(const Loop<Scalar>& loop, const Direction& n) const {
    const Pose<T> to = frame(loop.to);
    Direction m = to.R_WF.transpose() * n;
    for (Eigen::Index k = 0; k < 3; ++k) m[k] *= value(loop.radii[std::size_t(k)]);
    const T size = sqrt(m.dot(m));
    for (Eigen::Index k = 0; k < 3; ++k) m[k] *= -value(loop.radii[std::size_t(k)]) / size;
    return to.R_WF * m;
  }

  /// The point at `lever` from the origin of `to` is in a plane through `foot`, which leads from the origin of `from`,
  /// and does not slip.
  void touch(const Loop<Scalar>& loop, const Ends& at, const Direction& n,
             std::span<const Direction, 2> along, const Direction& lever,
             const Direction& foot = Direction(T(0), T(0), T(0))) {
    add_row(n.dot(at.delta + lever - foot));
    const Direction v = slip(loop, at.delta, lever);
    for (const Direction& a : along) add_velocity(a.dot(v));
  }

  /// Of ground: the height there, and the slopes along a₁ and a₂.
  struct Ground {
    T height, slopes[2];
  };

  Ground ground(const Loop<Scalar>& loop, const T (&place)[2]) const {
    using Along = TimeJet<T>;  // along a line of the plane in place of time
    const std::vector<Along> parameters(parts_.parameters.begin(), parts_.parameters.end());
    Ground result;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto height = loop.height.template evaluate<Along>(
          parameters, [](double literal) { return Along(T(Scalar(literal))); },
          [&](const model::Variable& v) -> Along {
            const auto k = Eigen::Index(v.component);
            const T point = place[0] * T(loop.normals[0][k]) + place[1] * T(loop.normals[1][k]);
            return Along(point, T(loop.normals[i][k]), T(0));
          });
      result.height = height.value;
      result.slopes[i] = height.rate;
    }
    return result;
  }

  /// The point p of the plane over which the ground is touched is that under the centre and under the lever there: each
  /// time closer by radius times curvature, until rounding moves it.
  void touch_ground(const Loop<Scalar>& loop, const Ends& at) {
    constexpr int kMost = 2000;
    const Scalar rounding = Scalar(4) * std::numeric_limits<Scalar>::epsilon(), nearly = sqrt(rounding);
    T place[2] = {at.a[0].dot(at.delta), at.a[1].dot(at.delta)};
    const T under[2] = {place[0], place[1]};
    Direction n, lever;
    Ground here;
    Scalar before = std::numeric_limits<Scalar>::max();
    for (int i = 0; i < kMost; ++i) {
      here = ground(loop, place);
      const Direction m = at.n - at.a[0] * here.slopes[0] - at.a[1] * here.slopes[1];
      n = m / sqrt(m.dot(m));
      lever = lowest(loop, at, n);
      Scalar moved = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        const T next = under[k] + at.a[k].dot(lever);
        moved = std::max(moved, share_moved(place[k], next));
        place[k] = next;
      }
      if (moved <= rounding || (moved <= nearly && moved >= before)) break;
      before = moved;
    }
    const Direction level = at.a[0] - n * n.dot(at.a[0]), first = level / sqrt(level.dot(level));
    const Direction along[2] = {first, n.cross(first)};
    touch(loop, at, n, along, lever, at.a[0] * place[0] + at.a[1] * place[1] + at.n * here.height);
  }

  /// The largest change of a number and its derivatives, each over one more than its size.
  static Scalar share_moved(const T& before, const T& after) {
    const auto size = [](const Scalar& x) { return x < 0 ? -x : x; };
    const auto share = [&](const Scalar& a, const Scalar& b) { return size(b - a) / (Scalar(1) + size(b)); };
    return std::max({share(before.value, after.value), share(before.rate, after.rate),
                     share(before.acceleration, after.acceleration)});
  }

  /// How fast the body of `to` passes the body of `from` at `lever` from the origin of `to`.
  Direction slip(const Loop<Scalar>& loop, const Direction& delta, const Direction& lever) const {
    const Pose<T> from = frame(loop.from), to = frame(loop.to);
    return carried(to, lever) - carried(from, delta + lever);
  }

  /// Velocity of what is fixed to a frame at `lever` from its origin.
  static Direction carried(const Pose<T>& frame, const Direction& lever) {
    return frame.p_WF.unaryExpr(&rate_of<Scalar>) +
           frame.R_WF.unaryExpr(&rate_of<Scalar>) * (frame.R_WF.transpose() * lever);
  }

  void add_row(const T& g) { rows_.push_back({g}); }
  void add_velocity(const T& v) { rows_.push_back({v, true}); }

  void points_coincide(const Loop<Scalar>& loop, const Ends& at) {
    const Direction components = body(loop.carrier).R_WF.transpose() * at.delta;
    for (const T& component : components) add_row(component);
  }

  /// A joint's scalar coordinate as the bodies' poses have it.
  T coordinate(std::size_t joint, std::size_t which) const {
    const Joint<Scalar>& at = parts_.joints[joint];
    return measure(at, body(at.parent), bodies_[at.child], std::span<const Scalar>(near_[joint]),
                   ParallelAxes::kFixedNormals)
        .coordinates.at(which);
  }

  T value(const model::Expression& expression) const {
    using Kind = model::Variable::Kind;
    const std::vector<T> parameters(parts_.parameters.begin(), parts_.parameters.end());
    return expression.evaluate<T>(
        parameters, [](double literal) { return T(Scalar(literal)); },
        [&](const model::Variable& v) -> T {
          if (v.kind == Kind::kTime) return time_;
          if (v.kind == Kind::kPosition) return coordinate(v.index, v.component);
          if (v.kind == Kind::kVelocity) return rate_of(coordinate(v.index, v.component));
          const Pose<T> at = frame(v.index);
          if (v.kind == Kind::kFramePosition) return at.p_WF[Eigen::Index(v.component)];
          if (v.kind == Kind::kFrameDirection)
            return at.R_WF(Eigen::Index(v.component / 3), Eigen::Index(v.component % 3));
          if (v.kind == Kind::kFrameVelocity) return rate_of(at.p_WF[Eigen::Index(v.component)]);
          const Rotation R_rate = at.R_WF.unaryExpr(&rate_of<Scalar>);
          if (v.kind == Kind::kFrameSpin) return spin(at.R_WF.transpose() * R_rate, v.component);
          JD_CHECK(v.kind == Kind::kFrameWorldSpin, "a loop depends on variable kind {}", int(v.kind));
          return spin(R_rate * at.R_WF.transpose(), v.component);
        });
  }

  /// Of a skew matrix the vector that it multiplies with.
  static T spin(const Rotation& skew, std::size_t component) {
    const auto k = Eigen::Index(component);
    return skew((k + 2) % 3, (k + 1) % 3);
  }

  const Parts<Scalar>& parts_;
  const std::vector<Pose<T>>& bodies_;
  T time_;
  const std::vector<std::vector<Scalar>>& near_;
  std::vector<Row<Scalar>> rows_;
};

}  // namespace

template <class Scalar>
std::vector<Loop<Scalar>> read_loops(const model::Mechanism& mechanism) {
  std::vector<Loop<Scalar>> loops;
  for (const model::Loop& given : mechanism.loops) {
    Loop<Scalar>& loop = loops.emplace_back();
    loop.type = given.type;
    read_direction<Scalar>(given.axis, loop.axis, loop.normals);
    read_direction<Scalar>(given.to_axis, loop.to_axis, loop.to_normals);
    loop.length = given.length;
    loop.residual = given.residual;
    loop.radii = given.radii;
    loop.height = given.height;
    if (!model::loop_kind(given).has_ends()) continue;
    loop.from = given.from.value;
    loop.to = given.to.value;
    const auto carrier =
        model::carrier(mechanism, mechanism.frames[loop.from].body, mechanism.frames[loop.to].body);
    if (carrier) loop.carrier = carrier->value;
  }
  return loops;
}

template <class Scalar>
LoopRows<Scalar> loop_rows(const Parts<Scalar>& parts, Scalar t,
                           const std::vector<AbsoluteBody<Scalar>>& motions,
                           const std::vector<std::vector<Scalar>>& near) {
  using T = TimeJet<Scalar>;
  const std::size_t count = parts.bodies.size();
  std::vector<Pose<T>> moving, resting;
  for (std::size_t b = 0; b < count; ++b) {
    Velocity<Scalar> velocity;
    velocity << motions[b].v_C, motions[b].omega;
    moving.push_back(coasting(parts.bodies[b], motions[b], velocity));
    resting.push_back(coasting<Scalar>(parts.bodies[b], motions[b], Velocity<Scalar>::Zero()));
  }
  const std::vector<Row<Scalar>> rows = Closing<Scalar>(parts, moving, T(t, 1, 0), near).run();
  const auto size = Eigen::Index(rows.size());
  LoopRows<Scalar> result{.jacobian = Eigen::MatrixX<Scalar>::Zero(size, 6 * Eigen::Index(count)),
                          .value = Eigen::VectorX<Scalar>(size),
                          .rate = Eigen::VectorX<Scalar>(size),
                          .gamma = Eigen::VectorX<Scalar>(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto& [row, is_velocity] = rows[std::size_t(i)];
    result.value[i] = is_velocity ? Scalar(0) : row.value;
    result.rate[i] = is_velocity ? row.value : row.rate;
    result.gamma[i] = is_velocity ? row.rate : row.acceleration;
  }
  if (size == 0) return result;
  const std::vector<Row<Scalar>> at_rest = Closing<Scalar>(parts, resting, T(t), near).run();
  // Time stands still while one body moves in one direction.
  for (std::size_t b = 0; b < count; ++b) {
    const Pose<T> pose = resting[b];
    for (Eigen::Index k = 0; k < 6; ++k) {
      resting[b] = coasting<Scalar>(parts.bodies[b], motions[b], Velocity<Scalar>::Unit(k));
      const std::vector<Row<Scalar>> column = Closing<Scalar>(parts, resting, T(t), near).run();
      for (std::size_t i = 0; i < column.size(); ++i)
        result.jacobian(Eigen::Index(i), 6 * Eigen::Index(b) + k) =
            column[i].is_velocity ? column[i].value.value - at_rest[i].value.value : column[i].value.rate;
    }
    resting[b] = pose;
  }
  return result;
}

template <class Scalar>
Eigen::MatrixX<Scalar> independent_combinations(const Eigen::MatrixX<Scalar>& joint_rows,
                                                const Eigen::MatrixX<Scalar>& loop_rows, double dependent) {
  using Matrix = Eigen::MatrixX<Scalar>;
  const Eigen::Index freedom = joint_rows.cols() - joint_rows.rows();
  Matrix motions = Matrix::Identity(joint_rows.cols(), joint_rows.cols());
  if (joint_rows.rows() > 0) motions = orthogonal_factor<Scalar>(joint_rows.transpose());
  Eigen::VectorX<Scalar> scales = loop_rows.rowwise().norm();
  for (Scalar& scale : scales) scale = scale > 0 ? 1 / scale : Scalar(1);
  const Matrix seen = scales.asDiagonal() * loop_rows * motions.rightCols(freedom);
  if (seen.size() == 0) return Matrix(0, loop_rows.rows());
  // A state that has run away has no rank: its accelerations are no numbers either way.
  if (!seen.allFinite()) return Matrix::Identity(loop_rows.rows(), loop_rows.rows());
  return range<Scalar>(seen, Scalar(dependent)).transpose() * scales.asDiagonal();
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type takes none
#define JOURDAIN_INSTANTIATE(S)                                                                           \
  template std::vector<Loop<S>> read_loops(const model::Mechanism&);                                      \
  template LoopRows<S> loop_rows(const Parts<S>&, S, const std::vector<AbsoluteBody<S>>&,                 \
                                 const std::vector<std::vector<S>>&);                                     \
  template Eigen::MatrixX<S> independent_combinations(const Eigen::MatrixX<S>&, const Eigen::MatrixX<S>&, \
                                                      double);
JOURDAIN_INSTANTIATE(JOURDAIN_SCALAR)
#undef JOURDAIN_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace jourdain::reference::descriptor
