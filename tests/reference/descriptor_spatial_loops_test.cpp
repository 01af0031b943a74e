// A free body that hangs on a loop joint moves as one that the same joint carries in the tree: every type of loop joint
// against the tree's equations, in which the joint's constraints do not occur.
#include <gtest/gtest.h>

#include <cmath>

#include "linkage.hpp"
#include "properties/random.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = Eigen::VectorX<Long>;
using Vector3L = Vector3<Long>;
using model::Expression;
using model::JointType;
using model::LoopType;
using tests::Linkage;
using Op = Expression::Op;

constexpr Long kRounding = 1e-14L;  // long double, condition numbers up to 1e4
constexpr std::uint64_t kStates = 20;
constexpr double kLength = 0.7;

/// 0.7 + 0.1 sin(2 t) m
Expression changing_length() {
  const Expression phase = Expression::binary(Op::kMultiply, 2.0, Expression::variable({}));
  return Expression::binary(Op::kAdd, kLength,
                            Expression::binary(Op::kMultiply, 0.1, Expression::unary(Op::kSin, phase)));
}

/// How a tree does what a loop joint does: joints one after the other, massless bodies between them.
struct Equivalent {
  LoopType loop;
  struct Link {
    JointType type;
    std::array<double, 3> axis, second_axis;
    model::Vector3 origin;
    std::optional<Expression> motion;
  };
  std::vector<Link> links;
  std::array<double, 3> axis{0, 0, 1}, to_axis{0, 0, 1};
  Expression length = {};
};

const std::array<double, 3> kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1}, kSkew{2, -1, 2}, kAcross{1, 4, 1};

/// For each type of loop joint between two frames the joints of a tree; skew axes where a type has one.
std::vector<Equivalent> equivalents() {
  const std::array<double, 3> n{2.0 / 3, -1.0 / 3, 2.0 / 3};
  const auto slides = model::plane_axes(n);
  const Equivalent::Link ball{JointType::kSpherical, kZ, kX, {}, {}};
  const Equivalent::Link tip{JointType::kSpherical, kZ, kX, {kLength, 0.0, 0.0}, {}};
  const Equivalent::Link cross{JointType::kUniversal, kZ, kY, {}, {}};
  const Equivalent::Link stretch{JointType::kPrismatic, kX, kX, {}, changing_length()};
  const auto single = [](JointType type) { return Equivalent::Link{type, kSkew, kAcross, {}, {}}; };
  const auto slide = [](const std::array<double, 3>& axis) {
    return Equivalent::Link{JointType::kPrismatic, axis, kX, {}, {}};
  };
  return {
      {LoopType::kBall, {ball}},
      {LoopType::kRevolute, {single(JointType::kRevolute)}, kSkew, kSkew},
      {LoopType::kUniversal, {single(JointType::kUniversal)}, kSkew, kAcross},
      {LoopType::kPrismatic, {single(JointType::kPrismatic)}, kSkew, kSkew},
      {LoopType::kCylindrical, {single(JointType::kCylindrical)}, kSkew, kSkew},
      {LoopType::kPointInPlane, {slide(slides[0]), slide(slides[1]), ball}, kSkew},
      {LoopType::kPointOnLine, {slide(kSkew), ball}, kSkew},
      {LoopType::kRod, {cross, tip}, kZ, kZ, kLength},
      {LoopType::kRod, {cross, stretch, ball}, kZ, kZ, changing_length()},
  };
}

/// A pendulum that carries the joint; the body that hangs on it is the second one.
Linkage pendulum() {
  Linkage linkage;
  linkage.mechanism.gravity = {1.0, -2.0, -9.0};
  linkage.add_body(2.0, {0.1, 0.2, -0.3}, {0.5, 0.6, 0.7});
  linkage.add_body(1.3, {0.2, -0.1, 0.15}, {0.3, 0.2, 0.4});
  linkage.add_joint(JointType::kRevolute, {}, 0, {0.1, 0.0, 0.2}, {1, 2, 3});
  return linkage;
}
const model::Vector3 kPlace = {0.3, -0.2, 0.4}, kTurned = {0.5, -0.7, 1.1};

Linkage as_tree(const Equivalent& joint) {
  Linkage linkage = pendulum();
  std::size_t parent = 0;
  for (std::size_t i = 0; i < joint.links.size(); ++i) {
    const Equivalent::Link& link = joint.links[i];
    const bool last = i + 1 == joint.links.size();
    const std::size_t child = last ? 1 : linkage.add_body(0.0, {}, {});
    model::Joint& added = linkage.add_joint(link.type, parent, child, link.origin, link.axis);
    if (i == 0) added.placement = {kPlace, {.rpy = kTurned}};
    added.second_axis = link.second_axis;
    if (link.motion) added.coordinates[0].motion = link.motion;
    parent = child;
  }
  return linkage;
}

Linkage as_loop(const Equivalent& joint) {
  Linkage linkage = pendulum();
  linkage.add_joint(JointType::kFree, {}, 1);
  const model::FrameIndex from = linkage.add_frame(0, kPlace, kTurned);
  model::Loop& loop = linkage.add_loop(joint.loop, from, linkage.add_frame(1));
  loop.axis = joint.axis;
  loop.to_axis = joint.to_axis;
  loop.length = joint.length;
  return linkage;
}

/// State of the looped mechanism in which its bodies move as those of the tree.
struct FreeState {
  FreeState(const AbsoluteBody<Long>& body, const model::Body& given, Long angle, Long rate) {
    const auto& c = given.center_of_mass;
    const Vector3L p_BC(c[0].constant(), c[1].constant(), c[2].constant());
    const Vector3L origin = body.p_WC - body.orientation * p_BC;
    const Vector3L velocity = body.v_C - body.orientation * body.omega.cross(p_BC);
    const Eigen::Quaternion<Long>& q = body.orientation;
    y.resize(8);
    z.resize(7);
    y[0] = angle;
    z[0] = rate;
    y.segment<7>(1) << origin, q.w(), q.x(), q.y(), q.z();
    z.segment<6>(1) << velocity, body.omega;
  }
  VectorL y, z;
};

struct Pair {
  Pair(const Equivalent& joint, std::uint64_t seed)
      : tree(as_tree(joint).mechanism), looped(as_loop(joint).mechanism) {
    const DescriptorReference<Long> carried(tree), closed(looped);
    tests::Random random(seed);
    t = random.uniform(0, 3);
    VectorL y(Eigen::Index(carried.layout().position_count())),
        z(Eigen::Index(carried.layout().velocity_count()));
    for (Long& value : y) value = random.uniform(-0.8, 0.8);
    for (Long& value : z) value = random.uniform(-2, 2);
    for (const std::size_t q : carried.layout().quaternions) y.segment<4>(Eigen::Index(q)).normalize();
    const auto bodies = carried.absolute_state(t, y, z);
    state.emplace(bodies[1], tree.bodies[1], y[0], z[0]);
    of_tree = carried.solve(t, y, z, {});
    of_loop = closed.solve(t, state->y, state->z, {});
  }
  model::Mechanism tree, looped;
  Long t = 0;
  std::optional<FreeState> state;
  DescriptorSolution<Long> of_tree, of_loop;
};

TEST(SpatialLoops, AreRegularAndConsistentWhereATreesJointHolds) {
  for (const Equivalent& joint : equivalents())
    for (std::uint64_t seed = 0; seed < kStates; ++seed) {
      const Pair pair(joint, seed);
      EXPECT_LE(pair.of_loop.loops.g.norm(), kRounding) << int(joint.loop) << " state " << seed;
      EXPECT_LE(pair.of_loop.loops.rate.norm(), kRounding) << int(joint.loop) << " state " << seed;
      EXPECT_EQ(pair.of_loop.loop_rank, Eigen::Index(model::row_count(joint.loop)));
      EXPECT_EQ(pair.of_loop.rank, pair.of_loop.size);
    }
}

TEST(SpatialLoops, AccelerateBodiesAsATreesJointsDo) {
  for (const Equivalent& joint : equivalents())
    for (std::uint64_t seed = 0; seed < kStates; ++seed) {
      const Pair pair(joint, seed);
      for (std::size_t b = 0; b < 2; ++b) {
        const auto &one = pair.of_tree.bodies[b], &other = pair.of_loop.bodies[b];
        EXPECT_LE((one.a_C - other.a_C).norm(), kRounding * (1 + one.a_C.norm()))
            << int(joint.loop) << " state " << seed;
        EXPECT_LE((one.omega_dot - other.omega_dot).norm(), kRounding * (1 + one.omega_dot.norm()))
            << int(joint.loop) << " state " << seed;
      }
    }
}

// The free body's velocities are v of its origin (inertial) and ω: −Gᵀλ is what the tree's joint transmits to it.
TEST(SpatialLoops, TransmitWhatATreesJointTransmits) {
  for (const Equivalent& joint : equivalents())
    for (std::uint64_t seed = 0; seed < kStates; ++seed) {
      const Pair pair(joint, seed);
      const JointWrench<Long>& wrench = pair.of_tree.reactions[joint.links.size()];
      const auto& y = pair.state->y;
      const Eigen::Quaternion<Long> R_WB(y[4], y[5], y[6], y[7]);
      Eigen::Vector<Long, 6> expected;
      expected << -(R_WB * wrench.force), -wrench.moment;
      const VectorL forces = pair.of_loop.loops.G.transpose() * pair.of_loop.loop_lambda;
      EXPECT_LE((forces.tail<6>() - expected).norm(), kRounding * (1 + expected.norm()))
          << int(joint.loop) << " state " << seed;
      EXPECT_LE((forces - pair.of_loop.loop_forces).norm(), kRounding * (1 + expected.norm()))
          << int(joint.loop) << " state " << seed;
    }
}

TEST(SpatialLoops, ProjectionBringsBodiesBackToTheLoops) {
  for (const Equivalent& joint : equivalents()) {
    const Pair pair(joint, 3);
    const DescriptorReference<Long> form(pair.looped);
    AbsoluteState<Long> state = form.absolute(pair.t, pair.state->y, pair.state->z);
    const VectorL u;
    const AbsoluteRates<Long> there = form.rates(state, u);
    for (std::size_t b = 0; b < 2; ++b)
      EXPECT_LE((there.xdot.segment<3>(6 * Eigen::Index(b)) - pair.of_loop.bodies[b].a_C).norm(), 1e-13L);
    state.bodies[1].p_WC += Vector3L(1e-4L, -2e-4L, 3e-4L);
    state.bodies[1].omega += Vector3L(1e-2L, 2e-2L, -3e-2L);
    EXPECT_GE(form.rates(state, u).g.norm(), 1e-5L) << int(joint.loop);
    const AbsoluteRates<Long> back = form.rates(form.projected(state), u);
    EXPECT_LE(back.g.norm(), 1e-13L) << int(joint.loop);
    EXPECT_LE(back.g_rate.norm(), 1e-15L) << int(joint.loop);
  }
}

TEST(SpatialLoops, ProjectionMeetsRedundantRows) {
  const Linkage hinge = tests::four_bar({}, LoopType::kRevolute);
  const DescriptorReference<Long> form(hinge.mechanism);
  VectorL y(3);
  y << 0.7L, 0.2L, 1.5L;  // not assembled: half a step from it
  AbsoluteState<Long> state = form.absolute(0, y, VectorL::Ones(3));
  const VectorL u = VectorL::Zero(1);
  EXPECT_GE(form.rates(state, u).g.norm(), 1e-2L);
  for (int i = 0; i < 3; ++i) state = form.projected(state);
  const AbsoluteRates<Long> there = form.rates(state, u);
  EXPECT_LE(there.g.norm(), kRounding);
  EXPECT_LE(there.g_rate.norm(), kRounding);
}

}  // namespace
}  // namespace jourdain::reference
