#include "dynamics/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "dynamics/accelerations.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/free_root.hpp"
#include "dynamics/wrenches.hpp"
#include "support/check.hpp"

namespace jourdain::dynamics {

using kinematics::cross;
using kinematics::kGround;
using kinematics::Matrix3;
using model::OutputKind;

namespace {

OutputValues vector_values(const std::string& member, const Vector3& v) {
  return {member, 3, 1, false, {v[0], v[1], v[2]}};
}

OutputValues matrix_values(const std::string& member, const std::vector<Vector3>& columns) {
  OutputValues values{member, 3, static_cast<int>(columns.size()), true, {}};
  for (std::size_t row = 0; row < 3; ++row)
    for (const Vector3& column : columns) values.values.push_back(column[row]);
  return values;
}

/// A frame of the model with its way to the inertial frame.
class FrameView {
 public:
  FrameView(const Scene& scene, const model::Frame& frame)
      : scene_(scene),
        name_(frame.name),
        pose_(frame_pose(scene, frame)),
        path_(follow_point(scene, pose_.link, pose_.r_LB, kGround, frame.name)) {}

  const Vector3& position() const { return path_.position; }
  const Vector3& velocity() const { return path_.velocity; }
  const PointPath& path() const { return path_; }
  std::size_t link() const { return pose_.link; }

  /// R_WF by columns.
  std::vector<Vector3> rotation() {
    std::vector<Vector3> columns(3);
    for (std::size_t row = 0; row < 3; ++row) {
      Vector3 axis = kinematics::zero_vector();
      axis[row] = 1;
      const Vector3 in_frame = from_inertial(axis, fmt::format("{}e{}", name_, row));
      for (std::size_t column = 0; column < 3; ++column) columns[column][row] = in_frame[column];
    }
    return columns;
  }

  Vector3 spin() {
    return is_fixed() ? kinematics::zero_vector() : from_working(scene_.omega.own[link()], "w");
  }

  /// a of the point (inertial frame) and ω̇ (frame components), given those of its link.
  Twist acceleration(const std::vector<Twist>& links) {
    if (is_fixed()) return {};
    const Twist& at = links[link()];
    const Vector3& w = scene_.omega.own[link()];
    const Vector3& x = path_.levers.front();
    const Vector3 turned = bind("wx", cross(w, x));
    const Vector3 a = bind("a", at.linear + cross(at.angular, x) + cross(w, turned));
    return {from_working(at.angular, "al"), to_inertial(a, 0, "a")};
  }

  /// Columns on the way: velocity of the point (inertial frame) and angular velocity (frame components) per unit.
  template <class Add>
  void for_columns(Add&& add) {
    for (std::size_t k = 0; k < path_.links.size(); ++k) {
      const std::size_t j = path_.links[k];
      const std::vector<Column>& columns = scene_.columns[j];
      for (std::size_t c = 0; c < columns.size(); ++c) add(j, columns[c], column_twist(k, j, c));
    }
  }

 private:
  bool is_fixed() const { return pose_.link == kGround; }
  Vector3 bind(const std::string& what, const Vector3& v) { return scene_.statements.bind(name_ + what, v); }

  /// v of a free link is in the inertial frame and of the child's origin.
  Twist column_twist(std::size_t k, std::size_t j, std::size_t c) {
    const Twist& column = scene_.columns[j][c].twist;
    const std::string what = fmt::format("J{}_{}", j, c);
    const kinematics::Link& link = scene_.tree.links[j];
    if (is_free(link) && c < 3) return {kinematics::zero_vector(), column.linear};
    const Vector3 lever = bind("lever", path_.levers[k] + link.shift);
    const Vector3 at_point = bind(what, column.linear + cross(column.angular, lever));
    Vector3 angular = column.angular;
    for (std::size_t inner = k; inner-- > 0;)
      angular =
          scene_.frames.from_parent(path_.links[inner], angular, fmt::format("{}{}r{}", name_, what, inner));
    return {from_working(angular, what + "r"), to_inertial(at_point, k, what + "t")};
  }

  Vector3 from_working(const Vector3& v_W, const std::string& what) {
    const Vector3 v_L = scene_.frames.to_link(link(), v_W, name_ + what + "l");
    return bind(what, transpose(pose_.R_LB) * v_L);
  }

  Vector3 from_inertial(const Vector3& v, const std::string& what) {
    if (is_fixed()) return bind(what, transpose(pose_.R_LB) * v);
    return from_working(carry_outward(scene_, path_, v, what).front(), what);
  }

  /// From W of the k-th link of the way.
  Vector3 to_inertial(const Vector3& v_W, std::size_t k, const std::string& what) {
    Vector3 v = v_W;
    for (; k < path_.links.size(); ++k)
      v = scene_.frames.to_parent(path_.links[k], v, fmt::format("{}{}i{}", name_, what, k));
    return v;
  }

  const Scene& scene_;
  std::string name_;
  kinematics::BodyPose pose_;
  PointPath path_;
};

class Outputs {
 public:
  Outputs(const Scene& scene, const Equations& equations, const std::vector<Ex>& zdot,
          const AppliedForces& applied)
      : scene_(scene), statements_(scene.statements), equations_(equations), zdot_(zdot), applied_(applied) {}

  std::vector<OutputValues> derive(const model::Output& output) {
    switch (output.kind) {
      case OutputKind::kPose: {
        FrameView frame = view(output);
        return {vector_values("position", frame.position()), matrix_values("rotation", frame.rotation())};
      }
      case OutputKind::kVelocity: {
        FrameView frame = view(output);
        return {vector_values("v", frame.velocity()), vector_values("omega", frame.spin())};
      }
      case OutputKind::kAcceleration: {
        const Twist twist =
            view(output).acceleration(link_accelerations(scene_, zdot_, Gravity::kNone, "out"));
        return {vector_values("a", twist.linear), vector_values("omega_dot", twist.angular)};
      }
      case OutputKind::kJacobian:
        return jacobian(output);
      case OutputKind::kReaction:
        return reaction(output.joint);
      case OutputKind::kDrive:
        return scalar(drive(output));
      case OutputKind::kKineticEnergy:
        return scalar(equations_.kinetic_energy);
      case OutputKind::kPotentialEnergy:
        return scalar(equations_.potential_energy);
      case OutputKind::kExpression:
        return scalar(general_value(scene_, output.name, output.value, Inputs::kGiven));
    }
    return {};
  }

 private:
  FrameView view(const model::Output& output) {
    return FrameView(scene_, scene_.mechanism.frames[output.frame.value]);
  }

  static std::vector<OutputValues> scalar(const Ex& value) { return {{"", 1, 1, false, {value}}}; }

  std::vector<OutputValues> jacobian(const model::Output& output) {
    FrameView frame = view(output);
    const std::size_t nz = scene_.layout.velocity_count();
    std::vector<Vector3> J_t(nz, kinematics::zero_vector()), J_r = J_t;
    Twist prescribed;
    frame.for_columns([&](std::size_t link, const Column& column, const Twist& twist) {
      if (column.entry) {
        J_t[*column.entry] = twist.linear;
        J_r[*column.entry] = twist.angular;
        return;
      }
      const Ex rate = kinematics::coordinate_motion(scene_.tree.links[link], scene_.states[link]).first;
      prescribed.linear = statements_.bind(output.name + "vbar", prescribed.linear + rate * twist.linear);
      prescribed.angular = statements_.bind(output.name + "wbar", prescribed.angular + rate * twist.angular);
    });
    const Twist bias =
        frame.acceleration(link_accelerations(scene_, std::vector<Ex>(nz, 0), Gravity::kNone, "bar"));
    std::vector<OutputValues> values;
    if (nz > 0) values = {matrix_values("J_t", J_t), matrix_values("J_r", J_r)};
    values.push_back(vector_values("v_bar", prescribed.linear));
    values.push_back(vector_values("omega_bar", prescribed.angular));
    values.push_back(vector_values("a_bar", bias.linear));
    values.push_back(vector_values("zeta_bar", bias.angular));
    return values;
  }

  /// Bodies that a joint carries, its child included.
  std::vector<bool> carried_bodies(model::JointIndex joint) const {
    const model::Mechanism& mechanism = scene_.mechanism;
    std::vector<bool> carried(mechanism.bodies.size(), false);
    carried[mechanism.joints[joint.value].child.value] = true;
    for (model::JointIndex index : model::depth_first(mechanism)) {
      const model::Joint& outer = mechanism.joints[index.value];
      if (outer.parent && carried[outer.parent->value]) carried[outer.child.value] = true;
    }
    return carried;
  }

  /// Inertia force less weight of a mass moving with its link, about the link's origin, in W.
  Wrench inertia_wrench(const kinematics::MassMoments& moments_L, std::size_t link, const Twist& at,
                        const std::string& name) {
    const Vector3& w = scene_.omega.own[link];
    const Vector3 w_L = scene_.frames.to_link(link, w, name + "w");
    const Vector3 al_L = scene_.frames.to_link(link, at.angular, name + "al");
    const Vector3 a_L = scene_.frames.to_link(link, at.linear, name + "a");
    const Vector3& h = moments_L.first;
    const Matrix3& S = moments_L.second;
    const Vector3 wh = statements_.bind(name + "wh", cross(w_L, h));
    const Vector3 Sw = statements_.bind(name + "Sw", S * w_L);
    const Ex trace = statements_.bind(name + "tr", S[0][0] + S[1][1] + S[2][2]);
    const Vector3 force =
        statements_.bind(name + "F", moments_L.mass * a_L + cross(al_L, h) + cross(w_L, wh));
    const Vector3 moment =
        statements_.bind(name + "N", cross(h, a_L) + (trace * al_L - S * al_L) + cross(Sw, w_L));
    return {scene_.frames.to_working(link, force, name + "f"),
            scene_.frames.to_working(link, moment, name + "n")};
  }

  /// Newton's and Euler's equations of everything that the joint carries, with the parameters of the single bodies.
  std::vector<OutputValues> reaction(model::JointIndex joint) {
    const std::vector<bool> carried = carried_bodies(joint);
    const std::vector<Twist> at = link_accelerations(scene_, zdot_, Gravity::kAsAcceleration, "react");
    const model::BodyIndex child = scene_.mechanism.joints[joint.value].child;
    const kinematics::BodyPose& pose = scene_.tree.bodies[child.value];
    if (pose.link == kGround) return ground_reaction(carried, at, pose);
    std::vector<Wrench> wrenches = carried_wrenches(carried, at, fmt::format("react{}", joint.value));
    const std::vector<Wrench> totals =
        accumulate_wrenches(scene_, wrenches, fmt::format("reacts{}", joint.value));
    return about_child(totals[pose.link], pose, fmt::format("react{}c", joint.value));
  }

  std::vector<Wrench> carried_wrenches(const std::vector<bool>& carried, const std::vector<Twist>& at,
                                       const std::string& prefix) {
    std::vector<Wrench> wrenches(scene_.link_count());
    const auto add = [&](std::size_t link, const Wrench& wrench, const std::string& name) {
      wrenches[link] = bound(scene_, name + "s", wrenches[link] + wrench);
    };
    for (std::size_t b = 0; b < carried.size(); ++b) {
      const std::size_t link = scene_.tree.bodies[b].link;
      const std::string name = fmt::format("{}b{}", prefix, b);
      if (carried[b] && link != kGround)
        add(link, inertia_wrench(scene_.tree.body_moments[b], link, at[link], name), name);
    }
    for (std::size_t k = 0; k < applied_.on_bodies.size(); ++k) {
      const BodyWrench& applied = applied_.on_bodies[k];
      if (!carried[applied.body.value] || scene_.tree.bodies[applied.body.value].link == kGround) continue;
      add(scene_.tree.bodies[applied.body.value].link, Ex(-1) * applied.wrench,
          fmt::format("{}e{}", prefix, k));
    }
    return wrenches;
  }

  std::vector<OutputValues> about_child(const Wrench& total, const kinematics::BodyPose& pose,
                                        const std::string& name) {
    const Vector3 force = scene_.frames.to_link(pose.link, total.force, name + "f");
    const Vector3 moment = scene_.frames.to_link(pose.link, total.moment, name + "n");
    const Vector3 at_child = statements_.bind(name + "m", moment - cross(pose.r_LB, force));
    const Matrix3 R = transpose(pose.R_LB);
    return {vector_values("force", statements_.bind(name + "F", R * force)),
            vector_values("moment", statements_.bind(name + "N", R * at_child))};
  }

  /// A joint that fixes its child to the ground carries the weight of what is fixed there and all links outward.
  std::vector<OutputValues> ground_reaction(const std::vector<bool>& carried, const std::vector<Twist>& at,
                                            const kinematics::BodyPose& pose) {
    const std::string name = "react_ground";
    std::vector<Wrench> totals = accumulate_wrenches(scene_, carried_wrenches(carried, at, name), name + "s");
    Wrench sum;
    const Vector3 upward = Ex(-1) * scene_.tree.gravity;
    for (std::size_t b = 0; b < carried.size(); ++b) {
      if (!carried[b] || scene_.tree.bodies[b].link != kGround) continue;
      const kinematics::MassMoments& moments = scene_.tree.body_moments[b];
      sum = bound(scene_, name + "g", sum + Wrench{moments.mass * upward, cross(moments.first, upward)});
    }
    for (const BodyWrench& applied : applied_.on_bodies) {
      if (!carried[applied.body.value] || scene_.tree.bodies[applied.body.value].link != kGround) continue;
      sum = bound(scene_, name + "a", sum + Ex(-1) * applied.wrench);
    }
    for (std::size_t i = 0; i < scene_.link_count(); ++i) {
      if (scene_.tree.links[i].parent != kGround) continue;
      const Vector3 f = scene_.frames.to_parent(i, totals[i].force, name + "tf");
      const Vector3 n = scene_.frames.to_parent(i, totals[i].moment, name + "tn");
      sum = bound(scene_, name + "l", sum + Wrench{f, n + cross(scene_.frames.r_CW(i), f)});
    }
    const Vector3 at_child = statements_.bind(name + "m", sum.moment - cross(pose.r_LB, sum.force));
    const Matrix3 R = transpose(pose.R_LB);
    return {vector_values("force", statements_.bind(name + "F", R * sum.force)),
            vector_values("moment", statements_.bind(name + "N", R * at_child))};
  }

  /// The row of the equations of motion that belongs to a prescribed coordinate.
  Ex drive(const model::Output& output) {
    const std::size_t link = scene_.link_of(output.joint, output.coordinate);
    const JointAccelerations motion = joint_accelerations(scene_, zdot_, Gravity::kAsAcceleration, "drive");
    const std::vector<std::vector<Ex>> rows =
        derive_generalized_forces(scene_, motion, applied_.on_link, "drive");
    return statements_.bind(output.name, rows[link][0] - applied_.along[link][0]);
  }

  const Scene& scene_;
  kinematics::Statements& statements_;
  const Equations& equations_;
  const std::vector<Ex>& zdot_;
  const AppliedForces& applied_;
};

}  // namespace

std::vector<std::vector<OutputValues>> derive_outputs(const Scene& scene, const Equations& equations,
                                                      const std::vector<Ex>& zdot,
                                                      const AppliedForces& applied) {
  Outputs outputs(scene, equations, zdot, applied);
  std::vector<std::vector<OutputValues>> values;
  for (const model::Output& output : scene.mechanism.outputs) values.push_back(outputs.derive(output));
  return values;
}

std::vector<Ex> output_entries(const Equations& equations) {
  std::vector<Ex> entries;
  for (const auto& output : equations.outputs)
    for (const OutputValues& member : output)
      entries.insert(entries.end(), member.values.begin(), member.values.end());
  return entries;
}

}  // namespace jourdain::dynamics
