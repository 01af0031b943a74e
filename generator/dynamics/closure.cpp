#include "dynamics/closure.hpp"

#include "dynamics/applied_forces.hpp"
#include "dynamics/points.hpp"
#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using model::Loop;
using model::LoopType;

namespace {

/// A frame seen from a link further in: its origin and directions fixed to it, in W of that link.
class SeenFrame {
 public:
  SeenFrame(Scene& scene, const model::Frame& frame, std::size_t ancestor, const std::string& name)
      : scene_(scene), pose_(frame_pose(scene, frame)), ancestor_(ancestor), name_(name) {}

  Vector3 position() const { return follow_point(scene_, pose_.link, pose_.r_LB, ancestor_, name_).position; }

  /// Of a direction given in the frame.
  Vector3 direction(const Vector3& given) const {
    const Vector3 v_L = kinematics::settled(pose_.R_LB * given);
    Vector3 v = scene_.frames.to_working(pose_.link, v_L, name_ + "d");
    for (std::size_t j = pose_.link; j != ancestor_; j = scene_.tree.links[j].parent)
      v = scene_.frames.to_parent(j, v, name_ + "d");
    return v;
  }

  Scene& scene_;
  kinematics::BodyPose pose_;
  std::size_t ancestor_;
  std::string name_;
};

using Axes = std::array<Vector3, 2>;

/// plane_axes of a unit vector with 60 digits: doubles would leave axes that are orthogonal to 1e-16 only.
Axes plane_axes(const std::array<double, 3>& axis) {
  const Vector3 n = kinematics::unit_vector(axis);
  for (std::size_t k = 0; k < 3; ++k)
    if (n[k].is_equal(1)) {
      Axes axes = {kinematics::zero_vector(), kinematics::zero_vector()};
      axes[0][(k + 1) % 3] = axes[1][(k + 2) % 3] = 1;
      return axes;
    }
  if (n[2].is_equal(-1)) return {Vector3{1, 0, 0}, Vector3{0, -1, 0}};
  const Vector3 across = kinematics::cross({0, 0, 1}, n);
  const Ex length = kinematics::square_root(dot(across, across));
  const Vector3 first = Ex(1 / length) * across;
  return {first, kinematics::cross(n, first)};
}

class Closure {
 public:
  explicit Closure(Scene& scene) : scene_(scene) {}

  LoopClosure close(const Loop& loop) {
    if (loop.type == LoopType::kResidual)
      return {{general_value(scene_, loop.name, loop.residual, Inputs::kZero)}, {}, {}};
    const model::Frame &from = scene_.mechanism.frames[loop.from.value],
                       &to = scene_.mechanism.frames[loop.to.value];
    const std::size_t ancestor = common_ancestor(scene_.tree, link_of(from.body), link_of(to.body));
    const SeenFrame a(scene_, from, ancestor, loop.name + "a"), b(scene_, to, ancestor, loop.name + "b");
    const Vector3 difference = scene_.statements.bind(loop.name + "d", b.position() - a.position());
    const std::optional<model::BodyIndex> carrier = model::carrier(scene_.mechanism, from.body, to.body);
    std::vector<Ex> g, senses;
    std::vector<RowGradient> gradients;
    const auto apart = [&](const Vector3& along) {  // a direction fixed in `from`
      g.push_back(dot(along, difference));
      gradients.push_back({.place = along, .turn_from = kinematics::cross(along, difference)});
    };
    const auto apart_in_carrier = [&](const std::vector<Vector3>& axes) {
      const Vector3 seen = in_carrier(carrier, difference, loop.name);
      for (const Vector3& axis : axes) {
        const Vector3 along = from_carrier(carrier, axis, loop.name);
        g.push_back(dot(axis, seen));
        gradients.push_back({.place = along, .turn_carrier = kinematics::cross(along, difference)});
      }
    };
    const auto across = [&](const Vector3& fixed_in_from, const Vector3& fixed_in_to) {
      const Vector3 turn = kinematics::cross(fixed_in_from, fixed_in_to);
      g.push_back(dot(fixed_in_from, fixed_in_to));
      gradients.push_back({.turn_from = turn, .turn_to = Ex(-1) * turn});
    };
    const auto coincide = [&] { apart_in_carrier({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}); };
    const Axes from_axes = plane_axes(loop.axis), to_axes = plane_axes(loop.to_axis);
    const auto n = [&] { return a.direction(kinematics::unit_vector(loop.axis)); };
    const auto w = [&] { return b.direction(kinematics::unit_vector(loop.to_axis)); };
    const auto points_apart = [&] {
      for (const Vector3& axis : from_axes) apart(a.direction(axis));
    };
    const auto parallel = [&] {
      for (const Vector3& axis : from_axes) across(a.direction(axis), w());
      senses = {dot(n(), w())};
    };
    switch (loop.type) {
      case LoopType::kBall:
        coincide();
        break;
      case LoopType::kRevolute:
        coincide();
        parallel();
        break;
      case LoopType::kUniversal:
        coincide();
        across(n(), w());
        break;
      case LoopType::kPrismatic:
        points_apart();
        parallel();
        across(a.direction(from_axes[0]), b.direction(to_axes[1]));
        senses.push_back(dot(a.direction(from_axes[0]), b.direction(to_axes[0])));
        break;
      case LoopType::kCylindrical:
        points_apart();
        parallel();
        break;
      case LoopType::kPlanarPin:
        apart_in_carrier({from_axes[0], from_axes[1]});
        break;
      case LoopType::kPointInPlane:
        apart(n());
        break;
      case LoopType::kPointOnLine:
        points_apart();
        break;
      case LoopType::kRod: {
        const Ex length = general_value(scene_, loop.name + "l", loop.length, Inputs::kZero);
        const Ex square = scene_.statements.bind(loop.name + "ll", dot(difference, difference));
        g.push_back((square - length * length) / (2 * length));
        gradients.push_back({.place = Ex(1 / length) * difference});
        break;
      }
      case LoopType::kResidual:
        break;
    }
    for (Ex& row : g) row = scene_.statements.bind("g_" + loop.name, kinematics::settled(row));
    for (Ex& sense : senses) sense = scene_.statements.bind("sense_" + loop.name, kinematics::settled(sense));
    return {g, senses, gradients};
  }

 private:
  std::size_t link_of(std::optional<model::BodyIndex> body) const {
    return body ? scene_.tree.bodies[body->value].link : kGround;
  }

  /// Components in the carrier's axes of a vector in W of the carrier's link.
  Vector3 in_carrier(std::optional<model::BodyIndex> carrier, const Vector3& v, const std::string& name) {
    if (!carrier) return v;
    const kinematics::BodyPose& pose = scene_.tree.bodies[carrier->value];
    const Vector3 v_L = scene_.frames.to_link(pose.link, v, name + "c");
    return scene_.statements.bind(name + "c", transpose(pose.R_LB) * v_L);
  }

  /// The way back.
  Vector3 from_carrier(std::optional<model::BodyIndex> carrier, const Vector3& v, const std::string& name) {
    if (!carrier) return v;
    const kinematics::BodyPose& pose = scene_.tree.bodies[carrier->value];
    return scene_.frames.to_working(pose.link, scene_.statements.bind(name + "e", pose.R_LB * v), name + "e");
  }

  Scene& scene_;
};

}  // namespace

std::vector<LoopClosure> derive_closure(Scene& scene) {
  std::vector<LoopClosure> closures;
  for (const Loop& loop : scene.mechanism.loops) closures.push_back(Closure(scene).close(loop));
  return closures;
}

}  // namespace jourdain::dynamics
