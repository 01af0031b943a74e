#include "random_tree.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "model/time_dependence.hpp"
#include "random.hpp"
#include "reference/massless.hpp"
#include "support/check.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::JointType;
using std::numbers::pi;

constexpr int kMaximumDraws = 2000;
constexpr std::uint64_t kStateStream =
    0x5354415445u;  // so that states, inputs and trees of a seed are unrelated
constexpr std::uint64_t kInputStream = 0x494e505554u;

/// One draw of a mechanism, good or not.
class Draw {
 public:
  Draw(TreeClass kind, Random& random) : kind_(kind), random_(random) {}

  model::Mechanism run() {
    const std::size_t least = kind_ == TreeClass::kParallel || kind_ == TreeClass::kMassless ? 2 : 1;
    const std::size_t count = least + random_.below(13 - least);
    if (kind_ == TreeClass::kParameters) add_parameters();
    mechanism_.gravity = gravity();
    for (std::size_t i = 0; i < count; ++i) mechanism_.bodies.push_back(body(i));
    for (std::size_t i = 0; i < count; ++i) mechanism_.joints.push_back(joint(i));
    if (kind_ == TreeClass::kMassless) take_masses();
    shuffle();
    for (std::size_t i = 0; i < count; ++i)
      if (mechanism_.joints[i].type != JointType::kFixed && random_.chance(0.6)) add_actuator(i);
    return std::move(mechanism_);
  }

 private:
  void add_parameters() {
    const std::size_t count = 1 + random_.below(4);
    for (std::size_t i = 0; i < count; ++i) {
      model::Parameter parameter;
      parameter.name = fmt::format("p{}", i);
      parameter.value = random_.uniform(0.5, 2);
      mechanism_.parameters.push_back(parameter);
    }
  }

  void add_actuator(std::size_t joint) {
    model::Actuator actuator;
    actuator.name = "u_" + mechanism_.joints[joint].name;
    actuator.joint = model::JointIndex(joint);
    mechanism_.actuators.push_back(actuator);
  }

  /// `value`, or in the class of tunable mechanisms at times a multiple of it that is positive for positive
  /// parameters.
  Expression tuned(double value) {
    using Op = Expression::Op;
    if (mechanism_.parameters.empty() || random_.chance(0.6)) return value;
    const Expression p =
        Expression::parameter(model::ParameterIndex(random_.below(mechanism_.parameters.size())));
    switch (random_.below(5)) {
      case 0:
        return Expression::binary(Op::kDivide, value, p);
      case 1:
        return Expression::binary(Op::kMultiply, value, Expression::power(p, 2));
      case 2:
        return Expression::binary(Op::kMultiply, value, Expression::unary(Op::kSqrt, p));
      case 3:
        return Expression::binary(Op::kMultiply, Expression::binary(Op::kAdd, 0.5, p), value);
      default:
        return Expression::binary(Op::kMultiply, p, value);
    }
  }

  model::Vector3 gravity() {
    if (random_.chance(0.1)) return {0.0, 0.0, 0.0};
    if (kind_ == TreeClass::kAligned) return {0.0, 0.0, -9.81};
    const double x = random_.uniform(-10, 10), y = random_.uniform(-10, 10), z = random_.uniform(-10, 10);
    return {x, y, tuned(z)};
  }

  /// A coordinate of a point within `reach` (m); often 0 where everything is aligned.
  double coordinate(double reach) {
    const double value = random_.uniform(-reach, reach);
    return kind_ == TreeClass::kAligned && random_.chance(0.5) ? 0 : value;
  }

  double angle() {
    if (kind_ == TreeClass::kAligned) return pi / 2 * (double(random_.below(4)) - 1);
    return random_.uniform(-pi, pi);
  }

  model::Rotation rotation() {
    if (random_.chance(0.2)) return {};
    const double roll = angle(), pitch = angle(), yaw = angle();
    return {{roll, pitch, tuned(yaw)}};
  }

  double mass() {
    const double mantissa = random_.uniform(0.2, 5);
    if (kind_ != TreeClass::kMassRatios) return mantissa;
    static constexpr double kDecades[] = {1e-3, 1e-2, 1e-1, 1, 1e1, 1e2, 1e3};
    return mantissa * kDecades[random_.below(7)];
  }

  /// A cloud of point masses makes a body whose inertia is physically valid whatever the numbers.
  model::Body body(std::size_t index) {
    struct Point {
      double mass;
      reference::Vector3<double> p;
    };
    const double total = mass(), size = random_.uniform(0.05, 0.3);
    reference::Vector3<double> center;
    for (double& c : center) c = coordinate(0.3);
    std::vector<Point> points(4 + random_.below(3));
    double weights = 0;
    reference::Vector3<double> mean = reference::Vector3<double>::Zero();
    for (Point& point : points) {
      point.mass = random_.uniform(0.2, 1);
      for (double& c : point.p) c = random_.uniform(-size, size);
      weights += point.mass;
      mean += point.mass * point.p;
    }
    mean /= weights;
    reference::Matrix3<double> I = reference::Matrix3<double>::Zero();
    for (const Point& point : points) {
      const reference::Vector3<double> r = point.p - mean;
      I += point.mass * total / weights *
           (r.squaredNorm() * reference::Matrix3<double>::Identity() - r * r.transpose());
    }
    return body_of(index, total, center, I);
  }

  /// `I` about the centre of mass; variants of how a file may state it.
  model::Body body_of(std::size_t index, double total, const reference::Vector3<double>& center,
                      reference::Matrix3<double> I) {
    if (random_.chance(0.15)) I.setZero();
    if (random_.chance(kind_ == TreeClass::kAligned ? 0.5 : 0.2)) I = I.diagonal().asDiagonal();
    model::Body body;
    body.name = fmt::format("body{}", index);
    if (random_.chance(0.2)) {
      body.inertia_point = model::InertiaPoint::kOrigin;
      I += total *
           (center.squaredNorm() * reference::Matrix3<double>::Identity() - center * center.transpose());
    } else if (random_.chance(0.2)) {
      body.inertia_axes = rotation();
    }
    const Expression scale = tuned(1);
    const auto scaled = [&](double value) {
      return scale.is_constant() ? Expression(value)
                                 : Expression::binary(Expression::Op::kMultiply, scale, value);
    };
    body.mass = scaled(total);
    body.inertia = {scaled(I(0, 0)), scaled(I(1, 1)), scaled(I(2, 2)),
                    scaled(I(0, 1)), scaled(I(0, 2)), scaled(I(1, 2))};
    const bool movable = body.inertia_point == model::InertiaPoint::kCenterOfMass;
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = center[Eigen::Index(i)];
      body.center_of_mass[i] = movable ? tuned(value) : Expression(value);
    }
    return body;
  }

  std::array<double, 3> axis() {
    if (kind_ == TreeClass::kAligned) {
      std::array<double, 3> unit{0, 0, 0};
      unit[random_.below(3)] = random_.sign();
      return unit;
    }
    if (random_.chance(0.3)) return {0, 0, 1};
    while (true) {
      const std::array<double, 3> a{random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)};
      if (a[0] * a[0] + a[1] * a[1] + a[2] * a[2] > 0.01) return a;
    }
  }

  std::optional<model::BodyIndex> parent_of(std::size_t child) {
    if (child == 0) return {};
    if (kind_ == TreeClass::kParallel && child == 1) return model::BodyIndex(0);
    if (random_.chance(0.1)) return {};
    return model::BodyIndex(random_.chance(0.5) ? child - 1 : random_.below(child));
  }

  JointType joint_type(std::size_t child) {
    if (kind_ == TreeClass::kParallel && child < 2) return JointType::kRevolute;
    const double choice = random_.unit();
    return choice < 0.6 ? JointType::kRevolute : choice < 0.8 ? JointType::kPrismatic : JointType::kFixed;
  }

  model::Joint joint(std::size_t child) {
    model::Joint joint;
    joint.name = fmt::format("joint{}", child);
    joint.set_type(joint_type(child));
    joint.parent = parent_of(child);
    joint.child = model::BodyIndex(child);
    if (random_.chance(0.8))
      for (Expression& c : joint.placement.position) c = tuned(coordinate(0.5));
    joint.placement.rotation = rotation();
    joint.axis = axis();
    if (kind_ == TreeClass::kParallel) make_parallel(joint);
    if (joint.type == JointType::kFixed) {
      joint.axis = {0, 0, 1};
      return joint;
    }
    if (random_.chance(0.3)) joint.coordinates[0].stiffness = tuned(random_.uniform(0, 50));
    if (random_.chance(0.3)) joint.coordinates[0].rest = tuned(random_.uniform(-1, 1));
    if (random_.chance(0.3)) joint.coordinates[0].damping = tuned(random_.uniform(0, 2));
    joint.coordinates[0].initial_position = tuned(random_.uniform(-1, 1));
    joint.coordinates[0].initial_velocity = random_.uniform(-1, 1);
    return joint;
  }

  /// Revolute joints about ±z, and most frames turned about ±z only.
  void make_parallel(model::Joint& joint) {
    const double flip = random_.chance(0.3) ? pi : 0, yaw = angle();
    if (joint.child.value == 1 || random_.chance(0.7)) joint.placement.rotation.rpy = {flip, 0.0, yaw};
    if (joint.type == JointType::kRevolute) joint.axis = {0, 0, random_.sign()};
  }

  /// Takes the mass of some bodies that carry others or hang on a fixed joint.
  void take_masses() {
    std::vector<bool> carrying(mechanism_.bodies.size(), false);
    for (const model::Joint& joint : mechanism_.joints)
      if (joint.parent) carrying[joint.parent->value] = true;
    for (std::size_t i = 0; i < mechanism_.bodies.size(); ++i) {
      if (!carrying[i] && mechanism_.joints[i].type != JointType::kFixed) continue;
      if (!random_.chance(0.5)) continue;
      model::Body massless;
      massless.name = mechanism_.bodies[i].name;
      mechanism_.bodies[i] = massless;
    }
  }

  std::vector<std::size_t> permutation(std::size_t count) {
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = i;
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random_.below(i)]);
    return order;
  }

  /// Declares bodies and joints in random order.
  void shuffle() {
    const std::size_t count = mechanism_.bodies.size();
    const std::vector<std::size_t> place = permutation(count), order = permutation(count);
    std::vector<model::Body> bodies(count);
    for (std::size_t i = 0; i < count; ++i) bodies[place[i]] = mechanism_.bodies[i];
    std::vector<model::Joint> joints;
    for (const std::size_t i : order) {
      model::Joint joint = mechanism_.joints[i];
      joint.child = model::BodyIndex(place[joint.child.value]);
      if (joint.parent) joint.parent = model::BodyIndex(place[joint.parent->value]);
      joints.push_back(joint);
    }
    mechanism_.bodies = std::move(bodies);
    mechanism_.joints = std::move(joints);
  }

  TreeClass kind_;
  Random& random_;
  model::Mechanism mechanism_;
};

bool is_good(const model::Mechanism& mechanism, TreeClass kind, std::uint64_t seed) {
  if (model::moving_joints(mechanism).empty()) return false;
  if (kind == TreeClass::kMassless) {
    bool any = false;
    for (const model::Body& body : mechanism.bodies) any = any || body.mass.is_zero();
    if (!any) return false;
  }
  if (!reference::massless_joints(mechanism).empty()) return false;
  const reference::Terms<double> terms = reference::Reference<double>(mechanism).evaluate(
      random_state(mechanism, seed), random_inputs(mechanism, seed));
  return reference::condition(terms.M) <= kMaximumCondition;
}

}  // namespace

TreeClass tree_class(std::uint64_t seed) {
  switch (seed % 10) {
    case 0:
      return TreeClass::kAligned;
    case 1:
      return TreeClass::kParallel;
    case 2:
      return TreeClass::kMassless;
    case 3:
      return TreeClass::kMassRatios;
    case 4:
      return TreeClass::kParameters;
    default:
      return TreeClass::kGeneral;
  }
}

model::Mechanism random_tree(std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < kMaximumDraws; ++i) {
    model::Mechanism mechanism = Draw(tree_class(seed), random).run();
    mechanism.name = fmt::format("random_tree_{}", seed);
    if (is_good(mechanism, tree_class(seed), seed)) return mechanism;
  }
  throw support::InternalError(
      fmt::format("no regular mechanism in {} draws of seed {}", kMaximumDraws, seed));
}

reference::State<double> random_state(const model::Mechanism& mechanism, std::uint64_t seed) {
  Random random(seed ^ kStateStream);
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  reference::State<double> state{.t = 0,
                                 .y = reference::VectorX<double>(Eigen::Index(layout.position_count())),
                                 .z = reference::VectorX<double>(Eigen::Index(layout.velocity_count()))};
  for (const model::JointIndex index : model::moving_joints(mechanism)) {
    const model::Joint& joint = mechanism.joints[index.value];
    const model::JointEntries& entries = layout.joints[index.value];
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c) {
      if (!entries.position[c]) continue;
      const double turn = random.uniform(-pi, pi), slide = turn / pi;
      state.y[Eigen::Index(*entries.position[c])] = joint.coordinates[c].angular ? turn : slide;
      state.z[Eigen::Index(*entries.velocity[c])] = random.uniform(-2, 2);
    }
    if (!joint.coordinates.empty()) continue;
    for (std::size_t k = 0; k < entries.position_count; ++k)
      state.y[Eigen::Index(entries.first_position + k)] = random.uniform(-1, 1);
    for (std::size_t k = 0; k < entries.velocity_count; ++k)
      state.z[Eigen::Index(entries.first_velocity + k)] = random.uniform(-2, 2);
  }
  for (const std::size_t q : layout.quaternions) state.y.segment<4>(Eigen::Index(q)).normalize();
  if (model::time_dependence(mechanism).any()) state.t = random.uniform(0, 2);
  const std::vector<double> parameters = model::default_values(mechanism);
  for (std::size_t i = 0; i < layout.state_count; ++i) {
    const model::StateVariable& beside = mechanism.states[i];
    state.z[Eigen::Index(layout.first_state() + i)] =
        beside.initial.evaluate<double>(parameters) +
        random.uniform(-2, 2) * beside.nominal.evaluate<double>(parameters);
  }
  return state;
}

reference::VectorX<double> random_inputs(const model::Mechanism& mechanism, std::uint64_t seed) {
  Random random(seed ^ kInputStream);
  reference::VectorX<double> u(Eigen::Index(model::lay_out_coordinates(mechanism).input_count()));
  for (double& value : u) value = random.uniform(-5, 5);
  return u;
}

}  // namespace jourdain::tests
