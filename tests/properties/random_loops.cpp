#include "properties/random_loops.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "properties/arithmetic.hpp"
#include "properties/consistent_state.hpp"
#include "properties/loop_ends.hpp"
#include "properties/random.hpp"
#include "properties/random_tree.hpp"
#include "reference/massless.hpp"

namespace jourdain::tests {

namespace {

using model::Expression;
using model::JointType;
using model::LoopType;
using model::Variable;
using std::numbers::pi;

constexpr int kMaximumDraws = 3000;
constexpr double kLargestCondition = 1e8;
constexpr std::size_t kMostBodies = 9;
constexpr double kHolds = 1e-9;  // a coordinate with a smaller column in G is not held by loops
constexpr double kMoves = 1e-2;  // a held coordinate moves if some motion has a larger share of it

/// One draw of a mechanism, good or not.
class LoopDraw {
 public:
  LoopDraw(std::uint64_t seed, Random& random)
      : seed_(seed), kind_(loop_class(seed)), loops_(1 + seed / 8 % 3), random_(random) {}

  model::Mechanism run() {
    if (random_.chance(0.8))
      for (Expression& g : mechanism_.gravity) g = random_.uniform(-8, 8);
    if (kind_ != LoopClass::kSpatial && random_.chance(0.5))
      tilt_ = {random_.uniform(-2, 2), random_.uniform(-1, 1), random_.uniform(-2, 2)};
    draw_bodies();
    if (kind_ == LoopClass::kParallelogram) {
      add_parallelogram();
    } else {
      draw_types();
      draw_tree();
      if (random_.chance(0.5)) prescribe_one();
      LoopEnds ends(mechanism_, planar() ? std::optional(tilt_) : std::nullopt, random_);
      for (const LoopType type : types_) ends.close(type);
    }
    decorate();
    return std::move(mechanism_);
  }

 private:
  bool planar() const { return kind_ != LoopClass::kSpatial; }

  /// Inertias as random trees have them.
  void draw_bodies() {
    while (bodies_.size() < kMostBodies)
      for (model::Body body : random_tree(10 * random_.below(10000) + 5).bodies) {
        body.name = fmt::format("body{}", bodies_.size());
        bodies_.push_back(body);
      }
  }

  void draw_types() {
    static constexpr LoopType kRegular[] = {LoopType::kPlanarPin, LoopType::kPlanarPin, LoopType::kRod,
                                            LoopType::kPointInPlane, LoopType::kResidual};
    static constexpr LoopType kRedundant[] = {
        LoopType::kRevolute,  LoopType::kRevolute,    LoopType::kBall,       LoopType::kUniversal,
        LoopType::kPrismatic, LoopType::kCylindrical, LoopType::kPointOnLine};
    // The first loop's type goes with the seed: types that close few draws would hardly pass otherwise.
    const std::size_t number = std::size_t(seed_ / 8 * 4 + seed_ % 4);
    for (std::size_t i = 0; i < loops_; ++i) {
      const auto choice = [&](std::size_t count) { return i == 0 ? number % count : random_.below(count); };
      if (kind_ == LoopClass::kSpatial)
        types_.push_back(static_cast<LoopType>(choice(10)));
      else if (kind_ == LoopClass::kOverconstrained && (i == 0 || random_.chance(0.5)))
        types_.push_back(kRedundant[choice(std::size(kRedundant))]);
      else
        types_.push_back(kRegular[choice(std::size(kRegular))]);
    }
  }

  /// Rows that a loop has in the class: what the plane makes redundant not counted.
  std::size_t rank_of(LoopType type) const {
    const std::size_t rows = model::row_count(type);
    if (!planar()) return rows;
    if (type == LoopType::kPointOnLine) return 1;
    return std::min<std::size_t>(rows, 2);
  }

  void draw_tree() {
    std::size_t needed = 1 + random_.below(2), freedom = 0;
    for (const LoopType type : types_) needed += rank_of(type);
    while ((freedom < needed || mechanism_.bodies.size() < 2) && mechanism_.bodies.size() < kMostBodies)
      freedom += add_joint();
  }

  std::size_t add_joint() {
    const std::size_t child = mechanism_.bodies.size();
    mechanism_.bodies.push_back(bodies_[child]);
    model::Joint& joint = mechanism_.joints.emplace_back();
    joint.name = fmt::format("joint{}", child);
    joint.child = model::BodyIndex(child);
    if (child > 0 && random_.chance(0.75))
      joint.parent = model::BodyIndex(random_.chance(0.7) ? child - 1 : random_.below(child));
    joint.set_type(joint_type(joint));
    if (joint.type != JointType::kFree) place(joint);
    if (!planar()) turn(joint);
    start(joint);
    return model::lay_out_coordinates(mechanism_).joints[child].velocity_count;
  }

  JointType joint_type(const model::Joint& joint) {
    static constexpr JointType kInPlane[] = {JointType::kRevolute, JointType::kRevolute, JointType::kRevolute,
                                             JointType::kRevolute, JointType::kPrismatic};
    static constexpr JointType kInSpace[] = {
        JointType::kRevolute,    JointType::kRevolute,  JointType::kUniversal, JointType::kSpherical,
        JointType::kCylindrical, JointType::kPrismatic, JointType::kScrew,     JointType::kFree};
    if (planar()) return kInPlane[random_.below(std::size(kInPlane))];
    const JointType type = kInSpace[random_.below(std::size(kInSpace))];
    return type == JointType::kFree && joint.parent ? JointType::kSpherical : type;
  }

  void place(model::Joint& joint) {
    for (std::size_t i = 0; i < (planar() ? 2 : 3); ++i)
      joint.placement.position[i] = random_.uniform(-0.6, 0.6);
    if (planar()) {
      joint.axis = {0, 0, 1};
      if (joint.type == JointType::kPrismatic) {
        const double angle = random_.uniform(-pi, pi);
        joint.axis = {std::cos(angle), std::sin(angle), 0};
      }
      joint.placement.rotation.rpy = {0.0, 0.0, random_.chance(0.5) ? random_.uniform(-pi, pi) : 0.0};
      if (!joint.parent) stand_in_plane(joint);
    } else if (random_.chance(0.7)) {
      joint.placement.rotation.rpy = {random_.uniform(-pi, pi), random_.uniform(-1, 1),
                                      random_.uniform(-pi, pi)};
    }
  }

  /// The world carries one body without a coordinate in the plane's frame, where that is tilted.
  void stand_in_plane(model::Joint& joint) {
    const model::Rotation plane{{tilt_[0], tilt_[1], tilt_[2]}};
    const reference::Matrix3<double> R = reference::rotation_value<double>(plane, {}, true);
    const Eigen::Vector3d origin = R * Eigen::Vector3d(joint.placement.position[0].constant(),
                                                       joint.placement.position[1].constant(), 0);
    for (std::size_t i = 0; i < 3; ++i) joint.placement.position[i] = origin[Eigen::Index(i)];
    joint.placement.rotation.rpy = {tilt_[0], tilt_[1], tilt_[2]};
  }

  void turn(model::Joint& joint) {
    if (random_.chance(0.7))
      joint.axis = {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(0.2, 1)};
    const auto across = Eigen::Vector3d(joint.axis.data()).unitOrthogonal();
    joint.second_axis = {across.x(), across.y(), across.z()};
    joint.pitch = random_.uniform(-0.3, 0.3);
  }

  void start(model::Joint& joint) {
    for (model::Coordinate& coordinate : joint.coordinates)
      coordinate.initial_position =
          coordinate.angular ? random_.uniform(-pi, pi) : random_.uniform(-0.5, 0.5);
    for (Expression& x : joint.initial_origin) x = random_.uniform(-0.7, 0.7);
    Eigen::Quaterniond q(random_.uniform(0.2, 1), random_.uniform(-1, 1), random_.uniform(-1, 1),
                         random_.uniform(-1, 1));
    q.normalize();
    joint.initial_orientation = {q.w(), q.x(), q.y(), q.z()};
  }

  /// From rest at the initial position, so that rates of zero meet the constraints.
  void prescribe_one() {
    model::Joint& joint = mechanism_.joints[random_.below(mechanism_.joints.size())];
    if (joint.coordinates.empty()) return;
    model::Coordinate& coordinate = joint.coordinates[random_.below(joint.coordinates.size())];
    coordinate.motion = coordinate.initial_position + departure(random_);
    coordinate.initial_position = 0.0;
  }

  /// A platform (body 0) on a crank; the other cranks stand on the world and are pinned to it.
  void add_parallelogram() {
    const double length = random_.uniform(0.3, 0.8), angle = random_.uniform(-2, 2);
    const auto add = [&](std::optional<model::BodyIndex> parent, double x, double y, double position) {
      const std::size_t child = mechanism_.bodies.size();
      mechanism_.bodies.push_back(bodies_[child]);
      model::Joint& joint = mechanism_.joints.emplace_back();
      joint.name = fmt::format("joint{}", child);
      joint.set_type(JointType::kRevolute);
      joint.parent = parent;
      joint.child = model::BodyIndex(child);
      joint.placement.position = {x, y, 0.0};
      joint.coordinates[0].initial_position = position;
      if (!parent) stand_in_plane(joint);
    };
    add({}, 0, 0, angle);
    add(model::BodyIndex(0), length, 0, -angle);
    for (std::size_t i = 0; i < loops_; ++i) {
      const double x = random_.uniform(0.3, 0.6) * double(i + 1), y = random_.uniform(-0.3, 0.3);
      add({}, x, y, angle);
      const auto frame = [&](std::size_t body, const model::Vector3& position) {
        model::Frame& added = mechanism_.frames.emplace_back();
        added.name = fmt::format("frame{}", mechanism_.frames.size() - 1);
        added.body = model::BodyIndex(body);
        added.placement.position = position;
        return model::FrameIndex(mechanism_.frames.size() - 1);
      };
      model::Loop& loop = mechanism_.loops.emplace_back();
      loop.name = fmt::format("loop{}", i);
      // Pins have the carrier's axes, the world's: they close a linkage that is not tilted.
      loop.type = tilt_ == std::array<double, 3>{} && random_.chance(0.6) ? LoopType::kPlanarPin
                                                                          : LoopType::kRevolute;
      const model::FrameIndex from = frame(i + 2, {length, 0.0, 0.0});
      loop.from = from;
      loop.to = frame(1, {x, y, 0.0});
    }
  }

  void decorate() {
    for (std::size_t j = 0; j < mechanism_.joints.size(); ++j)
      for (std::size_t c = 0; c < mechanism_.joints[j].coordinates.size(); ++c) {
        model::Coordinate& coordinate = mechanism_.joints[j].coordinates[c];
        if (random_.chance(0.3)) coordinate.stiffness = random_.uniform(0, 20);
        if (random_.chance(0.3)) coordinate.rest = random_.uniform(-1, 1);
        if (random_.chance(0.3)) coordinate.damping = random_.uniform(0, 2);
        if (coordinate.motion || !random_.chance(0.3)) continue;
        model::Actuator& actuator = mechanism_.actuators.emplace_back();
        actuator.name = "u_" + coordinate.name;
        actuator.joint = model::JointIndex(j);
        actuator.coordinate = c;
        if (random_.chance(0.3)) actuator.rotor_inertia = random_.uniform(0.01, 0.2);
      }
    if (random_.chance(0.4)) add_spring();
    if (random_.chance(0.2)) add_parameter();
  }

  void add_spring() {
    model::Spring spring;
    spring.name = "spring";
    for (model::FrameIndex* end : {&spring.from, &spring.to}) {
      model::Frame& frame = mechanism_.frames.emplace_back();
      frame.name = fmt::format("frame{}", mechanism_.frames.size() - 1);
      if (end == &spring.to) frame.body = model::BodyIndex(random_.below(mechanism_.bodies.size()));
      for (Expression& x : frame.placement.position) x = random_.uniform(-0.5, 0.5);
      *end = model::FrameIndex(mechanism_.frames.size() - 1);
    }
    spring.stiffness = random_.uniform(1, 30);
    spring.damping = random_.uniform(0, 3);
    spring.free_length = random_.uniform(0, 1);
    mechanism_.springs.push_back(spring);
  }

  void add_parameter() {
    model::Parameter parameter;
    parameter.name = "load";
    parameter.value = random_.uniform(0.5, 2);
    mechanism_.parameters.push_back(parameter);
    model::Body& body = mechanism_.bodies[random_.below(mechanism_.bodies.size())];
    if (body.inertia_point != model::InertiaPoint::kCenterOfMass) return;
    body.mass = body.mass * Expression::parameter(model::ParameterIndex(0));
  }

  std::uint64_t seed_;
  LoopClass kind_;
  std::size_t loops_;
  Random& random_;
  std::array<double, 3> tilt_{};
  std::vector<model::Body> bodies_;
  std::vector<LoopType> types_;
  model::Mechanism mechanism_;
};

/// Whether each coordinate that loops hold takes part in some motion.
bool moves_throughout(const reference::MatrixX<long double>& G, const LoopFreedom& freedom) {
  for (Eigen::Index k = 0; k < G.cols(); ++k)
    if (G.col(k).norm() > kHolds && freedom.motions.row(k).norm() < kMoves) return false;
  return freedom.motions.cols() > 0;
}

bool is_good(const model::Mechanism& mechanism, LoopClass kind, std::uint64_t seed) {
  const reference::DescriptorReference<long double> form(mechanism);
  LoopState start = reference::Reference<long double>(mechanism).initial_state();
  const auto constraints = form.loop_constraints(0, start.y, start.z);
  const LoopFreedom freedom = loop_freedom(constraints);
  const bool redundant = freedom.rank < freedom.rows;
  if (freedom.weakest < kWeakestConstraint || !moves_throughout(constraints.G, freedom)) return false;
  if (redundant != (kind == LoopClass::kOverconstrained || kind == LoopClass::kParallelogram) &&
      kind != LoopClass::kSpatial)
    return false;
  if (!reference::massless_joints(mechanism).empty()) return false;
  const reference::Reference<long double> tree(mechanism);
  const auto states = consistent_states(mechanism, seed, kLoopStates);
  if (!states) return false;
  for (const LoopState& state : *states) {
    const LoopFreedom there = loop_freedom(form.loop_constraints(state.t, state.y, state.z));
    const auto terms =
        tree.evaluate(state, reference::VectorX<long double>::Zero(Eigen::Index(tree.input_count())));
    if (there.rank != freedom.rank || there.weakest < kWeakestConstraint / 3) return false;
    if (reference::condition(terms.M) > kLargestCondition) return false;
  }
  return true;
}

}  // namespace

LoopClass loop_class(std::uint64_t seed) {
  switch (seed % 8) {
    case 0:
    case 1:
      return LoopClass::kPlanar;
    case 2:
      return LoopClass::kOverconstrained;
    case 3:
      return LoopClass::kParallelogram;
    default:
      return LoopClass::kSpatial;
  }
}

model::Mechanism random_loops(std::uint64_t seed) {
  Random random(seed * 37 + 11);
  for (int i = 0; i < kMaximumDraws; ++i) {
    model::Mechanism mechanism = LoopDraw(seed, random).run();
    mechanism.name = fmt::format("random_loops_{}", seed);
    if (is_good(mechanism, loop_class(seed), seed)) return mechanism;
  }
  throw support::InternalError(fmt::format("no regular loops in {} draws of seed {}", kMaximumDraws, seed));
}

}  // namespace jourdain::tests
