#include <gtest/gtest.h>

#include <set>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"
#include "dynamics/harmonics.hpp"
#include "dynamics/link_forces.hpp"
#include "dynamics/scene.hpp"
#include "properties/random.hpp"
#include "properties/random_scene.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::dynamics {
namespace {

/// Links articulated down to a random depth in each branch, with every link its parent.
std::vector<bool> random_articulation(const model::Mechanism& mechanism, std::uint64_t seed) {
  tests::Random random(seed);
  kinematics::Statements statements;
  const Scene scene(mechanism, {}, statements);
  std::vector<bool> articulated;
  for (const kinematics::Link& link : scene.tree.links)
    articulated.push_back((link.parent == kinematics::kGround || articulated[link.parent]) &&
                          random.chance(0.6));
  return articulated;
}

TEST(Solver, GivesTheSameAccelerationsWhicheverLinksAreArticulated) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const model::Mechanism mechanism = tests::random_tree(seed);
    const tests::Derived plain = tests::derive(mechanism);
    DerivationOptions options;
    options.articulated = random_articulation(mechanism, seed);
    const tests::Sample sample = tests::random_sample(mechanism, seed);
    const tests::Judge judge(plain, sample);
    const tests::Derived mixed = tests::derive(mechanism, options);
    EXPECT_LE(judge.backward_error(tests::interpreted<double>(mixed.module, "forward_dynamics", sample)),
              1e-13)
        << seed;
  }
}

/// k̄ and τ, composite bodies against single links, in units of their term sums. Gives the kinds of links; none where
/// nothing was compared.
std::set<kinematics::LinkKind> expect_forces_by_links(const model::Mechanism& mechanism, std::uint64_t seed) {
  kinematics::Statements statements;
  const Scene scene(mechanism, {}, statements);
  const tests::Derived by_composites = tests::derive(mechanism);
  const bool all_prescribed = !ir::find_program(by_composites.module, "k_bar");
  if (all_prescribed || !has_forces_by_links(scene)) return {};
  DerivationOptions options;
  options.k_bar_by_links = options.tau_by_links = true;
  const tests::Derived by_links = tests::derive(mechanism, options);
  const tests::Sample sample = tests::random_sample(mechanism, seed);
  const tests::Judge judge(by_composites, sample);
  EXPECT_LE(judge.k_bar_error(tests::interpreted<double>(by_links.module, "k_bar", sample)), 1e-13) << seed;
  EXPECT_LE(judge.torque_error(tests::interpreted<double>(by_links.module, "inverse_dynamics", sample)),
            1e-13)
      << seed;
  std::set<kinematics::LinkKind> kinds;
  for (const kinematics::Link& link : scene.tree.links) kinds.insert(link.kind);
  return kinds;
}

TEST(ForcesByLinks, AreThoseOfCompositeBodies) {
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    EXPECT_FALSE(expect_forces_by_links(tests::random_tree(seed), seed).empty()) << seed;
}

TEST(ForcesByLinks, AreThoseOfCompositeBodiesForEveryKindOfJoint) {
  std::set<kinematics::LinkKind> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed)
    if (const model::Mechanism scene = tests::random_scene(seed); scene.loops.empty())
      seen.merge(expect_forces_by_links(scene, seed));
  using Kind = kinematics::LinkKind;
  EXPECT_EQ(seen, (std::set{Kind::kTurn, Kind::kSlide, Kind::kScrew, Kind::kCurve, Kind::kBall}));
}

TEST(ForcesByLinks, TakeFewerOperationsForAGeneralArmAndAPlanarOne) {
  for (const char* name : {"puma560.toml", "chain4.toml"}) {
    const model::Mechanism mechanism = tests::read_model(tests::model_path(name));
    DerivationOptions options;
    options.tau_by_links = true;
    const auto operations = [](const tests::Derived& derived) {
      return ir::count_operations(*ir::find_program(derived.module, "inverse_dynamics")).arithmetic();
    };
    EXPECT_LT(operations(tests::derive(mechanism, options)), 0.88 * operations(tests::derive(mechanism)))
        << name;
  }
}

TEST(Equations, HaveNoCentrifugalTermsAtRest) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const tests::Derived derived = tests::derive(tests::random_tree(seed));
    tests::Sample sample = tests::random_sample(derived.mechanism, seed);
    std::fill(sample.z.begin(), sample.z.end(), 0.0);
    for (double k : tests::interpreted<double>(derived.module, "k_bar", sample)) EXPECT_EQ(k, 0.0);
  }
}

TEST(Equations, LeaveMassMatrixEntriesBetweenBranchesOut) {
  model::Mechanism two = tests::read_model(tests::model_path("double_pendulum.toml"));
  two.joints[1].parent = std::nullopt;
  const Equations equations = derive_equations(two);
  EXPECT_TRUE(equations.M[0][1].is_zero());
}

std::string expanded(const Equations& equations, const Ex& value) {
  return to_text(expand(equations, value), false);
}

TEST(Harmonics, GiveTheTextbookDoublePendulum) {
  const Equations e = derive_equations(tests::read_model(tests::model_path("double_pendulum.toml")));
  EXPECT_EQ(expanded(e, e.M[0][0]), "l1^2*m1 + l1^2*m2 + l2^2*m2 + 2*l1*l2*m2*cos(y1)");
  EXPECT_EQ(expanded(e, e.M[0][1]), "l2^2*m2 + l1*l2*m2*cos(y1)");
  EXPECT_EQ(expanded(e, e.k_bar[0]), "2*l1*l2*m2*z0*z1*sin(y1) + l1*l2*m2*z1^2*sin(y1)");
  EXPECT_EQ(expanded(e, e.k_bar[1]), "-l1*l2*m2*z0^2*sin(y1)");
  EXPECT_EQ(expanded(e, e.q_bar[1]), "9.81*l2*m2*sin(y0 + y1)");
}

TEST(Harmonics, GiveTheTextbookCartPole) {
  const Equations e = derive_equations(tests::read_model(tests::model_path("cart_pole.toml")));
  EXPECT_EQ(expanded(e, e.M[0][0]), "cart_mass + pole_mass");
  EXPECT_EQ(expanded(e, e.M[0][1]), "pole_half_length*pole_mass*cos(y1)");
  EXPECT_EQ(expanded(e, e.k_bar[0]), "pole_half_length*pole_mass*z1^2*sin(y1)");
  EXPECT_EQ(expanded(e, e.q_bar[0]), "-u0");
}

TEST(Harmonics, NamesBecomeLatex) {
  EXPECT_EQ(latex_name("y1"), "y_{1}");
  EXPECT_EQ(latex_name("S3_xx"), "S_{3,xx}");
  EXPECT_EQ(latex_name("mass"), "\\mathrm{mass}");
}

}  // namespace
}  // namespace jourdain::dynamics
