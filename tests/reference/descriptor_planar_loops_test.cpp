// Planar loops of the descriptor form against the loop equations of the textbooks, written in the complex
// plane, and the principle of virtual power.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "linkage.hpp"
#include "reference/descriptor.hpp"

namespace jourdain::reference {
namespace {

using Long = long double;
using VectorL = Eigen::VectorX<Long>;
using MatrixL = Eigen::MatrixX<Long>;
using Complex = std::complex<Long>;
using model::Expression;
using model::JointType;
using model::LoopType;
using tests::FourBar;
using tests::Linkage;

constexpr Long kRounding = 1e-15L;  // long double through a few small systems
constexpr Long kGravity = 9.81;     // the double that the models have

VectorL vector(std::initializer_list<Long> values) {
  return Eigen::Map<const VectorL>(values.begin(), Eigen::Index(values.size()));
}

DescriptorSolution<Long> solve(const Linkage& linkage, const VectorL& y, const VectorL& z, const VectorL& u) {
  return DescriptorReference<Long>(linkage.mechanism).solve(0, y, z, u);
}

/// The bar's motion in the plane: position, velocity and acceleration of a point, angle with its rates.
struct Turning {
  Long angle = 0, rate = 0, acceleration = 0;
  Complex direction() const { return std::polar(Long(1), angle); }
  Complex velocity() const { return Complex(0, rate) * direction(); }
  Complex change() const { return (Complex(0, acceleration) - rate * rate) * direction(); }
};

Long dot(const Complex& a, const Complex& b) { return (std::conj(a) * b).real(); }
/// Component along the direction (cos `angle`, sin `angle`).
Long along(const Complex& a, Long angle) { return dot(std::polar(Long(1), angle), a); }

/// Angles, rates and accelerations of crank, coupler and rocker from the crank's: the loop equation
/// crank e(θ₁) + coupler e(θ₂) = ground + rocker e(θ₃), its derivatives multiplied by e(θ₃) and e(θ₂).
struct FourBarMotion {
  FourBarMotion(const FourBar& bars, const Turning& driver) : bar{driver, {}, {}} {
    const Complex open =
        Complex(bars.ground) - Long(bars.crank) * driver.direction();  // pin to rocker's pivot
    const Long size = std::abs(open), a = bars.coupler, c = bars.rocker;
    bar[1].angle = std::arg(open) + std::acos((a * a + size * size - c * c) / (2 * a * size));
    const Complex pin = Long(bars.crank) * driver.direction() + a * bar[1].direction();
    bar[2].angle = std::arg(pin - Complex(bars.ground));
    const Long sine = std::sin(bar[2].angle - bar[1].angle);
    const Complex v = Long(bars.crank) * driver.velocity();
    bar[1].rate = -along(v, bar[2].angle) / (a * sine);
    bar[2].rate = -along(v, bar[1].angle) / (c * sine);
    const Complex rest = Long(bars.crank) * driver.change() + a * bar[1].change() - c * bar[2].change();
    bar[1].acceleration = -along(rest, bar[2].angle) / (a * sine);
    bar[2].acceleration = -along(rest, bar[1].angle) / (c * sine);
  }
  Turning bar[3];
};

/// Power of all that accelerates the linkage less that of its weight, per unit of the crank's rate.
Long lacking_torque(const FourBar& bars, const FourBarMotion& motion) {
  Complex pins[] = {0, 0, 0}, pin_rates[] = {0, 0, 0};
  pins[1] = Long(bars.crank) * motion.bar[0].change();
  pin_rates[1] = Long(bars.crank) * motion.bar[0].velocity();
  Long power = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Turning& bar = motion.bar[i];
    const Complex a = pins[i] + Long(bars.centers[i]) * bar.change();
    const Complex v = pin_rates[i] + Long(bars.centers[i]) * bar.velocity();
    power += Long(bars.masses[i]) * dot(v, a + Complex(0, kGravity)) +
             Long(bars.moments[i]) * bar.acceleration * bar.rate;
  }
  return power / motion.bar[0].rate;
}

/// The crank's acceleration under a torque; what lacks is linear in it.
Long crank_acceleration(const FourBar& bars, Turning crank, Long torque) {
  crank.acceleration = 0;
  const Long at_zero = lacking_torque(bars, FourBarMotion(bars, crank));
  crank.acceleration = 1;
  return (torque - at_zero) / (lacking_torque(bars, FourBarMotion(bars, crank)) - at_zero);
}

struct FourBarCase {
  FourBar bars;
  Turning crank{0.7, 2.3, 0};
  Long torque = 1.9;
  FourBarMotion motion;
  VectorL y, z, u;

  FourBarCase() : motion(bars, accelerated(bars, crank, torque)) {
    const Turning* bar = motion.bar;
    y = vector({bar[0].angle, bar[1].angle - bar[0].angle, bar[2].angle});
    z = vector({bar[0].rate, bar[1].rate - bar[0].rate, bar[2].rate});
    u = vector({torque});
  }
  static Turning accelerated(const FourBar& bars, Turning crank, Long torque) {
    crank.acceleration = crank_acceleration(bars, crank, torque);
    return crank;
  }
  VectorL zdot() const {
    const Turning* bar = motion.bar;
    return vector({bar[0].acceleration, bar[1].acceleration - bar[0].acceleration, bar[2].acceleration});
  }
};

void expect_equal(const VectorL& actual, const VectorL& expected) {
  EXPECT_LE((actual - expected).norm(), kRounding * (1 + expected.norm()))
      << actual.transpose() << " instead of " << expected.transpose();
}

TEST(PlanarLoops, AFourBarObeysItsLoopEquationsAndVirtualPower) {
  const FourBarCase given;
  const auto solution = solve(four_bar(given.bars, LoopType::kPlanarPin), given.y, given.z, given.u);
  expect_equal(solution.zdot, given.zdot());
  expect_equal(solution.loops.g, vector({0, 0}));
  expect_equal(solution.loops.rate, vector({0, 0}));
  EXPECT_EQ(solution.loop_rank, 2);
  EXPECT_EQ(solution.rank, solution.size);
}

// The rocker alone, about its pivot: the pin pushes its end with −λ times ∂Δ/∂end = −1, weight turns it, too.
TEST(PlanarLoops, TheRockersBalanceGivesTheMultipliers) {
  const FourBarCase given;
  const auto solution = solve(four_bar(given.bars, LoopType::kPlanarPin), given.y, given.z, given.u);
  const Turning& rocker = given.motion.bar[2];
  const Long arm = given.bars.centers[2], moment = given.bars.moments[2], mass = given.bars.masses[2];
  const Complex push(solution.loop_lambda[0], solution.loop_lambda[1]);
  const Long turning = dot(Complex(0, given.bars.rocker) * rocker.direction(), push);
  const Long weight = -mass * kGravity * arm * std::cos(rocker.angle);
  EXPECT_NEAR(turning + weight, (moment + mass * arm * arm) * rocker.acceleration, 10 * kRounding);
  EXPECT_NEAR(solution.loop_forces[2], -turning, 10 * kRounding);
  expect_equal(solution.loops.G.transpose() * solution.loop_lambda, solution.loop_forces);
}

TEST(PlanarLoops, ARevoluteJointHoldsAFourBarWithThreeRedundantRows) {
  const FourBarCase given;
  const auto pin = solve(four_bar(given.bars, LoopType::kPlanarPin), given.y, given.z, given.u);
  const auto hinge = solve(four_bar(given.bars, LoopType::kRevolute), given.y, given.z, given.u);
  EXPECT_EQ(hinge.loop_rank, 2);
  EXPECT_EQ(hinge.size - hinge.rank, 3);
  expect_equal(hinge.zdot, pin.zdot);
  expect_equal(hinge.loop_forces, pin.loop_forces);
  const VectorL& lambda = pin.loop_lambda;
  expect_equal(hinge.loop_lambda, vector({lambda[0], lambda[1], 0, 0, 0}));
}

// The rows of a pin have the carrier's axes: turning the base turns the whole linkage with its multipliers.
TEST(PlanarLoops, APinsMultipliersTurnWithItsCarrier) {
  const FourBarCase given;
  VectorL lambda[2];
  for (const bool turned : {false, true}) {
    Linkage linkage = four_bar(given.bars, LoopType::kPlanarPin, true);
    linkage.mechanism.gravity = {};
    const Long base = turned ? 1.1L : 0;
    const VectorL y = vector({base, given.y[0], given.y[1], given.y[2]});
    const VectorL z = vector({0.4L, given.z[0], given.z[1], given.z[2]});
    const auto solution = solve(linkage, y, z, given.u);
    expect_equal(solution.loops.g, vector({0, 0}));
    lambda[turned] = solution.loop_lambda;
  }
  EXPECT_GE(lambda[0].norm(), 1);
  expect_equal(lambda[1], lambda[0]);
}

/// A slider-crank: crank of length `a` about the origin, rod of length `b`, slider along x, closed by `type`.
Linkage slider_crank(double a, double b, LoopType type) {
  Linkage linkage;
  linkage.mechanism.gravity = {0.0, -9.81, 0.0};
  linkage.add_plate(1.1, 0.05, 0.0, 0.03);
  linkage.add_plate(0.9, 0.3, 0.0, 0.05);
  linkage.add_plate(2.2, 0.0, 0.0, 0.01);
  linkage.add_joint(JointType::kRevolute, {}, 0);
  linkage.add_joint(JointType::kRevolute, 0, 1, {a, 0.0, 0.0});
  linkage.add_joint(JointType::kPrismatic, {}, 2, {}, {1, 0, 0});
  const model::FrameIndex to = linkage.add_frame(1, {b, 0.0, 0.0});
  linkage.add_loop(type, linkage.add_frame(2), to);
  return linkage;
}

// With φ the rod's angle: a sin θ + b sin φ = 0 and x = a cos θ + b cos φ.
TEST(PlanarLoops, ASliderCrankObeysItsLoopEquationsAndVirtualPower) {
  const double crank_length = 0.2, rod_length = 0.6;
  const Long a = crank_length, b = rod_length, center1 = 0.05, center2 = 0.3;
  const Long theta = 0.9, omega = -3.1;
  Turning rod;
  rod.angle = std::asin(-a * std::sin(theta) / b);
  rod.rate = -a * std::cos(theta) * omega / (b * std::cos(rod.angle));
  const auto motion = [&](Long alpha) {
    const Turning crank{theta, omega, alpha};
    Turning moved = rod;
    moved.acceleration = -(a * crank.change().imag() - b * rod.rate * rod.rate * std::sin(rod.angle)) /
                         (b * std::cos(rod.angle));
    return std::pair(crank, moved);
  };
  const auto lacking = [&](Long alpha) {
    const auto [crank, moved] = motion(alpha);
    const Complex weight(0, kGravity);
    const Long slider_rate = (a * crank.velocity() + b * moved.velocity()).real();
    const Long slider = (a * crank.change() + b * moved.change()).real();
    return 1.1 * dot(center1 * crank.velocity(), center1 * crank.change() + weight) + 0.03 * alpha * omega +
           0.9 * dot(a * crank.velocity() + center2 * moved.velocity(),
                     a * crank.change() + center2 * moved.change() + weight) +
           0.05 * moved.acceleration * moved.rate + 2.2 * slider * slider_rate;
  };
  const Long alpha = -lacking(0) / (lacking(1) - lacking(0));
  const auto [crank, moved] = motion(alpha);
  const Complex slider = a * crank.direction() + b * moved.direction(),
                slider_rate = a * crank.velocity() + b * moved.velocity(),
                slider_change = a * crank.change() + b * moved.change();
  for (const LoopType type : {LoopType::kPlanarPin, LoopType::kCylindrical, LoopType::kPointOnLine}) {
    const auto solution = solve(slider_crank(crank_length, rod_length, type),
                                vector({theta, moved.angle - theta, slider.real()}),
                                vector({omega, moved.rate - omega, slider_rate.real()}), {});
    EXPECT_LE(solution.loops.g.norm() + solution.loops.rate.norm(), kRounding);
    expect_equal(solution.zdot, vector({alpha, moved.acceleration - alpha, slider_change.real()}));
    EXPECT_EQ(solution.loop_rank, 2);
  }
}

// Two rotors with a = 2 b: the gear adds up inertias as seen from b, λ is the tooth force as a moment on a.
TEST(PlanarLoops, AGearIsAResidual) {
  Linkage linkage;
  for (const double moment : {0.3, 0.8})
    linkage.add_joint(JointType::kRevolute, {}, linkage.add_plate(1.0, 0.0, 0.0, moment));
  const auto angle = [](std::size_t joint) {
    return Expression::variable({model::Variable::Kind::kPosition, joint, 0});
  };
  using Op = Expression::Op;
  linkage.add_loop(LoopType::kResidual).residual =
      Expression::binary(Op::kSubtract, angle(0), Expression::binary(Op::kMultiply, 2.0, angle(1)));
  linkage.mechanism.actuators.emplace_back().joint = model::JointIndex(1);
  const Long torque = 1.7, acceleration = torque / (0.8 + 4 * 0.3);
  const auto solution = solve(linkage, vector({13, 6.5}), vector({3, 1.5}), vector({torque}));
  expect_equal(solution.zdot, vector({2 * acceleration, acceleration}));
  expect_equal(solution.loop_lambda, vector({-0.3 * 2 * acceleration}));
  expect_equal(solution.loops.g, vector({0}));
  EXPECT_EQ(solution.loops.G, (MatrixL(1, 2) << 1, -2).finished());
}

TEST(PlanarLoops, HaveNoAccelerationsWhereTheStateHasRunAway) {
  const Linkage linkage = four_bar(FourBar{}, LoopType::kPlanarPin);
  const DescriptorReference<double> descriptor(linkage.mechanism);
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(3, NAN), z = Eigen::VectorXd::Zero(3),
                        u = Eigen::VectorXd::Zero(1);
  const auto rates = descriptor.rates(descriptor.absolute(0, y, z), u);
  EXPECT_FALSE(rates.xdot.allFinite());
}

}  // namespace
}  // namespace jourdain::reference
