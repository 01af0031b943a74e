// Cams, motions and guides by splines, against splines and equations of motion of the test's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "dynamics/equations_at.hpp"
#include "extremes/extreme_scenes.hpp"
#include "loops/closed_programs.hpp"
#include "reference/decompositions.hpp"

namespace jourdain::tests {
namespace {

constexpr double kGravity = 9.81;
const std::string kModel = "[model]\nname = \"scene\"\n";

/// A cubic spline of the curvatures at its points, which a dense system tells (Stoer and Bulirsch, Introduction to
/// Numerical Analysis, section 2.4): natural or periodic.
class Spline {
 public:
  Spline(const std::vector<double>& x, const std::vector<double>& y, bool is_periodic)
      : x_(x), y_(y), repeats_(is_periodic) {
    const auto n = Eigen::Index(x.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
      if (i == 0 && !is_periodic) continue;
      const Eigen::Index before = i == 0 ? n - 2 : i - 1;
      const double h = width(before), next = width(i);
      A(i, before) += h / 6;
      A(i, i) += (h + next) / 3;
      A(i, i + 1) += next / 6;
      b(i) = rise(i) / next - rise(before) / h;
    }
    A(n - 1, n - 1) = 1;
    if (is_periodic) A(n - 1, 0) = -1;
    if (!is_periodic) A(0, 0) = 1;
    curvature_ = reference::solved_by_lu<double>(A, b);
  }

  struct Place {
    double value, slope, curvature;
  };
  Place at(double x) const {
    const double first = x_.front(), last = x_.back();
    if (repeats_) x -= (last - first) * std::floor((x - first) / (last - first));
    const double inside = std::min(std::max(x, first), last);
    Eigen::Index i = 0;
    while (i + 2 < Eigen::Index(x_.size()) && inside >= x_[std::size_t(i) + 1]) ++i;
    const double h = width(i), d = inside - x_[std::size_t(i)], a = curvature_(i), b = curvature_(i + 1);
    const double slope = rise(i) / h - h * (2 * a + b) / 6;
    Place place = {y_[std::size_t(i)] + d * (slope + d * (a / 2 + d * (b - a) / (6 * h))),
                   slope + d * (a + d * (b - a) / (2 * h)), a + d * (b - a) / h};
    if (x == inside) return place;
    return {place.value + (x - inside) * place.slope, place.slope, 0};
  }

 private:
  double width(Eigen::Index i) const { return x_[std::size_t(i) + 1] - x_[std::size_t(i)]; }
  double rise(Eigen::Index i) const { return y_[std::size_t(i) + 1] - y_[std::size_t(i)]; }

  std::vector<double> x_, y_;
  bool repeats_;
  Eigen::VectorXd curvature_;
};

/// As `[1, 2]`.
std::string list(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + std::to_string(number);
  return "[" + text + "]";
}

std::string table(const std::vector<double>& x, const std::vector<double>& y, const std::string& beyond) {
  return "[[table]]\nname = \"curve\"\nx = " + list(x) + "\nvalues = " + list(y) +
         "\ninterpolation = \"spline\"\nbeyond = \"" + beyond + "\"\n";
}

// Few intervals, which are all computed; more of different widths, which are searched; more of equal ones.
const std::vector<std::vector<double>> kPoints = {
    {-1, 0.5, 1.5}, {-3, -2.5, -1, 0.5, 1, 2.5, 3.25}, {-3, -2, -1, 0, 1, 2, 3}};
const std::vector<std::vector<double>> kValues = {{0.02, 0.05, 0.02},
                                                  {0.02, 0.021, 0.04, 0.06, 0.03, 0.025, 0.02},
                                                  {0.02, 0.021, 0.04, 0.06, 0.03, 0.025, 0.02}};

/// The follower's mass and spring, and the shaft's inertia, seen from the shaft.
void expect_follower(const std::string& declared, const std::string& residual) {
  constexpr double kInertia = 0.02, kMass = 0.5, kStiffness = 300;
  for (std::size_t k = 0; k < kPoints.size(); ++k) {
    const Spline lift(kPoints[k], kValues[k], true);
    const ClosedPrograms programs(read_scene(kModel + table(kPoints[k], kValues[k], "repeat") + R"toml(
[[body]]
name = "camshaft"
mass = 1
inertia = [0.01, 0.02, 0.01]
[[body]]
name = "follower"
mass = 0.5
inertia = [0.001, 0.001, 0.001]
[[joint]]
name = "shaft"
type = "revolute"
parent = "world"
child = "camshaft"
axis = [0, 1, 0]
initial_velocity = 3.0
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "follower"
axis = [0, 0, 1]
stiffness = 300
)toml" + declared + "[[loop]]\nname = \"contact\"\ntype = \"residual\"\nresidual = \"" +
                                             residual + "\"\n"));
    ASSERT_EQ(programs.plan().independent.size(), 1u);
    for (const double angle : {-9.3, -3.0, -1.7, 0.1, 0.7, 2.9, 3.1, 20.4}) {
      const auto [s, slope, curvature] = lift.at(angle);
      const double speed = 2.5, moved = kInertia + kMass * slope * slope;
      const double force =
          -kMass * slope * curvature * speed * speed - slope * (kStiffness * s + kMass * kGravity);
      const auto found = programs.values("forward_dynamics", 0, {angle, s}, {speed}, {});
      EXPECT_NEAR(found.at("zdot[0]"), force / moved, 1e-11) << k << " at " << angle;
      const auto rates = programs.values("position_rate", 0, {angle, s}, {speed}, {});
      EXPECT_NEAR(rates.at("ydot[1]"), slope * speed, 1e-14) << k << " at " << angle;
      EXPECT_NEAR(programs.values("close_loops", 0, {angle, 0.3}, {speed}, {}).at("y[1]"), s, 1e-15);
    }
  }
}

TEST(CurvesOfPoints, MoveTheFollowerOfACam) {
  expect_follower("", "curve(shaft) - slide");
  expect_follower("[[function]]\nname = \"profile\"\narguments = [\"angle\"]\nvalue = \"2*curve(angle)\"\n",
                  "2*slide - profile(shaft)");
  expect_follower(
      "[[signal]]\nname = \"lift\"\nvalue = \"3*curve(shaft)\"\n[[signal]]\nname = \"profile\"\nvalue = "
      "\"lift/3\"\n",
      "slide - profile");
}

/// A pendulum below a cart that moves as told: l θ'' = −g sin θ − x'' cos θ.
TEST(CurvesOfPoints, AreMotions) {
  for (const std::string beyond : {"extend", "repeat"})
    for (std::size_t k = 0; k < kPoints.size(); ++k) {
      SCOPED_TRACE(beyond + std::to_string(k));
      const Spline motion(kPoints[k], kValues[k], beyond == "repeat");
      const model::Mechanism scene = read_scene(kModel + table(kPoints[k], kValues[k], beyond) + R"toml(
[[body]]
name = "cart"
mass = 5
[[body]]
name = "bob"
mass = 2
center_of_mass = [0, 0, -0.8]
[[joint]]
name = "shake"
type = "prismatic"
parent = "world"
child = "cart"
axis = [1, 0, 0]
motion = "curve(t)"
[[joint]]
name = "hinge"
type = "revolute"
parent = "cart"
child = "bob"
axis = [0, -1, 0]
)toml");
      const double angle = 0.7, length = 0.8, along = length * 1.3;
      for (const double t : {-4.0, -2.6, -0.3, 0.7, 1.2, 3.1, 5.6, kPoints[k].front(), kPoints[k].back()}) {
        const auto [place, speed, acceleration] = motion.at(t);
        const EquationsAt e = equations_at(scene, {{angle}, {1.3}, {}, t});
        EXPECT_NEAR((e.k_bar[0] - e.q_bar[0]) / e.M[0][0],
                    -(kGravity * std::sin(angle) + acceleration * std::cos(angle)) / length, 1e-12)
            << t;
        EXPECT_NEAR(e.kinetic_energy,
                    3.5 * speed * speed + along * along + 2 * speed * along * std::cos(angle), 1e-12)
            << t;
      }
    }
}

/// M = m (1 + f'²), k̄ = −m f' f'' s'², q̄ = m g f'.
TEST(CurvesOfPoints, GuideBodies) {
  for (std::size_t k = 0; k < kPoints.size(); ++k) {
    const Spline guide(kPoints[k], kValues[k], false);
    const model::Mechanism scene =
        one_body("mass = 2", "type = \"curve\"\ncurve = [\"s\", \"0\", \"curve(s)\"]",
                 table(kPoints[k], kValues[k], "extend"));
    for (const double s : {-4.0, -2.6, -0.3, 0.7, 1.2, 3.1, 5.6, kPoints[k].front(), kPoints[k].back()}) {
      const auto [value, slope, curvature] = guide.at(s);
      const EquationsAt e = equations_at(scene, {{s}, {1.5}});
      EXPECT_NEAR(e.M[0][0], 2 * (1 + slope * slope), 1e-13);
      EXPECT_NEAR(e.k_bar[0], -2 * slope * curvature * 1.5 * 1.5, 1e-13);
      EXPECT_NEAR(e.q_bar[0], 2 * kGravity * slope, 1e-13);
      EXPECT_NEAR(e.potential_energy, 2 * kGravity * value, 1e-13);
    }
  }
}

}  // namespace
}  // namespace jourdain::tests
