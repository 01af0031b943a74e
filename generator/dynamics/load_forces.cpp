// Loads on frames.
#include "dynamics/element_forces.hpp"
#include "dynamics/wrenches.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;

namespace {

/// Components in W of the frame's link.
Vector3 to_working(const Scene& scene, const model::Load& load, const kinematics::BodyPose& pose,
                   const Vector3& v, const std::string& name) {
  if (load.axes == model::LoadAxes::kFrame)
    return scene.frames.to_working(pose.link, scene.statements.bind(name, pose.R_LB * v), name);
  if (pose.link == kGround || is_zero(v)) return v;
  const PointPath path = follow_point(scene, pose.link, kinematics::zero_vector(), kGround, name);
  return carry_outward(scene, path, v, name).front();
}

}  // namespace

void add_forces(const model::Load& load, ForceSum& sum) {
  const Scene& scene = sum.scene;
  const model::Frame& frame = scene.mechanism.frames[load.frame.value];
  const kinematics::BodyPose pose = frame_pose(scene, frame);
  const auto components = [&](const model::Vector3& v, const char* what) {
    Vector3 value;
    for (std::size_t k = 0; k < 3; ++k) value[k] = general_value(scene, load.name + what, v[k], sum.inputs);
    return value;
  };
  const Vector3 force = to_working(scene, load, pose, components(load.force, "f"), load.name + "f");
  const Vector3 moment = to_working(scene, load, pose, components(load.moment, "n"), load.name + "n");
  const Vector3 lever = scene.frames.to_working(pose.link, pose.r_LB, load.name + "x");
  const Wrench wrench{force, scene.statements.bind(load.name + "m", moment + cross(lever, force))};
  if (frame.body) sum.forces.on_bodies.push_back({*frame.body, wrench});
  if (pose.link == kGround) return;
  Wrench& on_link = sum.forces.on_link[pose.link];
  on_link = bound(scene, load.name + "s", on_link + wrench);
}

}  // namespace jourdain::dynamics
