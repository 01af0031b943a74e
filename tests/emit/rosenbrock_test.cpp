#include "emit/rosenbrock.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "programs/steppers.hpp"

namespace jourdain::emit {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-13;  // of sums of products of coefficients with 16 digits

/// Coefficients in the usual form, from those of the u-form.
struct Usual {
  MatrixXd alpha, Gamma, beta;
  VectorXd b, nodes, shares;

  explicit Usual(const Rosenbrock& method) {
    const Index s = Index(method.m.size());
    MatrixXd inverse = MatrixXd::Identity(s, s) / method.gamma, A = MatrixXd::Zero(s, s);
    for (Index i = 0; i < s; ++i)
      for (Index j = 0; j < i; ++j) {
        inverse(i, j) = -method.C[std::size_t(i)][std::size_t(j)];
        A(i, j) = method.A[std::size_t(i)][std::size_t(j)];
      }
    Gamma = inverse.inverse();
    alpha = A * Gamma;
    beta = alpha + Gamma;
    b = Gamma.transpose() * Eigen::Map<const VectorXd>(method.m.data(), s);
    nodes = alpha.rowwise().sum();
    shares = Gamma.rowwise().sum();
  }
};

class Conditions : public ::testing::TestWithParam<const char*> {
 protected:
  const Rosenbrock& method = *find_rosenbrock(GetParam());
  const programs::Stepper& stepper = *programs::find_stepper(GetParam());
  Usual u{method};
};

// Hairer, Wanner: Solving Ordinary Differential Equations II, tables IV.7.1 and VI.4.1.
TEST_P(Conditions, OfTheStatedOrderHold) {
  const VectorXd row = u.beta.rowwise().sum();
  const ArrayXd a = u.nodes.array();
  EXPECT_NEAR(u.b.sum(), 1, kRounding);
  if (stepper.order >= 2) {
    EXPECT_NEAR(u.b.dot(row), 0.5, kRounding);
  }
  if (stepper.order >= 3) {
    EXPECT_NEAR(u.b.dot((a * a).matrix()), 1 / 3.0, kRounding);
    EXPECT_NEAR(u.b.dot(u.beta * row), 1 / 6.0, kRounding);
  }
  if (stepper.order >= 4) {
    const VectorXd implied = u.beta.inverse() * (a * a).matrix();
    EXPECT_NEAR(u.b.dot((a * a * a).matrix()), 0.25, kRounding);
    EXPECT_NEAR(u.b.dot((a * (u.alpha * row).array()).matrix()), 1 / 8.0, kRounding);
    EXPECT_NEAR(u.b.dot(u.beta * (a * a).matrix()), 1 / 12.0, kRounding);
    EXPECT_NEAR(u.b.dot(u.beta * u.beta * row), 1 / 24.0, kRounding);
    EXPECT_NEAR(u.b.dot((a * (u.alpha * implied).array()).matrix()), 0.25, kRounding);
  }
}

TEST_P(Conditions, OfTheReducedOrderHoldForAnyDerivatives) {
  const ArrayXd a = u.nodes.array();
  if (stepper.reduced_order >= 2) {
    EXPECT_NEAR(u.b.dot(u.nodes), 0.5, kRounding);
    EXPECT_NEAR(u.b.dot(u.shares), 0, kRounding);
  }
  if (stepper.reduced_order >= 3) {
    EXPECT_NEAR(u.b.dot((a * a).matrix()), 1 / 3.0, kRounding);
    EXPECT_NEAR(u.b.dot(u.alpha * u.nodes), 1 / 6.0, kRounding);
    EXPECT_NEAR(u.b.dot(u.alpha * u.shares), 0, kRounding);
    EXPECT_NEAR(u.b.dot(u.Gamma * u.nodes), 0, kRounding);
    EXPECT_NEAR(u.b.dot(u.Gamma * u.shares), 0, kRounding);
  }
}

TEST_P(Conditions, TimesOfStagesAndSharesAreRowSums) {
  for (Index i = 0; i < u.nodes.size(); ++i) {
    EXPECT_NEAR(method.nodes[std::size_t(i)], u.nodes[i], kRounding);
    EXPECT_NEAR(method.shares[std::size_t(i)], u.shares[i], kRounding);
  }
}

/// Stability function R(x) = 1 + x bᵀ (1 − x β)⁻¹ 1.
double growth(const Usual& u, std::complex<double> x) {
  const Index s = u.b.size();
  const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(s, s);
  const Eigen::VectorXcd k = (one - x * u.beta).partialPivLu().solve(Eigen::VectorXcd::Ones(s));
  return std::abs(1.0 + x * u.b.cast<std::complex<double>>().dot(k));
}

TEST_P(Conditions, OfLStabilityHold) {
  for (double y = 1e-3; y < 1e6; y *= 1.05) EXPECT_LE(growth(u, {0, y}), 1 + 1e-12) << y;
  EXPECT_LE(growth(u, {-1e8, 0}), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Rosenbrock, Conditions,
                         ::testing::Values("linearly_implicit_euler", "ros34pw2", "rosw43", "rodas4"));

}  // namespace
}  // namespace jourdain::emit
