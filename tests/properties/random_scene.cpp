#include "properties/random_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/coordinates.hpp"
#include "properties/arithmetic.hpp"
#include "properties/gimbals.hpp"
#include "properties/random.hpp"
#include "properties/random_tree.hpp"
#include "reference/massless.hpp"
#include "support/enumerators.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::JointType;
using model::Variable;

constexpr int kMaximumDraws = 2000;
constexpr double kLargestCondition = 1e8;
constexpr std::size_t kMostBodies = 8;

/// Whether two directions are within some twenty degrees of each other or of opposite ones.
bool are_near(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const double sizes = (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
  return dot * dot > 0.9 * sizes;
}

class Decoration {
 public:
  Decoration(model::Mechanism mechanism, Random& random)
      : mechanism_(std::move(mechanism)), random_(random) {}

  model::Mechanism run() {
    mechanism_.actuators.clear();
    for (model::Joint& joint : mechanism_.joints) change_type(joint);
    if (random_.chance(0.33)) make_one_free();
    for (model::Joint& joint : mechanism_.joints) fill(joint);
    add_actuators();
    add_frames();
    add_inputs();
    for (std::size_t i = random_.below(3); i-- > 0;) add_load();
    for (std::size_t i = random_.below(3); i-- > 0;) add_spring();
    if (random_.chance(0.4)) add_coordinate_force();
    for (std::size_t i = 2 + random_.below(3); i-- > 0;) add_output();
    if (random_.chance(0.4)) add_bushing();
    return std::move(mechanism_);
  }

 private:
  Expression number(double low, double high) {
    const Expression value = random_.uniform(low, high);
    if (mechanism_.parameters.empty() || random_.chance(0.7)) return value;
    return value * Expression::parameter(model::ParameterIndex(random_.below(mechanism_.parameters.size())));
  }

  void change_type(model::Joint& joint) {
    const bool fixed = joint.type == JointType::kFixed;
    if (random_.chance(fixed ? 0.7 : 0.3)) return;
    joint.set_type(moving_type());
  }

  /// Any that may hang on a body.
  JointType moving_type() {
    constexpr auto kTypes = support::entries_of<JointType>();
    JointType type = JointType::kFree;
    while (type == JointType::kFixed || type == JointType::kFree) type = kTypes[random_.below(kTypes.size())];
    return type;
  }

  void make_one_free() {
    for (model::Joint& joint : mechanism_.joints) {
      if (joint.parent) continue;
      joint.set_type(JointType::kFree);
      joint.placement = {};
      return;
    }
  }

  void fill(model::Joint& joint) {
    joint.pitch = number(-0.3, 0.3);
    joint.second_axis = random_.chance(0.5)
                            ? std::array<double, 3>{1, 0, 0}
                            : std::array<double, 3>{random_.uniform(0.5, 1), random_.uniform(-1, 1), 0.1};
    if (joint.type == JointType::kUniversal && random_.chance(0.5)) joint.axis = {0, 0, random_.sign()};
    if (joint.type == JointType::kUniversal && are_near(joint.axis, joint.second_axis))
      joint.second_axis = {joint.axis[1], joint.axis[2], -joint.axis[0]};
    if (joint.type == JointType::kCurve) {
      const Expression s = variable(Variable::Kind::kArgument);
      joint.curve = {number(0.3, 1) * s, number(-0.3, 0.3) * sine(number(0.5, 2) * s),
                     number(0.1, 0.3) * cosine(s) + number(0.1, 0.2) * s * s};
    }
    if (joint.type == JointType::kGimbal) joint.sequence = random_sequence(random_);
    if (joint.type == JointType::kSpherical && random_.chance(0.5)) joint.spin_damping = number(0, 1);
    if (joint.type == JointType::kFree || joint.type == JointType::kSpherical) {
      joint.initial_orientation = {0.5, -0.5, 0.5, 0.5};
      for (Expression& w : joint.initial_spin) w = random_.uniform(-1, 1);
    }
    for (model::Coordinate& coordinate : joint.coordinates) fill(coordinate);
  }

  void fill(model::Coordinate& coordinate) {
    if (random_.chance(0.3)) coordinate.stiffness = number(0, 30);
    if (random_.chance(0.3)) coordinate.rest = number(-1, 1);
    if (random_.chance(0.3)) coordinate.damping = number(0, 2);
    if (random_.chance(0.15)) {
      coordinate.friction = number(0, 2);
      coordinate.friction_speed = random_.uniform(0.1, 1);
    }
    if (random_.chance(0.15)) {
      const Expression t = variable(Variable::Kind::kTime);
      coordinate.motion = number(-0.5, 0.5) * sine(number(0.5, 3) * t) + number(-1, 1) * t;
      coordinate.initial_position = coordinate.initial_velocity = 0.0;
    } else {
      coordinate.initial_position = number(-1, 1);
      coordinate.initial_velocity = number(-1, 1);
    }
  }

  /// Calls `visit(joint, coordinate index, coordinate)` for each scalar coordinate.
  template <class Visit>
  void for_coordinates(Visit&& visit) {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c)
        visit(j, c, mechanism_.joints[j].coordinates[c]);
  }

  void add_actuators() {
    for_coordinates([this](std::size_t j, std::size_t c, const model::Coordinate& coordinate) {
      if (coordinate.motion || !random_.chance(0.4)) return;
      model::Actuator actuator;
      actuator.name = "u_" + coordinate.name;
      actuator.joint = model::JointIndex(j);
      actuator.coordinate = c;
      if (random_.chance(0.4)) actuator.gear_ratio = number(0.5, 5);
      if (random_.chance(0.4)) actuator.rotor_inertia = number(0.01, 0.2);
      mechanism_.actuators.push_back(actuator);
    });
  }

  void add_frames() {
    for (std::size_t i = 0; i < 3; ++i) {
      model::Frame frame;
      frame.name = fmt::format("frame{}", i);
      if (i < 2) frame.body = model::BodyIndex(random_.below(mechanism_.bodies.size()));
      for (Expression& c : frame.placement.position) c = number(-0.5, 0.5);
      if (random_.chance(0.6))
        frame.placement.rotation.rpy = {random_.uniform(-3, 3), random_.uniform(-1, 1),
                                        random_.uniform(-3, 3)};
      mechanism_.frames.push_back(frame);
    }
  }

  void add_inputs() {
    for (std::size_t i = random_.below(3); i-- > 0;)
      mechanism_.inputs.push_back({fmt::format("in{}", mechanism_.inputs.size()), "N", "", {}});
  }

  /// A quantity of any kind that expressions may name.
  Expression quantity() {
    std::vector<Expression> choice = {variable(Variable::Kind::kTime)};
    const std::size_t inputs = mechanism_.actuators.size() + mechanism_.inputs.size();
    if (inputs > 0) choice.push_back(variable(Variable::Kind::kInput, random_.below(inputs)));
    const std::size_t frame = random_.below(3), axis = random_.below(3);
    choice.push_back(variable(Variable::Kind::kFramePosition, frame, axis));
    choice.push_back(variable(Variable::Kind::kFrameVelocity, frame, axis));
    choice.push_back(variable(Variable::Kind::kFrameSpin, frame, axis));
    for_coordinates([&](std::size_t j, std::size_t c, const model::Coordinate&) {
      choice.push_back(variable(Variable::Kind::kPosition, j, c));
      choice.push_back(variable(Variable::Kind::kVelocity, j, c));
    });
    return choice[random_.below(choice.size())];
  }

  Expression expression() {
    const Expression a = quantity(), b = quantity();
    switch (random_.below(5)) {
      case 0:
        return number(-3, 3);
      case 1:
        return number(-3, 3) * a;
      case 2:
        return number(-3, 3) * sine(a) + b;
      case 3:
        return a * b - number(0, 1);
      default:
        return a / Expression::unary(Expression::Op::kSqrt, b * b + Expression(1.0));
    }
  }

  model::FrameIndex body_frame() { return model::FrameIndex(random_.below(2)); }

  void add_load() {
    model::Load load;
    load.name = fmt::format("load{}", mechanism_.loads.size());
    load.frame = body_frame();
    load.axes = random_.chance(0.5) ? model::LoadAxes::kFrame : model::LoadAxes::kWorld;
    for (Expression& f : load.force)
      if (random_.chance(0.6)) f = expression();
    for (Expression& n : load.moment)
      if (random_.chance(0.4)) n = expression();
    mechanism_.loads.push_back(load);
  }

  void add_spring() {
    model::Spring spring;
    spring.name = fmt::format("spring{}", mechanism_.springs.size());
    spring.from = model::FrameIndex(random_.below(3));
    spring.to = body_frame();
    if (mechanism_.frames[spring.from.value].body == mechanism_.frames[spring.to.value].body) return;
    spring.stiffness = number(0, 30);
    if (random_.chance(0.5)) spring.damping = number(0, 3);
    if (random_.chance(0.7)) spring.free_length = number(0, 1);
    if (random_.chance(0.4)) {
      const Expression length = variable(Variable::Kind::kArgument);
      spring.law = number(1, 5) * length * length;
      if (random_.chance(0.5))
        spring.potential = number(0.3, 2) * length * length * length;
      else
        spring.law = spring.law + number(0, 1) * variable(Variable::Kind::kArgument, 0, 1);
    }
    mechanism_.springs.push_back(spring);
  }

  void add_bushing() {
    model::Bushing bushing;
    bushing.name = "bushing";
    bushing.from = body_frame();
    bushing.to = model::FrameIndex(random_.below(3));
    if (mechanism_.frames[bushing.from.value].body == mechanism_.frames[bushing.to.value].body) return;
    for (std::size_t i = 0; i < 3; ++i) {
      bushing.stiffness[i] = number(0, 30);
      bushing.torsional_stiffness[i] = number(0, 10);
      if (random_.chance(0.5)) bushing.damping[i] = number(0, 3);
      if (random_.chance(0.5)) bushing.torsional_damping[i] = number(0, 1);
    }
    mechanism_.bushings.push_back(bushing);
  }

  void add_coordinate_force() {
    for_coordinates([this](std::size_t j, std::size_t c, const model::Coordinate&) {
      if (!random_.chance(0.3)) return;
      model::CoordinateForce force;
      force.name = fmt::format("push{}", mechanism_.coordinate_forces.size());
      force.joint = model::JointIndex(j);
      force.coordinate = c;
      force.force = expression();
      mechanism_.coordinate_forces.push_back(force);
    });
  }

  void add_output() {
    model::Output output;
    output.name = fmt::format("out{}", mechanism_.outputs.size());
    output.kind = static_cast<model::OutputKind>(random_.below(support::entry_count<model::OutputKind>()));
    output.frame = model::FrameIndex(random_.below(3));
    output.joint = model::JointIndex(random_.below(mechanism_.joints.size()));
    if (output.kind == model::OutputKind::kExpression) output.value = expression();
    if (output.kind == model::OutputKind::kDrive) {
      bool found = false;
      for_coordinates([&](std::size_t j, std::size_t c, const model::Coordinate& coordinate) {
        if (found || !coordinate.motion) return;
        output.joint = model::JointIndex(j);
        output.coordinate = c;
        found = true;
      });
      if (!found) return;
    }
    mechanism_.outputs.push_back(output);
  }

  model::Mechanism mechanism_;
  Random& random_;
};

bool is_good(const model::Mechanism& mechanism, std::uint64_t seed) {
  if (!reference::massless_joints(mechanism).empty()) return false;
  const reference::Terms<double> terms = reference::Reference<double>(mechanism).evaluate(
      random_state(mechanism, seed), random_inputs(mechanism, seed));
  return reference::condition(terms.M) <= kLargestCondition && terms.q_scale.norm() < 1e6;
}

}  // namespace

model::Mechanism random_scene(std::uint64_t seed) {
  Random random(seed * 31 + 5);
  for (int i = 0; i < kMaximumDraws; ++i) {
    model::Mechanism tree = random_tree(random.below(100000));
    if (tree.bodies.size() > kMostBodies) continue;
    model::Mechanism mechanism = Decoration(std::move(tree), random).run();
    mechanism.name = fmt::format("random_scene_{}", seed);
    if (is_good(mechanism, seed)) return mechanism;
  }
  throw support::InternalError(fmt::format("no regular scene in {} draws of seed {}", kMaximumDraws, seed));
}

bool has_motion(const model::Mechanism& mechanism) {
  for (const model::Joint& joint : mechanism.joints)
    for (const model::Coordinate& coordinate : joint.coordinates)
      if (coordinate.motion) return true;
  return false;
}

bool has_free_joint(const model::Mechanism& mechanism) {
  return std::any_of(mechanism.joints.begin(), mechanism.joints.end(),
                     [](const model::Joint& joint) { return joint.type == JointType::kFree; });
}

}  // namespace jourdain::tests
