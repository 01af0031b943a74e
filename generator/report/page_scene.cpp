#include "report/page_scene.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace jourdain::report {

namespace {

using Json = nlohmann::ordered_json;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using model::Numbers3;

constexpr double kFrameInterval = 0.02;      ///< s, of the animation
constexpr std::size_t kMostNumbers = 40000;  ///< of all frames together: the page stays small
constexpr std::size_t kNumbersPerBody = 7;   ///< position, quaternion
constexpr double kInPlane = 1e-6;            ///< turns (rad) and relative displacements that nobody sees

struct Pose {
  Vector3d r;  ///< m, inertial frame
  Matrix3d R;  ///< body to inertial
};
using Frame = std::vector<Pose>;  ///< by body

Vector3d vector(const Numbers3& v) { return {v[0], v[1], v[2]}; }

Frame frame_at(const studies::Flow<double>& flow, const studies::Point<double>& point, std::size_t bodies) {
  const jourdain_model_table& table = flow.table();
  std::vector<double> u(static_cast<std::size_t>(table.input_count)),
      values(static_cast<std::size_t>(table.output_count));
  table.outputs(&point.t, point.x.data(), point.x.data() + table.position_count, u.data(), values.data());
  Frame frame;
  for (std::size_t b = 0; b < bodies; ++b) {
    const double* pose = values.data() + 12 * b;
    frame.push_back({Eigen::Map<const Vector3d>(pose),
                     Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose + 3)});
  }
  return frame;
}

/// Of the reference's intervals, between two frames.
std::size_t stride_of(const studies::ReferenceSolution& reference, std::size_t bodies) {
  const std::size_t most = std::max<std::size_t>(2, kMostNumbers / (kNumbersPerBody * bodies));
  return std::max({std::size_t{1}, reference.points.size() / most + 1,
                   static_cast<std::size_t>(std::lround(kFrameInterval / reference.interval))});
}

/// Do all bodies move at right angles to `n`, and turn about it only?
bool is_normal(const Vector3d& n, const std::vector<Frame>& frames) {
  double moved = 0, left = 0, tilted = 0;
  for (const Frame& frame : frames)
    for (std::size_t b = 0; b < frame.size(); ++b) {
      const Vector3d d = frame[b].r - frames[0][b].r;
      moved = std::max(moved, d.norm());
      left = std::max(left, std::fabs(d.dot(n)));
      tilted = std::max(tilted, (frame[b].R * (frames[0][b].R.transpose() * n) - n).norm());
    }
  return left <= kInPlane * moved && tilted <= kInPlane;
}

/// Of the plane in which everything moves; none where there is no such plane.
std::optional<Vector3d> plane_normal(const Figure& figure, const std::vector<Frame>& frames) {
  const Vector3d g = vector(figure.gravity);
  std::vector<Vector3d> candidates;
  for (const FigureJoint& joint : figure.joints) {
    if (!joint.turns || vector(joint.axis).isZero()) continue;
    const Vector3d axis = vector(joint.axis);
    candidates.push_back(joint.at.body ? Vector3d(frames[0][*joint.at.body].R * axis) : axis);
  }
  if (!figure.flies)
    for (const Eigen::Index i : {1, 2, 0})
      if (std::fabs(g[i]) <= kInPlane * g.norm()) candidates.push_back(Vector3d::Unit(i));
  for (const Vector3d& n : candidates)
    if (is_normal(n, frames)) return n;
  return {};
}

/// To the right, away from the reader, up: a right-handed system.
struct Axes {
  Vector3d across, away, up;
};

/// Seen along `n`, gravity down as far as that goes.
Axes front_axes(const Vector3d& n, const Vector3d& g) {
  Vector3d up = -(g - g.dot(n) * n);
  if (up.norm() <= 0.1 * g.norm()) {
    const Vector3d along = std::fabs(n.y()) > 0.9 ? Vector3d::UnitZ() : Vector3d::UnitY();
    up = along - along.dot(n) * n;
  }
  up.normalize();
  Vector3d across = n.cross(up);
  Eigen::Index largest = 0;
  across.cwiseAbs().maxCoeff(&largest);
  if (across[largest] < 0) across = -across;
  return {across, up.cross(across), up};
}

/// Up is against gravity, across the inertial axis that is nearest to level.
Axes spatial_axes(const Vector3d& g) {
  const Vector3d up = g.isZero() ? Vector3d(Vector3d::UnitZ()) : Vector3d(-g.normalized());
  const Vector3d along = std::fabs(up.x()) > 0.9 ? Vector3d::UnitY() : Vector3d::UnitX();
  const Vector3d across = (along - along.dot(up) * up).normalized();
  return {across, up.cross(across), up};
}

/// Five digits, and none of what is zero but for rounding: more cannot be seen.
double rounded(double value) {
  if (std::fabs(value) < 1e-9) return 0;
  const double unit = std::pow(10, std::floor(std::log10(std::fabs(value))) - 4);
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
}

template <class Vector>
Json list(const Vector& values) {
  Json result = Json::array();
  for (const double value : values) result.push_back(rounded(value));
  return result;
}

Json frame_json(const Frame& frame, std::vector<Eigen::Quaterniond>& last) {
  Json result = Json::array();
  for (std::size_t b = 0; b < frame.size(); ++b) {
    Eigen::Quaterniond q(frame[b].R);
    if (q.dot(last[b]) < 0) q.coeffs() = -q.coeffs();  // of the two, the one next to the last frame's
    last[b] = q;
    for (const double value : {frame[b].r.x(), frame[b].r.y(), frame[b].r.z(), q.w(), q.x(), q.y(), q.z()})
      result.push_back(rounded(value));
  }
  return result;
}

Json frames_json(const std::vector<Frame>& frames) {
  std::vector<Eigen::Quaterniond> last(frames[0].size(), Eigen::Quaterniond::Identity());
  Json result = Json::array();
  for (const Frame& frame : frames) result.push_back(frame_json(frame, last));
  return result;
}

/// Body −1 is the world.
Json point_json(const FigurePoint& point) {
  return {{"body", point.body ? static_cast<long>(*point.body) : -1L}, {"at", list(point.position)}};
}

Json body_json(const FigureBody& body) {
  return {{"name", body.name}, {"mass", rounded(body.mass)}, {"center", list(body.center)}};
}

Json line_json(const FigureLine& line) {
  static constexpr const char* kKinds[] = {"body", "slide", "spring"};
  return {{"kind", kKinds[static_cast<int>(line.kind)]},
          {"from", point_json(line.from)},
          {"to", point_json(line.to)}};
}

Json shape_json(const FigureShape& shape) {
  static constexpr const char* kKinds[] = {"box", "cylinder", "sphere", "rod"};
  return {{"kind", kKinds[static_cast<int>(shape.kind)]},
          {"body", shape.body},
          {"center", list(shape.center)},
          {"rows", {list(shape.R_BS[0]), list(shape.R_BS[1]), list(shape.R_BS[2])}},
          {"size", list(shape.size)},
          {"radius", rounded(shape.radius)},
          {"length", rounded(shape.length)},
          {"axis", shape.axis}};
}

Json joint_json(const FigureJoint& joint) {
  return {{"point", point_json(joint.at)},
          {"axis", list(joint.axis)},
          {"turns", joint.turns},
          {"slides", joint.slides},
          {"child", joint.child ? static_cast<long>(*joint.child) : -1L}};
}

/// Lines of ground where bodies are, and a little further; in a plane that is seen from along `across`, one.
class GroundLines {
 public:
  GroundLines(const FigureGround& ground, const std::vector<Frame>& frames,
              const std::optional<Vector3d>& across)
      : ground_(ground) {
    double clearance = std::numeric_limits<double>::infinity();
    for (const Frame& frame : frames)
      for (const std::size_t b : ground.touching) {
        const Vector3d p = seen(frame, frame[b].r) - vector(ground.point);
        for (std::size_t i = 0; i < 2; ++i) {
          const double x = p.dot(vector(ground.along[i]));
          low_[i] = std::min(low_[i], x);
          high_[i] = std::max(high_[i], x);
        }
        clearance = std::min(clearance, std::fabs(p.dot(vector(ground.normal))));
      }
    const double widest = std::max(high_[0] - low_[0], high_[1] - low_[1]);
    const double margin = std::max({0.1 * widest, 2 * clearance, 1e-3});
    gap_ = std::clamp(clearance, (widest + 2 * margin) / 30, (widest + 2 * margin) / 10);
    for (std::size_t i = 0; i < 2; ++i) {
      const bool is_seen =
          !across || std::fabs(vector(ground.along[i]).dot(*across)) < 1 - kInPlane || ground.body;
      if (!is_seen) continue;
      low_[i] -= margin;
      high_[i] += margin;
    }
  }

  Json json() const {
    Json lines = Json::array();
    for (const std::size_t along : {0, 1}) {
      if (high_[along] - low_[along] < gap_) continue;
      const std::size_t count = steps(1 - along, gap_);
      for (std::size_t k = 0; k <= count; ++k) lines.push_back(line(along, at(1 - along, k, count)));
    }
    return {{"body", ground_.body ? static_cast<long>(*ground_.body) : -1L}, {"lines", lines}};
  }

 private:
  Vector3d seen(const Frame& frame, const Vector3d& r) const {
    if (!ground_.body) return r;
    const Pose& pose = frame[*ground_.body];
    return pose.R.transpose() * (r - pose.r);
  }

  std::size_t steps(std::size_t axis, double length) const {
    return static_cast<std::size_t>(std::ceil((high_[axis] - low_[axis]) / length));
  }
  double at(std::size_t axis, std::size_t k, std::size_t count) const {
    if (count == 0) return low_[axis];
    return low_[axis] + (high_[axis] - low_[axis]) * static_cast<double>(k) / static_cast<double>(count);
  }

  /// A list of points, of those where there is a height.
  Json line(std::size_t along, double other) const {
    Json points = Json::array();
    const std::size_t count = ground_.height ? steps(along, gap_ / 2) : 1;
    for (std::size_t k = 0; k <= count; ++k) {
      const double x = at(along, k, count), a = along == 0 ? x : other, b = along == 0 ? other : x;
      const double height = ground_.height ? ground_.height(a, b) : 0;
      const Vector3d p = vector(ground_.point) + a * vector(ground_.along[0]) + b * vector(ground_.along[1]) +
                         height * vector(ground_.normal);
      if (p.allFinite()) points.push_back(list(p));
    }
    return points;
  }

  const FigureGround& ground_;
  double low_[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
         high_[2] = {-low_[0], -low_[1]}, gap_ = 1;
};

template <class Entry>
Json all(const std::vector<Entry>& entries, Json (*one)(const Entry&)) {
  Json result = Json::array();
  for (const Entry& entry : entries) result.push_back(one(entry));
  return result;
}

/// No end tag of a script may stand in a string.
std::string for_script(std::string text) {
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string scene_json(const studies::Flow<double>& flow, const studies::Study& study, const Figure& figure) {
  const studies::ReferenceSolution& reference = study.reference;
  const std::size_t stride = stride_of(reference, figure.bodies.size());
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < reference.points.size(); k += stride)
    frames.push_back(frame_at(flow, reference.points[k], figure.bodies.size()));
  const Vector3d g = vector(figure.gravity);
  const std::optional<Vector3d> normal = plane_normal(figure, frames);
  const Axes axes = normal ? front_axes(*normal, g) : spatial_axes(g);
  Json grounds = Json::array();
  for (const FigureGround& ground : figure.grounds)
    grounds.push_back(GroundLines(ground, frames, normal).json());
  const Json scene = {{"interval", reference.interval * static_cast<double>(stride)},
                      {"duration", study.judged},
                      {"planar", normal.has_value()},
                      {"flies", figure.flies},
                      {"axes", {list(axes.across), list(axes.away), list(axes.up)}},
                      {"gravity", list(figure.gravity)},
                      {"bodies", all(figure.bodies, body_json)},
                      {"lines", all(figure.lines, line_json)},
                      {"shapes", all(figure.shapes, shape_json)},
                      {"joints", all(figure.joints, joint_json)},
                      {"grounds", grounds},
                      {"frames", frames_json(frames)}};
  return for_script(scene.dump());
}

}  // namespace jourdain::report
