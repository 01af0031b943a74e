#include "studies/free_bodies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/coordinates.hpp"
#include "model/joint_kinds.hpp"
#include "reference/massless.hpp"
#include "reference/minimal.hpp"

namespace jourdain::studies {

namespace {

using model::Expression;
using model::Joint;
using model::JointType;
using model::Mechanism;
using Vector3 = std::array<double, 3>;

bool is_rewritten(const Joint& joint) {
  const model::JointKind& kind = model::joint_kind(joint);
  return !kind.motions.empty() && !kind.has_origin();
}

/// Whether all that the joint does is turn about its axis.
bool only_turns(const Joint& joint) {
  const model::JointMotion* motion = model::joint_kind(joint).plain_motion();
  return motion && motion->kind == model::MotionKind::kTurn;
}

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector3 unit(const Vector3& axis) {
  const double length = std::sqrt(dot(axis, axis));
  return {axis[0] / length, axis[1] / length, axis[2] / length};
}

/// Does all that acts along the coordinate have a place on free bodies?
bool is_plain(const model::Coordinate& coordinate, bool damped) {
  return !coordinate.motion && coordinate.stiffness.is_zero() && coordinate.friction.is_zero() &&
         (damped || coordinate.damping.is_zero());
}

bool can_be_rewritten(const Joint& joint) {
  if (!is_rewritten(joint)) return true;
  const model::JointKind& kind = model::joint_kind(joint);
  if (!kind.as_loop || !joint.spin_damping.is_zero()) return false;
  if (kind.has(model::Along::kSecondAxis) && dot(joint.axis, joint.second_axis) != 0) return false;
  return std::all_of(joint.coordinates.begin(), joint.coordinates.end(),
                     [&](const model::Coordinate& c) { return is_plain(c, only_turns(joint)); });
}

/// What a force element may be while its bodies' joints become loops: it must name no coordinate that goes.
bool can_stay(const model::Actuator& actuator, const Mechanism& mechanism) {
  return actuator.rotor_inertia.is_zero() &&
         model::joint_kind(mechanism.joints[actuator.joint.value]).plain_motion();
}
bool can_stay(const model::CoordinateForce&, const Mechanism&) { return false; }
bool can_stay(const model::Load&, const Mechanism&) { return false; }
bool can_stay(const model::Spring&, const Mechanism&) { return true; }
bool can_stay(const model::Bushing&, const Mechanism&) { return true; }
bool can_stay(const model::StateVariable&, const Mechanism&) { return false; }

bool can_be_rewritten(const Mechanism& m) {
  return m.loops.empty() &&
         std::all_of(m.joints.begin(), m.joints.end(),
                     [](const Joint& joint) { return can_be_rewritten(joint); }) &&
         !model::any_force_element(m, [&m](const auto& element) { return !can_stay(element, m); });
}

Expression sum(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kAdd, a, b);
}
Expression product(const Expression& a, const Expression& b) {
  return Expression::binary(Expression::Op::kMultiply, a, b);
}
Expression negative(const Expression& a) { return Expression::unary(Expression::Op::kNegate, a); }

class Rewriting {
 public:
  explicit Rewriting(const Mechanism& given) : given_(given), free_(given) {}

  Mechanism result() {
    free_.outputs.clear();
    free_.actuators.clear();
    free_.inputs.clear();
    for (const model::Actuator& actuator : given_.actuators)
      free_.inputs.push_back({actuator.name, "", "", actuator.where});
    free_.inputs.insert(free_.inputs.end(), given_.inputs.begin(), given_.inputs.end());
    for (std::size_t j = 0; j < given_.joints.size(); ++j)
      if (is_rewritten(given_.joints[j])) cut(j);
    free_.loop_options = {};
    free_.loop_options.treatment = model::LoopTreatment::kMultipliers;
    return std::move(free_);
  }

 private:
  /// Makes the child free and the joint a loop.
  void cut(std::size_t index) {
    const Joint& joint = given_.joints[index];
    const model::JointKind& kind = model::joint_kind(joint);
    const model::FrameIndex on_parent = add_frame(joint.parent, joint.placement),
                            on_child = add_frame(joint.child, {});
    model::Loop loop;
    loop.name = joint.name + "_closed";
    loop.type = *kind.as_loop;
    loop.from = on_parent;
    loop.to = on_child;
    loop.axis = joint.axis;
    loop.to_axis = kind.has(model::Along::kSecondAxis) ? joint.second_axis : joint.axis;
    free_.loops.push_back(loop);
    Joint& released = free_.joints[index];
    released = Joint();
    released.name = joint.name;
    released.child = joint.child;
    released.where = joint.where;
    released.set_type(JointType::kFree);
    act(index, on_parent, on_child);
  }

  model::FrameIndex add_frame(const std::optional<model::BodyIndex>& body,
                              const model::Placement& placement) {
    model::Frame frame;
    frame.name = fmt::format("free_bodies_{}", free_.frames.size());
    frame.body = body;
    frame.placement = placement;
    free_.frames.push_back(frame);
    return model::FrameIndex(free_.frames.size() - 1);
  }

  /// Along the axis, which has the same components in both frames, on the child and against it on the parent.
  /// Forces of a prismatic joint have one line of action.
  void act(std::size_t index, model::FrameIndex on_parent, model::FrameIndex on_child) {
    const Joint& joint = given_.joints[index];
    Expression effort = driving(index);
    if (only_turns(joint)) effort = sum(effort, damping(joint, on_parent, on_child));
    if (effort.is_zero()) return;
    load(joint, on_child, effort);
    if (joint.parent) load(joint, on_parent, negative(effort));
  }

  /// Of the actuators on a joint, N m or N.
  Expression driving(std::size_t joint) const {
    Expression effort;
    for (std::size_t a = 0; a < given_.actuators.size(); ++a) {
      const model::Actuator& actuator = given_.actuators[a];
      if (actuator.joint.value != joint) continue;
      const Expression input = Expression::variable({model::Variable::Kind::kInput, a, 0});
      effort = sum(effort, product(actuator.gear_ratio, input));
    }
    return effort;
  }

  static Expression damping(const Joint& joint, model::FrameIndex on_parent, model::FrameIndex on_child) {
    const Expression& constant = joint.coordinates.front().damping;
    if (constant.is_zero()) return {};
    Expression rate = spin_along(joint, on_child);
    if (joint.parent) rate = sum(rate, negative(spin_along(joint, on_parent)));
    return negative(product(constant, rate));
  }

  static Expression spin_along(const Joint& joint, model::FrameIndex frame) {
    const Vector3 n = unit(joint.axis);
    Expression spin;
    for (std::size_t i = 0; i < 3; ++i)
      spin =
          sum(spin, product(n[i], Expression::variable({model::Variable::Kind::kFrameSpin, frame.value, i})));
    return spin;
  }

  void load(const Joint& joint, model::FrameIndex frame, const Expression& effort) {
    const Vector3 n = unit(joint.axis);
    model::Load load;
    load.name = fmt::format("{}_{}", joint.name, free_.loads.size());
    load.frame = frame;
    model::Vector3& components = only_turns(joint) ? load.moment : load.force;
    for (std::size_t i = 0; i < 3; ++i) components[i] = product(n[i], effort);
    free_.loads.push_back(load);
  }

  const Mechanism& given_;
  Mechanism free_;
};

std::vector<double> default_parameters(const Mechanism& mechanism) {
  std::vector<double> values;
  for (const model::Parameter& parameter : mechanism.parameters) values.push_back(parameter.value);
  return values;
}

/// Puts a state into the description of the joints that were cut.
void start_at(const std::vector<double>& x, const Mechanism& given, Mechanism& free) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(free);
  for (std::size_t j = 0; j < free.joints.size(); ++j) {
    if (!is_rewritten(given.joints[j])) continue;
    Joint& joint = free.joints[j];
    const double *y = &x[layout.joints[j].first_position],
                 *z = &x[layout.position_count() + layout.joints[j].first_velocity];
    for (std::size_t i = 0; i < 3; ++i) {
      joint.initial_origin[i] = y[i];
      joint.initial_origin_velocity[i] = z[i];
      joint.initial_spin[i] = z[3 + i];
    }
    for (std::size_t i = 0; i < 4; ++i) joint.initial_orientation[i] = y[3 + i];
  }
}

}  // namespace

std::optional<Mechanism> as_free_bodies(const Mechanism& mechanism) {
  if (!can_be_rewritten(mechanism)) return {};
  if (std::none_of(mechanism.joints.begin(), mechanism.joints.end(), is_rewritten)) return {};
  Mechanism free = Rewriting(mechanism).result();
  const reference::DescriptorReference<double> absolute(mechanism);
  const reference::State<double> start = reference::Reference<double>(mechanism).initial_state();
  start_at(
      free_state(free, default_parameters(mechanism), absolute.absolute_state(start.t, start.y, start.z)),
      mechanism, free);
  if (!reference::massless_joints(free).empty()) return {};
  return free;
}

std::vector<double> free_state(const Mechanism& free, const std::vector<double>& parameters,
                               const std::vector<reference::AbsoluteBody<double>>& bodies) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(free);
  std::vector<double> x(layout.position_count() + layout.velocity_count());
  for (std::size_t j = 0; j < free.joints.size(); ++j) {
    if (free.joints[j].type != JointType::kFree) continue;
    const reference::AbsoluteBody<double>& body = bodies[free.joints[j].child.value];
    Eigen::Vector3d to_C;
    for (std::size_t i = 0; i < 3; ++i)
      to_C[Eigen::Index(i)] =
          free.bodies[free.joints[j].child.value].center_of_mass[i].evaluate<double>(parameters);
    const Eigen::Vector3d p = body.p_WC - body.orientation * to_C,
                          v = body.v_C - body.orientation * body.omega.cross(to_C);
    const Eigen::Quaterniond& q = body.orientation;
    const double y[] = {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()};
    std::copy(std::begin(y), std::end(y), x.begin() + std::ptrdiff_t(layout.joints[j].first_position));
    double* const z = &x[layout.position_count() + layout.joints[j].first_velocity];
    for (Eigen::Index i = 0; i < 3; ++i) z[i] = v[i], z[3 + i] = body.omega[i];
  }
  return x;
}

}  // namespace jourdain::studies
