#include "properties/random_rolling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/loop_kinds.hpp"
#include "model/output_kinds.hpp"
#include "properties/arithmetic.hpp"
#include "properties/consistent_state.hpp"
#include "properties/loop_ends.hpp"
#include "properties/random.hpp"
#include "properties/random_loops.hpp"
#include "properties/random_scene.hpp"
#include "support/check.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::LoopType;
using model::Variable;

constexpr int kMostDrawsOfRolling = 200;
constexpr long double kFastestRolling = 1e8L;  // rad/s^2, m/s^2

class Constraints {
  using Kind = Variable::Kind;

 public:
  Constraints(model::Mechanism& mechanism, Random& random) : mechanism_(mechanism), random_(random) {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c)
        if (!mechanism_.joints[j].coordinates[c].motion) scalars_.push_back({model::JointIndex(j), c});
  }

  void add(LoopType type) {
    if (type != LoopType::kVelocity) return LoopEnds(mechanism_, {}, random_).close(type);
    model::Loop loop;
    loop.name = fmt::format("loop{}", mechanism_.loops.size());
    loop.type = type;
    loop.residual = number() * rate() + sine(position()) * rate() + number() * frame_rate();
    if (random_.chance(0.3)) loop.residual = loop.residual + sine(variable(Kind::kTime)) * number();
    mechanism_.loops.push_back(loop);
    // Which bodies its force acts on is not known: no joint says what it transmits.
    std::erase_if(mechanism_.outputs,
                  [](const model::Output& output) { return model::output_kind(output.kind).is_of_joint(); });
  }

 private:
  Expression number() { return random_.uniform(-2, 2); }

  Expression of_scalar(Kind kind) {
    if (scalars_.empty()) return frame_rate();
    const model::ScalarCoordinate& at = scalars_[random_.below(scalars_.size())];
    return variable(kind, at.joint.value, at.coordinate);
  }
  Expression rate() { return of_scalar(Kind::kVelocity); }
  Expression position() { return scalars_.empty() ? number() : of_scalar(Kind::kPosition); }

  Expression frame_rate() {
    static constexpr Kind kKinds[] = {Kind::kFrameVelocity, Kind::kFrameSpin, Kind::kFrameWorldSpin};
    model::Frame frame;
    frame.name = fmt::format("frame{}", mechanism_.frames.size());
    frame.body = model::BodyIndex(random_.below(mechanism_.bodies.size()));
    for (Expression& x : frame.placement.position) x = random_.uniform(-0.5, 0.5);
    for (Expression& angle : frame.placement.rotation.rpy) angle = random_.uniform(-1, 1);
    mechanism_.frames.push_back(frame);
    return variable(kKinds[random_.below(3)], mechanism_.frames.size() - 1, random_.below(3));
  }

  model::Mechanism& mechanism_;
  Random& random_;
  std::vector<model::ScalarCoordinate> scalars_;
};

/// Some of what rolls does so on ground of a height, less curved than it is.
void raise_ground(model::Mechanism& mechanism, Random& random) {
  for (model::Loop& loop : mechanism.loops) {
    if (!model::loop_kind(loop).takes("height") || !random.chance(0.15)) continue;
    Expression phase = random.uniform(-2, 2);
    for (std::size_t k = 0; k < 3; ++k)
      phase = phase + Expression(random.uniform(-2, 2)) *
                          Expression::variable({.kind = Variable::Kind::kArgument, .component = k});
    loop.height = Expression(random.uniform(0.01, 0.03)) * sine(phase);
    if (random.chance(0.3)) loop.height = loop.height + Expression(random.uniform(-0.2, 0.2)) * phase;
  }
}

/// A body that flies freely.
void add_flying_body(model::Mechanism& mechanism, Random& random) {
  model::Joint joint;
  joint.name = "flight";
  joint.child = model::BodyIndex(mechanism.bodies.size());
  joint.set_type(model::JointType::kFree);
  for (Expression& x : joint.initial_origin) x = random.uniform(-0.7, 0.7);
  model::Body& body = mechanism.bodies.emplace_back();
  body.name = "flying";
  body.mass = random.uniform(0.5, 3);
  for (Expression& x : body.center_of_mass) x = random.uniform(-0.2, 0.2);
  for (Expression* moment : {&body.inertia.xx, &body.inertia.yy, &body.inertia.zz})
    *moment = random.uniform(0.1, 0.15);
  mechanism.joints.push_back(joint);
}

bool all_hold(const model::Mechanism& mechanism, const reference::MatrixX<long double>& G) {
  Eigen::Index first = 0;
  for (const model::Loop& loop : mechanism.loops) {
    const auto count = Eigen::Index(model::row_count(loop.type));
    if (G.middleRows(first, count).norm() < kWeakestConstraint) return false;
    first += count;
  }
  return true;
}

bool is_good(const model::Mechanism& mechanism, std::uint64_t seed) {
  const auto states = consistent_states(mechanism, seed, kLoopStates);
  if (!states) return false;
  const reference::DescriptorReference<long double> form(mechanism);
  std::optional<Eigen::Index> rank;
  for (const LoopState& state : *states) {
    const auto constraints = form.loop_constraints(state.t, state.y, state.z);
    const LoopFreedom freedom = loop_freedom(constraints);
    if (!all_hold(mechanism, constraints.G)) return false;
    // Where a gimbal's angles are no measure of its turn the descriptor form has no accelerations.
    const reference::VectorX<long double> u = reference::VectorX<long double>::Zero(
        Eigen::Index(model::lay_out_coordinates(mechanism).input_count()));
    if (!(form.solve(state.t, state.y, state.z, u).zdot.norm() < kFastestRolling)) return false;
    if (rank && *rank != freedom.rank) return false;
    rank = freedom.rank;
    if (freedom.weakest < kWeakestConstraint || freedom.motions.cols() < 1) return false;
  }
  return true;
}

}  // namespace

model::Mechanism random_rolling(std::uint64_t seed) {
  static constexpr LoopType kTypes[] = {LoopType::kRollingWheel, LoopType::kVelocity, LoopType::kRollingBall,
                                        LoopType::kKnifeEdge, LoopType::kRollingEllipsoid};
  for (std::uint64_t draw = 0; draw < kMostDrawsOfRolling; ++draw) {
    const std::uint64_t stream = seed + 100000 * draw;
    Random random(stream ^ 0x524f4c4cu);
    model::Mechanism mechanism = seed % 3 == 2 ? random_loops(stream) : random_scene(stream);
    if (seed % 3 == 2) add_flying_body(mechanism, random);
    if (mechanism.bodies.size() < 2 || model::lay_out_coordinates(mechanism).velocity_count() < 2) continue;
    Constraints constraints(mechanism, random);
    constraints.add(kTypes[seed / 3 % 5]);  // goes with the seed: a type that passes seldom is there as often
    if (random.chance(0.4)) constraints.add(kTypes[random.below(5)]);
    Random ground(stream ^ 0x47524e44u);
    raise_ground(mechanism, ground);
    if (is_good(mechanism, seed)) return mechanism;
  }
  JD_CHECK(false, "no mechanism for seed {}", seed);
  return {};
}

model::Mechanism asking_for_independent_velocities(model::Mechanism mechanism) {
  constexpr double kWay = 0.45;
  mechanism.loop_options = {};
  mechanism.loop_options.treatment = model::LoopTreatment::kExplicit;
  const std::vector<double> parameters = model::default_values(mechanism);
  for (model::Joint& joint : mechanism.joints)
    for (model::Coordinate& coordinate : joint.coordinates) {
      const double start = coordinate.initial_position.evaluate<double>(parameters);
      if (!coordinate.motion) coordinate.range = {start - kWay, start + kWay};
    }
  return mechanism;
}

}  // namespace jourdain::tests
