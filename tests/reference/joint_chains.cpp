#include "joint_chains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "properties/gimbals.hpp"
#include "properties/random.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::JointType;
using Op = Expression::Op;

constexpr std::uint64_t kStateStream = 0x434841494eu;  // so that states and chains of a seed are unrelated

Expression scaled(double factor, const Expression& expression) {
  return Expression::binary(Op::kMultiply, factor, expression);
}

Expression sum(const Expression& a, const Expression& b) { return Expression::binary(Op::kAdd, a, b); }

class ChainDraw {
 public:
  ChainDraw(std::uint64_t seed, bool prescribed) : random_(seed), prescribed_(prescribed) {}

  model::Mechanism run(const std::vector<JointType>& types) {
    mechanism_.gravity = vector(10);
    for (std::size_t i = 0; i < types.size(); ++i) add(types[i], i);
    return mechanism_;
  }

 private:
  double number(double size) { return random_.uniform(-size, size); }
  std::array<double, 3> direction() { return {number(1), number(1), 0.3 + random_.unit()}; }
  model::Vector3 vector(double size) { return {number(size), number(size), number(size)}; }

  void add(JointType type, std::size_t i) {
    model::Body body;
    body.name = fmt::format("b{}", i);
    body.mass = random_.uniform(0.5, 2);
    body.center_of_mass = vector(0.5);
    body.inertia.xx = random_.uniform(0.5, 0.9);
    body.inertia.yy = random_.uniform(0.5, 0.9);
    body.inertia.zz = random_.uniform(0.5, 0.9);
    mechanism_.bodies.push_back(body);

    model::Joint joint;
    joint.name = fmt::format("j{}", i);
    joint.set_type(type);
    joint.child = model::BodyIndex(i);
    if (i > 0) joint.parent = model::BodyIndex(i - 1);
    if (type != JointType::kFree) joint.placement = {vector(0.5), {.rpy = vector(1)}};
    joint.axis = direction();
    joint.second_axis = {1, number(0.5), number(0.5)};
    joint.pitch = number(1);
    if (type == JointType::kGimbal) joint.sequence = random_sequence(random_);
    joint.spin_damping = random_.unit();
    const Expression s = Expression::variable({model::Variable::Kind::kArgument});
    joint.curve = {Expression::unary(Op::kCos, s), scaled(0.7, Expression::unary(Op::kSin, s)),
                   sum(s, scaled(0.3, Expression::power(s, 2)))};
    for (model::Coordinate& coordinate : joint.coordinates) fill(coordinate);
    mechanism_.joints.push_back(joint);
    for (std::size_t c = 0; c < joint.coordinates.size(); ++c) add_actuator(i, c);
  }

  void fill(model::Coordinate& coordinate) {
    coordinate.stiffness = 5 * random_.unit();
    coordinate.rest = number(1);
    coordinate.damping = random_.unit();
    coordinate.friction = random_.unit();
    coordinate.friction_speed = 0.1 + random_.unit();
    const Expression t = Expression::variable({model::Variable::Kind::kTime});
    const double slope = number(1), amplitude = number(1), frequency = random_.uniform(0.5, 2);
    if (!prescribed_ || !random_.chance(0.35)) return;
    coordinate.motion =
        sum(scaled(slope, t), scaled(amplitude, Expression::unary(Op::kSin, scaled(frequency, t))));
  }

  void add_actuator(std::size_t joint, std::size_t coordinate) {
    mechanism_.actuators.push_back({.name = fmt::format("u{}_{}", joint, coordinate),
                                    .joint = model::JointIndex(joint),
                                    .coordinate = coordinate,
                                    .gear_ratio = number(3),
                                    .rotor_inertia = 0.2 * random_.unit()});
  }

  Random random_;
  bool prescribed_;
  model::Mechanism mechanism_;
};

}  // namespace

model::Mechanism random_chain(const std::vector<JointType>& types, std::uint64_t seed, bool prescribed) {
  return ChainDraw(seed, prescribed).run(types);
}

model::Mechanism random_chain(std::uint64_t seed, bool prescribed) {
  Random random(seed);
  const auto any = [&] {
    const JointType type = kJointTypes[random.below(std::size(kJointTypes))];
    return type == JointType::kFree ? JointType::kRevolute : type;
  };
  const JointType type = kJointTypes[seed % std::size(kJointTypes)];
  const bool root = type == JointType::kFree;
  return random_chain({root ? type : any(), root ? any() : type, any(), any()}, seed, prescribed);
}

ChainState random_chain_state(const model::CoordinateLayout& layout, std::uint64_t seed) {
  Random random(seed ^ kStateStream);
  const auto numbers = [&](std::size_t count) {
    Eigen::VectorX<long double> values(static_cast<Eigen::Index>(count));
    for (long double& value : values) value = random.uniform(-2, 2);
    return values;
  };
  ChainState state{.t = random.uniform(0, 3),
                   .y = numbers(layout.position_count()),
                   .z = numbers(layout.velocity_count()),
                   .u = numbers(layout.input_count())};
  for (const std::size_t w : layout.quaternions) state.y.segment<4>(static_cast<Eigen::Index>(w)).normalize();
  return state;
}

Eigen::VectorX<long double> position_rates(const model::Mechanism& mechanism,
                                           const model::CoordinateLayout& layout, const ChainState& state) {
  Eigen::VectorX<long double> rates(state.y.size());
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j) {
    auto y = static_cast<Eigen::Index>(layout.joints[j].first_position);
    auto z = static_cast<Eigen::Index>(layout.joints[j].first_velocity);
    const JointType type = mechanism.joints[j].type;
    if (type != JointType::kSpherical) {
      const auto plain = type == JointType::kFree ? 3 : Eigen::Index(layout.joints[j].velocity_count);
      rates.segment(y, plain) = state.z.segment(z, plain);
      y += plain;
      z += plain;
    }
    if (type != JointType::kSpherical && type != JointType::kFree) continue;
    const long double w = state.y[y];
    const Eigen::Vector3<long double> v = state.y.segment<3>(y + 1), omega = state.z.segment<3>(z);
    rates[y] = -v.dot(omega) / 2;
    rates.segment<3>(y + 1) = (w * omega + v.cross(omega)) / 2;
  }
  return rates;
}

}  // namespace jourdain::tests
