#include "linkage.hpp"

#include <fmt/format.h>

namespace jourdain::tests {

using model::Expression;
using model::JointType;

std::size_t Linkage::add_body(const Expression& mass, const model::Vector3& center,
                              const std::array<Expression, 3>& moments) {
  model::Body body;
  body.name = fmt::format("body{}", mechanism.bodies.size());
  body.mass = mass;
  body.center_of_mass = center;
  body.inertia.xx = moments[0];
  body.inertia.yy = moments[1];
  body.inertia.zz = moments[2];
  mechanism.bodies.push_back(body);
  return mechanism.bodies.size() - 1;
}

std::size_t Linkage::add_plate(const Expression& mass, const Expression& x, const Expression& y,
                               const Expression& moment) {
  return add_body(mass, {x, y, 0.0}, {moment, moment, moment});
}

model::Joint& Linkage::add_joint(JointType type, OptionalBody parent, std::size_t child,
                                 const model::Vector3& origin, const std::array<double, 3>& axis) {
  model::Joint& joint = mechanism.joints.emplace_back();
  joint.name = fmt::format("joint{}", mechanism.joints.size() - 1);
  joint.set_type(type);
  if (parent) joint.parent = model::BodyIndex(*parent);
  joint.child = model::BodyIndex(child);
  joint.placement.position = origin;
  joint.axis = axis;
  return joint;
}

model::FrameIndex Linkage::add_frame(OptionalBody body, const model::Vector3& position,
                                     const model::Vector3& rpy) {
  model::Frame& frame = mechanism.frames.emplace_back();
  frame.name = fmt::format("frame{}", mechanism.frames.size() - 1);
  if (body) frame.body = model::BodyIndex(*body);
  frame.placement.position = position;
  frame.placement.rotation.rpy = rpy;
  return model::FrameIndex(mechanism.frames.size() - 1);
}

model::Loop& Linkage::add_loop(model::LoopType type, model::FrameIndex from, model::FrameIndex to) {
  model::Loop& loop = mechanism.loops.emplace_back();
  loop.name = fmt::format("loop{}", mechanism.loops.size() - 1);
  loop.type = type;
  loop.from = from;
  loop.to = to;
  return loop;
}

Linkage four_bar(const FourBar& bars, model::LoopType closing, bool base) {
  Linkage linkage;
  linkage.mechanism.gravity = {0.0, -9.81, 0.0};
  for (std::size_t i = 0; i < 3; ++i)
    linkage.add_plate(bars.masses[i], bars.centers[i], 0.0, bars.moments[i]);
  OptionalBody ground;
  if (base) {
    ground = linkage.add_plate(3.0, 0.2, 0.1, 0.4);
    linkage.add_joint(JointType::kRevolute, {}, *ground);
  }
  linkage.add_joint(JointType::kRevolute, ground, 0);
  linkage.add_joint(JointType::kRevolute, 0, 1, {bars.crank, 0.0, 0.0});
  linkage.add_joint(JointType::kRevolute, ground, 2, {bars.ground, 0.0, 0.0});
  const model::FrameIndex to = linkage.add_frame(1, {bars.coupler, 0.0, 0.0});
  linkage.add_loop(closing, linkage.add_frame(2, {bars.rocker, 0.0, 0.0}), to);
  model::Actuator& motor = linkage.mechanism.actuators.emplace_back();
  motor.name = "motor";
  motor.joint = model::JointIndex(base ? 1 : 0);
  return linkage;
}

}  // namespace jourdain::tests
