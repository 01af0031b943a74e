#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"
#include "dynamics/factorisation.hpp"
#include "dynamics/harmonics.hpp"
#include "kinematics/link_tree.hpp"
#include "kinematics/numbers.hpp"
#include "properties/random.hpp"
#include "properties/random_tree.hpp"

namespace jourdain::dynamics {
namespace {

using kinematics::kGround;

/// A symmetric positive definite matrix with zeros between the branches of a tree, and the parents of its rows.
struct BranchedMatrix {
  Eigen::MatrixXd M;
  std::vector<std::size_t> parent;
};

BranchedMatrix random_branched(std::uint64_t seed, std::size_t n) {
  tests::Random random(seed);
  BranchedMatrix result{Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n)), {}};
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n));
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t choice = random.below(i + 1);
    result.parent.push_back(choice == i ? kGround : choice);
    L(Eigen::Index(i), Eigen::Index(i)) = random.uniform(1, 2);
    for (std::size_t j = result.parent[i]; j != kGround; j = result.parent[j])
      L(Eigen::Index(i), Eigen::Index(j)) = random.uniform(-1, 1);
  }
  result.M = L.transpose() * L;
  return result;
}

TEST(Factorisation, SolvesBranchedMatricesLikeEigen) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    constexpr std::size_t n = 7;
    const BranchedMatrix branched = random_branched(seed, n);
    std::vector<std::vector<Ex>> M(n);
    std::vector<Ex> b;
    Eigen::VectorXd right(n);
    for (std::size_t i = 0; i < n; ++i) {
      right[Eigen::Index(i)] = double(i) - 2.5;
      b.push_back(kinematics::exact(right[Eigen::Index(i)]));
      for (std::size_t j = 0; j < n; ++j)
        M[i].push_back(kinematics::exact(branched.M(Eigen::Index(i), Eigen::Index(j))));
    }
    kinematics::Statements statements;
    const std::vector<Ex> x = solve_mass_matrix(M, b, branched.parent, statements);
    const Eigen::VectorXd expected = branched.M.ldlt().solve(right);
    const HighPrecision exact(statements, {});
    for (std::size_t i = 0; i < n; ++i)
      EXPECT_NEAR(to_double(exact.value(x[i])), expected[Eigen::Index(i)], 1e-9) << seed;
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
