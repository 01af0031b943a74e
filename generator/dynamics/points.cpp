#include "dynamics/points.hpp"

#include <fmt/format.h>

#include <set>

#include "kinematics/numbers.hpp"

namespace jourdain::dynamics {

using kinematics::kGround;
using kinematics::Statements;

PointPath follow_point(const Scene& scene, std::size_t link, const Vector3& x_L, std::size_t ancestor,
                       const std::string& name) {
  Statements& statements = scene.statements;
  PointPath path;
  path.position = link == kGround ? x_L : scene.frames.to_working(link, x_L, name + "x");
  path.velocity = kinematics::zero_vector();
  for (std::size_t j = link; j != ancestor; j = scene.tree.links[j].parent) {
    path.links.push_back(j);
    path.levers.push_back(path.position);
    const Twist twist = scene.relative_twist(j);
    const Vector3 turned = kinematics::cross(twist.angular, path.position);
    const std::string v = fmt::format("{}v{}", name, j), x = fmt::format("{}x{}", name, j);
    path.velocity = statements.bind(v, path.velocity + turned + twist.linear);
    path.velocity = scene.frames.to_parent(j, path.velocity, v + "p");
    path.position = scene.frames.point_to_parent(j, path.position, x);
  }
  return path;
}

std::vector<Vector3> carry_outward(const Scene& scene, const PointPath& path, const Vector3& v,
                                   const std::string& name) {
  std::vector<Vector3> carried(path.links.size());
  Vector3 current = v;
  for (std::size_t k = path.links.size(); k-- > 0;)
    carried[k] = current =
        scene.frames.from_parent(path.links[k], current, fmt::format("{}{}", name, path.links[k]));
  return carried;
}

std::size_t common_ancestor(const kinematics::LinkTree& tree, std::size_t a, std::size_t b) {
  std::set<std::size_t> inward;
  for (std::size_t i = a; i != kGround; i = tree.links[i].parent) inward.insert(i);
  for (std::size_t i = b; i != kGround; i = tree.links[i].parent)
    if (inward.count(i)) return i;
  return kGround;
}

kinematics::BodyPose frame_pose(const Scene& scene, const model::Frame& frame) {
  kinematics::BodyPose pose;
  if (frame.body) pose = scene.tree.bodies[frame.body->value];
  Statements& statements = scene.statements;
  const std::vector<Ex>& parameters = scene.leaves.parameters;
  const Vector3 r = kinematics::to_symbolic(frame.placement.position, parameters, statements);
  const kinematics::Matrix3 R =
      kinematics::rotation_matrix(frame.placement.rotation, parameters, scene.mechanism.snap, statements);
  pose.r_LB = statements.bind("r_" + frame.name, kinematics::settled(pose.r_LB + pose.R_LB * r));
  pose.R_LB = kinematics::settled(pose.R_LB * R);
  for (std::size_t k = 0; k < 3; ++k) pose.R_LB[k] = statements.bind("R_" + frame.name, pose.R_LB[k]);
  return pose;
}

}  // namespace jourdain::dynamics
