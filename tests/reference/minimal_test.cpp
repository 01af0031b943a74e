#include "reference/minimal.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "properties/random_tree.hpp"
#include "reference/massless.hpp"
#include "support/check.hpp"

namespace jourdain::reference {
namespace {

using model::JointType;
using Long = long double;

constexpr double kGravity = 9.81;
constexpr double kRounding = 1e-14;         // a handful of operations in double on numbers of order 1
constexpr std::uint64_t kRandomTrees = 60;  // six of each class, 30 general ones

/// A planar chain in the x-y plane, gravity along −y: `joint i` about z leads from the end of body i−1 to
/// body i. Bodies are point masses at `lengths[i]` along −y.
model::Mechanism point_mass_chain(const std::vector<double>& masses, const std::vector<double>& lengths) {
  model::Mechanism mechanism;
  mechanism.gravity = {0.0, -kGravity, 0.0};
  for (std::size_t i = 0; i < masses.size(); ++i) {
    model::Body body;
    body.mass = masses[i];
    body.center_of_mass = {0.0, -lengths[i], 0.0};
    mechanism.bodies.push_back(body);
    model::Joint joint;
    joint.set_type(JointType::kRevolute);
    joint.child = model::BodyIndex(i);
    if (i > 0) {
      joint.parent = model::BodyIndex(i - 1);
      joint.placement.position = {0.0, -lengths[i - 1], 0.0};
    }
    mechanism.joints.push_back(joint);
  }
  return mechanism;
}

template <class Scalar = double>
State<Scalar> state_of(std::initializer_list<Scalar> y, std::initializer_list<Scalar> z) {
  const auto vector = [](std::initializer_list<Scalar> values) {
    return VectorX<Scalar>(Eigen::Map<const VectorX<Scalar>>(values.begin(), Eigen::Index(values.size())));
  };
  return {.t = 0, .y = vector(y), .z = vector(z)};
}

Terms<Long> terms_at(const Reference<Long>& reference, const VectorX<Long>& y, const VectorX<Long>& z,
                     const VectorX<Long>& u) {
  return reference.evaluate({.t = 0, .y = y, .z = z}, u);
}

/// Derivative of `f` at 0 by central differences of order 6, step 1e-3: good to about 1e-15 in long double.
template <class F>
auto derivative(F f) {
  const Long h = 1e-3L;
  using Value = decltype(f(h));
  return Value((Value(f(h) - f(-h)) * 45 - Value(f(2 * h) - f(-2 * h)) * 9 + Value(f(3 * h) - f(-3 * h))) /
               (60 * h));
}

/// A random tree's reference, state and inputs in long double.
struct RandomCase {
  explicit RandomCase(std::uint64_t seed)
      : mechanism(tests::random_tree(seed)),
        reference(mechanism),
        y(tests::random_state(mechanism, seed).y.cast<Long>()),
        z(tests::random_state(mechanism, seed).z.cast<Long>()),
        u(tests::random_inputs(mechanism, seed).cast<Long>()),
        terms(terms_at(reference, y, z, u)) {}

  model::Mechanism mechanism;
  Reference<Long> reference;
  VectorX<Long> y, z, u;
  Terms<Long> terms;
};

/// Largest |difference| over scale, entry by entry; NaN where one is.
Long relative_error(const MatrixX<Long>& a, const MatrixX<Long>& b, const MatrixX<Long>& scale) {
  Long worst = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const Long difference = std::abs(a.data()[i] - b.data()[i]);
    if (difference == 0) continue;
    const Long ratio = difference / scale.data()[i];
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

TEST(MinimalReference, GivesThePendulumEquation) {
  const double m = 2, l = 0.7, angle = 0.4, rate = 1.3;
  const Reference<double> reference(point_mass_chain({m}, {l}));
  const Terms<double> terms = reference.evaluate(state_of({angle}, {rate}), VectorX<double>());
  EXPECT_NEAR(terms.M(0, 0), m * l * l, kRounding);
  EXPECT_NEAR(terms.k_bar[0], 0, kRounding);
  EXPECT_NEAR(terms.q_bar[0], m * kGravity * l * std::sin(angle), kRounding * 20);
  EXPECT_NEAR(terms.kinetic_energy, m * l * l * rate * rate / 2, kRounding);
  EXPECT_NEAR(terms.potential_energy, -m * kGravity * l * std::cos(angle), kRounding * 20);
  EXPECT_NEAR(forward_dynamics(terms)[0], -kGravity / l * std::sin(angle), kRounding * 20);
}

// Textbook equations in absolute angles a, b turn into relative ones by a = y1, b = y1 + y2.
TEST(MinimalReference, GivesTheDoublePendulumMassMatrixAndCoriolisTerms) {
  const double m1 = 1.5, m2 = 0.8, l1 = 0.9, l2 = 1.2, y2 = 0.6, z1 = 1.1, z2 = -2.3;
  const Reference<double> reference(point_mass_chain({m1, m2}, {l1, l2}));
  const Terms<double> terms = reference.evaluate(state_of({0.3, y2}, {z1, z2}), VectorX<double>());
  const double c = m2 * l1 * l2 * std::cos(y2), s = m2 * l1 * l2 * std::sin(y2), lower = m2 * l2 * l2;
  EXPECT_NEAR(terms.M(0, 0), (m1 + m2) * l1 * l1 + lower + 2 * c, kRounding);
  EXPECT_NEAR(terms.M(0, 1), lower + c, kRounding);
  EXPECT_NEAR(terms.M(1, 0), lower + c, kRounding);
  EXPECT_NEAR(terms.M(1, 1), lower, kRounding);
  EXPECT_NEAR(terms.k_bar[0], s * (2 * z1 * z2 + z2 * z2), kRounding * 10);
  EXPECT_NEAR(terms.k_bar[1], -s * z1 * z1, kRounding * 10);
  EXPECT_NEAR(terms.q_bar[1], m2 * kGravity * l2 * std::sin(0.3 + y2), kRounding * 20);
}

// Barto, Sutton and Anderson (1983): the pole is a uniform rod of half-length l, tipping towards +x.
TEST(MinimalReference, GivesTheCartPoleAccelerations) {
  const double mc = 1, mp = 0.1, l = 0.5, g = 9.8, angle = 0.2, rate = -0.7, force = 10;
  model::Mechanism mechanism;
  mechanism.gravity = {0.0, 0.0, -g};
  mechanism.bodies.resize(2);
  mechanism.bodies[0].mass = mc;
  mechanism.bodies[1].mass = mp;
  mechanism.bodies[1].center_of_mass = {0.0, 0.0, l};
  mechanism.bodies[1].inertia.xx = mechanism.bodies[1].inertia.yy = mp * l * l / 3;
  mechanism.joints.resize(2);
  mechanism.joints[0].set_type(JointType::kPrismatic);
  mechanism.joints[0].axis = {3, 0, 0};
  mechanism.joints[1].set_type(JointType::kRevolute);
  mechanism.joints[1].axis = {0, 0.5, 0};
  mechanism.joints[1].parent = model::BodyIndex(0);
  mechanism.joints[1].child = model::BodyIndex(1);
  mechanism.actuators.resize(1);
  const VectorX<double> u = VectorX<double>::Constant(1, force);
  const Terms<double> terms = Reference<double>(mechanism).evaluate(state_of({0.4, angle}, {0.9, rate}), u);

  const double push = (force + mp * l * rate * rate * std::sin(angle)) / (mc + mp);
  const double angular = (g * std::sin(angle) - std::cos(angle) * push) /
                         (l * (4.0 / 3 - mp * std::cos(angle) * std::cos(angle) / (mc + mp)));
  const VectorX<double> zdot = forward_dynamics(terms);
  EXPECT_NEAR(zdot[1], angular, kRounding * 100);
  EXPECT_NEAR(zdot[0], push - mp * l * angular * std::cos(angle) / (mc + mp), kRounding * 100);
  EXPECT_LT(backward_error(terms, zdot), 1e-15);
}

TEST(MinimalReference, HoldsSpringsDampersAndInputsWithTheSignsOfTheDesign) {
  model::Mechanism mechanism = point_mass_chain({1}, {1});
  mechanism.gravity = {};
  mechanism.joints[0].coordinates[0].stiffness = 10.0;
  mechanism.joints[0].coordinates[0].rest = 0.5;
  mechanism.joints[0].coordinates[0].damping = 3.0;
  mechanism.actuators.resize(1);
  const VectorX<double> u = VectorX<double>::Constant(1, 7);
  const Terms<double> terms = Reference<double>(mechanism).evaluate(state_of({0.7}, {2.0}), u);
  EXPECT_NEAR(terms.q_bar[0], 10 * 0.2 + 3 * 2 - 7, kRounding);
  EXPECT_NEAR(terms.potential_energy, 10 * 0.2 * 0.2 / 2, kRounding);
  EXPECT_EQ(terms.k_bar[0], 0);
}

// About an axis at 45° in the x-y plane, with principal axes x', y' at 30°: only 15° lie between axis and x'.
TEST(MinimalReference, TurnsInertiaFromItsAxesIntoTheBodyFrame) {
  model::Mechanism mechanism = point_mass_chain({1}, {0});
  mechanism.bodies[0].inertia.xx = 1.0;
  mechanism.bodies[0].inertia.yy = 2.0;
  mechanism.bodies[0].inertia.zz = 2.5;
  mechanism.bodies[0].inertia_axes.rpy = {0.0, 0.0, std::numbers::pi / 6};
  mechanism.joints[0].axis = {1, 1, 0};
  const Terms<double> terms =
      Reference<double>(mechanism).evaluate(state_of({0.3}, {0.0}), VectorX<double>());
  const double c = std::cos(std::numbers::pi / 12), s = std::sin(std::numbers::pi / 12);
  EXPECT_NEAR(terms.M(0, 0), c * c + 2 * s * s, kRounding);
}

// A body at 1 m whose inertia about its frame's origin is 3 kg m² has 3, not 4, about an axis through the
// origin.
TEST(MinimalReference, TakesInertiaAboutTheOriginAsSuch) {
  model::Mechanism mechanism = point_mass_chain({1}, {1});
  mechanism.bodies[0].inertia.zz = 3.0;
  const auto moment = [&] {
    return Reference<double>(mechanism).evaluate(state_of({0.3}, {0.0}), VectorX<double>()).M(0, 0);
  };
  EXPECT_NEAR(moment(), 4, kRounding);
  mechanism.bodies[0].inertia_point = model::InertiaPoint::kOrigin;
  EXPECT_NEAR(moment(), 3, kRounding);
}

TEST(MinimalReference, IsSymmetricPositiveDefinite) {
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    EXPECT_LE(relative_error(random.terms.M, random.terms.M.transpose(), random.terms.M_scale), 1e-18L)
        << seed;
    EXPECT_EQ(random.terms.M.llt().info(), Eigen::Success) << seed;
  }
}

TEST(MinimalReference, KineticEnergyIsHalfTheQuadraticFormOfM) {
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    const Long form = random.z.dot(random.terms.M * random.z) / 2;
    EXPECT_NEAR(double(random.terms.kinetic_energy / form), 1, 1e-14) << seed;
  }
}

// k̄ = −(Ṁ z − ½ ∂(zᵀ M z)/∂y): the Christoffel symbols of M, by numerical differentiation.
TEST(MinimalReference, CoriolisTermsFollowFromTheMassMatrix) {
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    const auto M_at = [&](const VectorX<Long>& y) {
      return terms_at(random.reference, y, random.z, random.u).M;
    };
    const MatrixX<Long> Mdot = derivative([&](Long s) { return M_at(random.y + s * random.z); });
    VectorX<Long> expected = -Mdot * random.z;
    for (Eigen::Index i = 0; i < random.y.size(); ++i) {
      const VectorX<Long> direction = VectorX<Long>::Unit(random.y.size(), i);
      expected[i] += derivative(
          [&](Long s) { return Long(random.z.dot(M_at(random.y + s * direction) * random.z) / 2); });
    }
    EXPECT_LE(relative_error(random.terms.k_bar, expected,
                             VectorX<Long>::Constant(random.y.size(), random.terms.k_scale.maxCoeff())),
              1e-12L)
        << seed;
  }
}

// Without damping and inputs q̄ = ∂V/∂y.
TEST(MinimalReference, ConservativeForcesAreTheGradientOfThePotential) {
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    const VectorX<Long> still = VectorX<Long>::Zero(random.z.size()),
                        no_input = VectorX<Long>::Zero(random.u.size());
    const Terms<Long> terms = terms_at(random.reference, random.y, still, no_input);
    for (Eigen::Index i = 0; i < random.y.size(); ++i) {
      const VectorX<Long> direction = VectorX<Long>::Unit(random.y.size(), i);
      const Long slope = derivative([&](Long s) {
        return terms_at(random.reference, random.y + s * direction, still, no_input).potential_energy;
      });
      EXPECT_NEAR(double(terms.q_bar[i]), double(slope), 1e-12 * double(terms.q_scale.maxCoeff())) << seed;
    }
  }
}

// d/dt (T + V) = zᵀ u − zᵀ D z along the motion that forward dynamics predicts.
TEST(MinimalReference, EnergyChangesByThePowerOfInputsAndDampers) {
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    const VectorX<Long> zdot = forward_dynamics(random.terms);
    const auto energy = [&](Long s) {
      const Terms<Long> terms =
          terms_at(random.reference, random.y + s * random.z, random.z + s * zdot, random.u);
      return Long(terms.kinetic_energy + terms.potential_energy);
    };
    const std::vector<model::JointIndex> joints = model::moving_joints(random.mechanism);
    std::vector<Long> parameters;
    for (const model::Parameter& parameter : random.mechanism.parameters)
      parameters.push_back(parameter.value);
    Long power = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Long rate = random.z[Eigen::Index(i)];
      const model::Expression& damping = random.mechanism.joints[joints[i].value].coordinates[0].damping;
      power -= rate * rate * damping.evaluate<Long>(parameters);
      for (std::size_t a = 0; a < random.mechanism.actuators.size(); ++a)
        if (random.mechanism.actuators[a].joint == joints[i]) power += rate * random.u[Eigen::Index(a)];
    }
    const VectorX<Long> speed = random.z.cwiseAbs();
    const Long scale =
        speed.dot(random.terms.M_scale * zdot.cwiseAbs() + random.terms.k_scale + random.terms.q_scale);
    EXPECT_NEAR(double(derivative(energy)), double(power), 1e-11 * double(scale)) << seed;
  }
}

TEST(MinimalReference, DoubleAgreesWithLongDoubleWithinTheScales) {
  const double tolerance = 1e-14;  // some tens of roundings
  for (std::uint64_t seed = 0; seed < kRandomTrees; ++seed) {
    const RandomCase random(seed);
    const Terms<double> terms =
        Reference<double>(random.mechanism)
            .evaluate({.t = 0, .y = random.y.cast<double>(), .z = random.z.cast<double>()},
                      random.u.cast<double>());
    EXPECT_LE(relative_error(terms.M.cast<Long>(), random.terms.M, random.terms.M_scale), tolerance) << seed;
    EXPECT_LE(relative_error(terms.k_bar.cast<Long>(), random.terms.k_bar, random.terms.k_scale), tolerance)
        << seed;
    EXPECT_LE(relative_error(terms.q_bar.cast<Long>(), random.terms.q_bar, random.terms.q_scale), tolerance)
        << seed;
  }
}

TEST(MinimalReference, SnapsConstantRotationsOnlyWhereTheModelSaysSo) {
  model::Mechanism mechanism = point_mass_chain({1}, {1});
  mechanism.joints[0].placement.rotation.rpy = {1.5707963267948966, 0.0, 0.0};
  const auto entry = [&] {
    return Reference<double>(mechanism).motion(state_of({0.0}, {0.0}))[0].R_WB(1, 1);
  };
  EXPECT_EQ(entry(), 0);
  mechanism.snap = false;
  EXPECT_NEAR(entry(), 6.1e-17, 1e-18);
}

TEST(MinimalReference, RefusesSizesThatDoNotFit) {
  const Reference<double> reference(point_mass_chain({1, 1}, {1, 1}));
  EXPECT_THROW(reference.evaluate(state_of({0.0}, {0.0}), VectorX<double>()), support::InternalError);
  EXPECT_THROW(reference.evaluate(state_of({0.0, 0.0}, {0.0, 0.0}), VectorX<double>::Zero(1)),
               support::InternalError);
  EXPECT_THROW(Reference<double>(point_mass_chain({1}, {1}), std::array{1.0}), support::InternalError);
}

TEST(MasslessJoints, FindsAJointThatMovesNothing) {
  model::Mechanism mechanism = point_mass_chain({1, 0}, {1, 1});
  ASSERT_EQ(massless_joints(mechanism).size(), 1u);
  EXPECT_EQ(massless_joints(mechanism)[0], model::JointIndex(1));
  mechanism.bodies[1].inertia.zz = 1e-6;
  EXPECT_TRUE(massless_joints(mechanism).empty());
}

TEST(MasslessJoints, FindsTheFirstOfTwoCoaxialJointsWithoutMassBetweenThem) {
  const std::vector<model::JointIndex> found = massless_joints(point_mass_chain({0, 1}, {0, 1}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0], model::JointIndex(0));
}

}  // namespace
}  // namespace jourdain::reference
