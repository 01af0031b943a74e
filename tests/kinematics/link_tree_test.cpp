#include "kinematics/link_tree.hpp"

#include <gtest/gtest.h>

#include "agreement/shared_data.hpp"
#include "dynamics/high_precision.hpp"
#include "extremes/extreme_chains.hpp"
#include "extremes/extreme_scenes.hpp"
#include "kinematics/far_joints.hpp"
#include "kinematics/numbers.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::kinematics {
namespace {

LinkTree tree_of(const model::Mechanism& mechanism, Statements& statements,
                 const LinkTreeOptions& options = {}) {
  std::vector<Ex> parameters;
  for (std::size_t i = 0; i < mechanism.parameters.size(); ++i)
    parameters.push_back(statements.leaf(LeafKind::kParameter, i, mechanism.parameters[i].name));
  return build_link_tree(mechanism, parameters, statements, options);
}

TEST(LinkTree, HasOneLinkPerMovingJointParentsFirst) {
  Statements statements;
  const LinkTree tree = tree_of(tests::read_model(tests::model_path("panda.toml")), statements);
  ASSERT_EQ(tree.links.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(tree.links[i].parent, i == 0 ? kGround : i - 1);
}

TEST(LinkTree, FramesOfAlignedRobotsArePermutations) {
  for (const char* model : {"panda.toml", "ur5.toml", "puma560.toml"}) {
    Statements statements;
    for (const Link& link : tree_of(tests::read_model(tests::model_path(model)), statements).links)
      for (const Vector3& row : link.R_PL.rows)
        for (const Ex& entry : row.entries) EXPECT_TRUE(is_trivial(entry)) << model << " " << link.name;
  }
}

TEST(LinkTree, FindsTheParallelAxesOfTheUr5) {
  Statements statements;
  const LinkTree tree = tree_of(tests::read_model(tests::model_path("ur5.toml")), statements);
  std::vector<bool> parallel;
  for (const Link& link : tree.links) parallel.push_back(link.parallel);
  EXPECT_EQ(parallel, (std::vector<bool>{false, false, true, true, false, false}));
}

TEST(LinkTree, AJointsOwnAxesStayParallelWhereItsOrientationIsAParameter) {
  Statements statements;
  const LinkTree tree = tree_of(tests::read_scene(R"toml([model]
name = "tilted"
[parameters]
a = 0.5
[[body]]
name = "b"
mass = 1
center_of_mass = [1, 0, 0]
[[joint]]
name = "j"
type = "cylindrical"
parent = "world"
child = "b"
rpy = ["a", "2*a", 0]
)toml"),
                                statements);
  ASSERT_EQ(tree.links.size(), 2u);
  EXPECT_TRUE(tree.links[1].parallel);
  for (const Vector3& row : tree.bodies[0].R_LB.rows)
    for (const Ex& entry : row.entries) EXPECT_TRUE(is_trivial(entry));
}

TEST(LinkTree, JointsMuchFurtherAwayThanTheirBodiesAreLargeKeepTheirOrigin) {
  for (const double distance : {10.0, 200.0}) {
    const model::Mechanism mechanism = tests::read_scene(tests::distant_arm(distance));
    const bool far = 1.5 * distance > kFarAway * 2.9;
    // What the first joint moves reaches 2.9 m, and it is at 1.5 times the distance: [d, d/2, −d].
    EXPECT_EQ(far_joints(mechanism), (std::vector<bool>{far, false, false}));
    Statements statements;
    EXPECT_EQ(tree_of(mechanism, statements).links[0].along.is_zero(), far);
  }
}

TEST(LinkTree, FramesAreOrthonormalOnRandomTrees) {
  for (std::uint64_t seed = 5; seed < 60; seed += 5) {
    Statements statements;
    const model::Mechanism mechanism = tests::random_tree(seed);
    const LinkTree tree = tree_of(mechanism, statements);
    const dynamics::HighPrecision exact(
        statements, [&](LeafKind, std::size_t i) { return mechanism.parameters[i].value; });
    for (const Link& link : tree.links) {
      const Matrix3 I = link.R_PL * transpose(link.R_PL);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          EXPECT_NEAR(dynamics::to_double(exact.value(I[i][j])), i == j ? 1 : 0, 1e-17) << seed;
    }
  }
}

TEST(LinkTree, RegroupingLeavesNoMassAboveARevoluteJoint) {
  Statements statements;
  for (const Link& link : tree_of(tests::read_model(tests::model_path("panda.toml")), statements).links) {
    EXPECT_TRUE(link.moments.mass.is_zero());
    EXPECT_TRUE(link.moments.first[2].is_zero());
    EXPECT_TRUE(link.moments.second[2][2].is_zero());
  }
}

TEST(MassMoments, OfAMovedPointMassAreThoseOfAPoint) {
  Statements statements;
  const MassMoments point{2, zero_vector(), zero_matrix()};
  const MassMoments there = moved(point, identity_matrix(), {1, -2, 3}, statements);
  EXPECT_TRUE(there.first[1].is_equal(-4));
  EXPECT_TRUE(there.second[0][2].is_equal(6));
  EXPECT_TRUE(there.second[1][1].is_equal(8));
  const MassMoments back = moved(there, identity_matrix(), {-1, 2, -3}, statements);
  EXPECT_TRUE(back.first[0].is_zero() && back.second[2][2].is_zero() && back.second[0][1].is_zero());
}

// Composite of two equal points at ±x of the frame, which is turned by a quarter about z and moved by (0, 0, 3).
TEST(MassMoments, TurnAndMoveWithTheirFrame) {
  Statements statements;
  const MassMoments pair{4, zero_vector(), {{{8, 0, 0}, {0, 0, 0}, {0, 0, 0}}}};
  const Matrix3 quarter{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const MassMoments there = moved(pair, quarter, {0, 0, 3}, statements);
  EXPECT_TRUE(there.mass.is_equal(4));
  EXPECT_TRUE(there.first[2].is_equal(12));
  EXPECT_TRUE(there.second[0][0].is_zero());
  EXPECT_TRUE(there.second[1][1].is_equal(8));
  EXPECT_TRUE(there.second[2][2].is_equal(36));
  EXPECT_TRUE(there.second[1][2].is_zero());
}

// S = ∫x xᵀ dm: S_xx = (I_yy + I_zz − I_xx)/2 and S_xy = −I_xy, the tensor's entry being I_xy = −∫x y dm.
TEST(MassMoments, FollowFromTheInertiaTensor) {
  Statements statements;
  const LinkTree tree = tree_of(tests::read_scene(R"toml([model]
name = "stone"
[[body]]
name = "b"
mass = 2
center_of_mass = [1, -2, 0]
inertia = { xx = 3, yy = 4, zz = 5, xy = 0.25, yz = -0.5 }
[[joint]]
name = "j"
type = "free"
parent = "world"
child = "b"
[[body]]
name = "d"
mass = 1
[[joint]]
name = "k"
type = "revolute"
parent = "b"
child = "d"
)toml"),
                                statements);
  const MassMoments& moments = tree.body_moments[0];
  EXPECT_TRUE(moments.second[0][0].is_equal(3 + 2));
  EXPECT_TRUE(moments.second[1][1].is_equal(2 + 8));
  EXPECT_TRUE(moments.second[2][2].is_equal(1));
  EXPECT_TRUE(moments.second[0][1].is_equal(GiNaC::numeric(-1, 4) - 4));
  EXPECT_TRUE(moments.second[1][2].is_equal(GiNaC::numeric(1, 2)));
}

}  // namespace
}  // namespace jourdain::kinematics
