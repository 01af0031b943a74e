// Everything in a mechanism that says where it stands or which body, joint, frame, parameter or variable it means.
// Whoever adds a member to one of these structures is asked for it here by the compiler: it does not build otherwise.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Calls `visit` with each Expression, SourceRange, BodyIndex, JointIndex and FrameIndex of a mechanism; `visit` takes
/// a reference to any of them.
template <class Visit>
class Members {
 public:
  explicit Members(Visit& visit) : visit_(visit) {}

  void of(Mechanism& mechanism) {
    each(mechanism.gravity, mechanism.parameters, mechanism.derived, mechanism.bodies, mechanism.joints,
         mechanism.frames, mechanism.inputs, mechanism.outputs, mechanism.kinematics, mechanism.loops,
         mechanism.grounds, mechanism.loop_options, mechanism.where);
    for_each_force_list(mechanism, [this](auto& list) { this->one(list); });
  }

 private:
  template <class... Parts>
  void each(Parts&... parts) {
    (one(parts), ...);
  }

  void one(Expression& expression) { visit_(expression); }
  void one(SourceRange& range) { visit_(range); }
  void one(BodyIndex& body) { visit_(body); }
  void one(JointIndex& joint) { visit_(joint); }
  void one(FrameIndex& frame) { visit_(frame); }
  void one(std::string&) {}
  template <class Number>
  requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>) void one(Number&) {}

  template <class Part>
  void one(std::vector<Part>& list) {
    for (Part& part : list) one(part);
  }
  template <class Part, std::size_t Count>
  void one(std::array<Part, Count>& list) {
    for (Part& part : list) one(part);
  }
  template <class Part>
  void one(std::optional<Part>& part) {
    if (part) one(*part);
  }

  void one(Rotation& rotation) {
    auto& [rpy, where] = rotation;
    each(rpy, where);
  }
  void one(Placement& placement) {
    auto& [position, rotation] = placement;
    each(position, rotation);
  }
  void one(Parameter& parameter) {
    auto& [name, value, unit, description, where, range] = parameter;
    each(name, value, unit, description, where, range);
  }
  void one(DerivedParameter& parameter) {
    auto& [name, value, unit, where] = parameter;
    each(name, value, unit, where);
  }
  void one(Inertia& inertia) {
    auto& [xx, yy, zz, xy, xz, yz] = inertia;
    each(xx, yy, zz, xy, xz, yz);
  }
  void one(Shape& shape) {
    auto& [kind, size, radius, length, axis] = shape;
    each(kind, size, radius, length, axis);
  }
  void one(Body& body) {
    auto& [name, mass, center_of_mass, inertia, inertia_point, inertia_axes, shape, lumped, lenient, where,
           mass_where, inertia_where] = body;
    each(name, mass, center_of_mass, inertia, inertia_point, inertia_axes, shape, lumped, lenient, where,
         mass_where, inertia_where);
  }
  void one(Coordinate& coordinate) {
    auto& [name, angular, stiffness, rest, damping, friction, friction_speed, initial_position,
           initial_velocity, position_where, velocity_where, motion, motion_where, range, range_is_limit] =
        coordinate;
    each(name, angular, stiffness, rest, damping, friction, friction_speed, initial_position,
         initial_velocity, position_where, velocity_where, motion, motion_where, range, range_is_limit);
  }
  void one(Joint& joint) {
    auto& [name, type, parent, child, placement, axis, second_axis, pitch, curve, sequence, coordinates,
           initial_orientation, initial_spin, spin_damping, initial_origin, initial_origin_velocity, where,
           child_where, axis_where, orientation_where, spin_where, origin_where, origin_velocity_where] =
        joint;
    each(name, type, parent, child, placement, axis, second_axis, pitch, curve, sequence, coordinates,
         initial_orientation, initial_spin, spin_damping, initial_origin, initial_origin_velocity, where,
         child_where, axis_where, orientation_where, spin_where, origin_where, origin_velocity_where);
  }
  void one(Frame& frame) {
    auto& [name, body, placement, where] = frame;
    each(name, body, placement, where);
  }
  void one(Input& input) {
    auto& [name, unit, description, where] = input;
    each(name, unit, description, where);
  }
  void one(Output& output) {
    auto& [name, kind, frame, joint, coordinate, value, where] = output;
    each(name, kind, frame, joint, coordinate, value, where);
  }
  void one(KinematicFunction& function) {
    auto& [name, frame, axes, quantities, where] = function;
    each(name, frame, axes, quantities, where);
  }
  void one(Loop& loop) {
    auto& [name, type, from, to, axis, to_axis, length, residual, radii, height, approaches, continues,
           follower, where, to_where] = loop;
    each(name, type, from, to, axis, to_axis, length, residual, radii, height, approaches, continues,
         follower, where, to_where);
  }
  void one(DrawnGround& ground) {
    auto& [frame, normal, point, height] = ground;
    each(frame, normal, point, height);
  }
  void one(ScalarCoordinate& scalar) {
    auto& [joint, coordinate] = scalar;
    each(joint, coordinate);
  }
  void one(LoopOptions::CoordinateName& coordinate) {
    auto& [joint, number] = coordinate;
    each(joint, number);
  }
  void one(LoopOptions& options) {
    auto& [treatment, independent, iterations, stabilisation, where] = options;
    each(treatment, independent, iterations, stabilisation, where);
  }
  void one(Actuator& actuator) {
    auto& [name, joint, coordinate, gear_ratio, rotor_inertia, where, implied] = actuator;
    each(name, joint, coordinate, gear_ratio, rotor_inertia, where, implied);
  }
  void one(Touch& touch) {
    auto& [depth, stiffness, exponent] = touch;
    each(depth, stiffness, exponent);
  }
  void one(CoordinateForce& force) {
    auto& [name, joint, coordinate, value, touch, where] = force;
    each(name, joint, coordinate, value, touch, where);
  }
  void one(Spring& spring) {
    auto& [name, from, to, stiffness, damping, free_length, law, potential, where] = spring;
    each(name, from, to, stiffness, damping, free_length, law, potential, where);
  }
  void one(Load& load) {
    auto& [name, frame, axes, force, moment, touch, where] = load;
    each(name, frame, axes, force, moment, touch, where);
  }
  void one(Bushing& bushing) {
    auto& [name, from, to, stiffness, damping, torsional_stiffness, torsional_damping, where] = bushing;
    each(name, from, to, stiffness, damping, torsional_stiffness, torsional_damping, where);
  }

  void one(StateVariable& state) {
    auto& [name, rate, initial, nominal, unit, sampled, period, description, where] = state;
    each(name, rate, initial, nominal, unit, sampled, period, description, where);
  }

  Visit& visit_;
};

}  // namespace jourdain::model
