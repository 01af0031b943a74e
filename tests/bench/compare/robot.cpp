#include "bench/compare/robot.hpp"

#include <cmath>
#include <map>
#include <stdexcept>

#include "model/read/read.hpp"
#include "support/files.hpp"

namespace jourdain::compare {

using model::Matrix3;
using model::Numbers3;

namespace {

/// Where a body lies in the moving link that carries it.
struct Carried {
  int link = -1;
  Matrix3 rotation = model::kIdentity3;
  Numbers3 position{};
};

class Reader {
 public:
  explicit Reader(const model::Mechanism& mechanism)
      : mechanism_(mechanism), values_(model::default_values(mechanism)) {}

  Robot read() {
    Robot robot;
    robot.gravity = numbers(mechanism_.gravity);
    for (const model::JointIndex index : model::depth_first(mechanism_)) {
      const model::Joint& joint = mechanism_.joints[index.value];
      const Carried parent = joint.parent ? carried_.at(joint.parent->value) : Carried{};
      Carried child{
          parent.link, model::product(parent.rotation, rotation(joint.placement.rotation)),
          model::sum(parent.position, model::product(parent.rotation, numbers(joint.placement.position)))};
      if (joint.type != model::JointType::kFixed) {
        robot.links.push_back(moving_link(joint, child));
        child = {static_cast<int>(robot.links.size()) - 1, model::kIdentity3, {}};
      }
      carried_[joint.child.value] = child;
      if (child.link >= 0) add(mechanism_.bodies[joint.child.value], child, robot.links[index_of(child)]);
    }
    return robot;
  }

 private:
  static std::size_t index_of(const Carried& c) { return static_cast<std::size_t>(c.link); }

  double number(const model::Expression& expression) const {
    return expression.evaluate<double>(std::span<const double>(values_));
  }
  Numbers3 numbers(const model::Vector3& v) const { return {number(v[0]), number(v[1]), number(v[2])}; }
  Matrix3 rotation(const model::Rotation& r) const { return model::rotation_from_rpy(numbers(r.rpy)); }

  static Link moving_link(const model::Joint& joint, const Carried& frame) {
    Link link;
    link.name = joint.name;
    link.parent = frame.link;
    link.rotation = frame.rotation;
    link.position = frame.position;
    if (joint.type == model::JointType::kFree)
      link.motion = Motion::kFree;
    else if (joint.type == model::JointType::kPrismatic)
      link.motion = Motion::kSlide;
    else if (joint.type != model::JointType::kRevolute)
      throw std::runtime_error("joint '" + joint.name + "' neither turns, slides nor is free");
    const double length = std::hypot(joint.axis[0], joint.axis[1], joint.axis[2]);
    for (std::size_t i = 0; i < 3; ++i) link.axis[i] = joint.axis[i] / length;
    return link;
  }

  /// Adds a body to its link: masses, moments, inertias about the common centre.
  void add(const model::Body& body, const Carried& where, Link& link) const {
    const double mass = number(body.mass);
    const Matrix3 axes = rotation(body.inertia_axes);
    const model::Inertia& i = body.inertia;
    Matrix3 inertia = model::turned(axes, {{{number(i.xx), number(i.xy), number(i.xz)},
                                            {number(i.xy), number(i.yy), number(i.yz)},
                                            {number(i.xz), number(i.yz), number(i.zz)}}});
    const Numbers3 center = numbers(body.center_of_mass);
    if (body.inertia_point == model::InertiaPoint::kOrigin)
      inertia = model::sum(inertia, model::scaled(model::point_inertia(center), -mass));
    const Numbers3 there = model::sum(where.position, model::product(where.rotation, center));
    const double all = link.mass + mass;
    if (all == 0) return;
    Numbers3 common, from_old, from_new;
    for (std::size_t k = 0; k < 3; ++k) {
      common[k] = (link.mass * link.center[k] + mass * there[k]) / all;
      from_old[k] = link.center[k] - common[k];
      from_new[k] = there[k] - common[k];
    }
    link.inertia = model::sum(link.inertia, model::scaled(model::point_inertia(from_old), link.mass));
    link.inertia = model::sum(link.inertia, model::sum(model::turned(where.rotation, inertia),
                                                       model::scaled(model::point_inertia(from_new), mass)));
    link.center = common;
    link.mass = all;
  }

  const model::Mechanism& mechanism_;
  std::vector<double> values_;
  std::map<std::size_t, Carried> carried_;  ///< by body
};

}  // namespace

bool Robot::is_chain() const {
  for (std::size_t i = 0; i < links.size(); ++i)
    if (links[i].parent != static_cast<int>(i) - 1 || links[i].motion == Motion::kFree) return false;
  return true;
}

Robot read_robot(const std::string& path, bool free_root, const std::vector<std::string>& locked) {
  support::Diagnostics diagnostics(path, support::read_file(path));
  model::ReadOptions options;
  if (free_root) options.root = model::RootJoint::kFree;
  options.locked_joints = locked;
  options.damping = false;
  const std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics, options);
  if (!mechanism) throw std::runtime_error(diagnostics.format());
  return Reader(*mechanism).read();
}

}  // namespace jourdain::compare
