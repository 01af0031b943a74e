// N coupled parallelograms: what a step costs as N grows, and that many of them run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "loops/closed_programs.hpp"
#include "model/read/read.hpp"
#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

/// Problem A02 of the IFToMM multibody benchmark library with `count` windows; see models/n_four_bar.toml.
model::Mechanism windows(int count) {
  std::string text = "[model]\nname = \"windows\"\ngravity = [0, -9.81, 0]\n";
  const auto bar = [&text](const std::string& name, const char* axis, const char* center) {
    text += fmt::format(
        "[[body]]\nname = \"{}\"\nmass = 1.0\ncenter_of_mass = {}\nshape = {{ kind = \"rod\", length = 1.0, "
        "axis = \"{}\" }}\n",
        name, center, axis);
  };
  const auto hinge = [&text](const std::string& name, const std::string& parent, const std::string& child,
                             const std::string& position, double velocity) {
    text += fmt::format(
        "[[joint]]\nname = \"{}\"\ntype = \"revolute\"\nparent = \"{}\"\nchild = \"{}\"\nposition = "
        "[{}, 0]\ninitial_velocity = {}\n",
        name, parent, child, position, velocity);
  };
  for (int i = 0; i <= count; ++i) bar(fmt::format("bar{}", i), "y", "[0, 0.5, 0]");
  for (int i = 1; i <= count; ++i) bar(fmt::format("top{}", i), "x", "[0.5, 0, 0]");
  for (int i = 0; i <= count; ++i)
    hinge(fmt::format("upright{}", i), "world", fmt::format("bar{}", i), fmt::format("{}, 0", i), -1);
  for (int i = 1; i <= count; ++i)
    hinge(fmt::format("beam{}", i), fmt::format("bar{}", i - 1), fmt::format("top{}", i), "0, 1", 1);
  for (int i = 1; i <= count; ++i)
    text += fmt::format(
        "[[frame]]\nname = \"b{0}\"\nbody = \"bar{0}\"\nposition = [0, 1, 0]\n[[frame]]\nname = \"end{0}\"\n"
        "body = \"top{0}\"\nposition = [1, 0, 0]\n[[loop]]\nname = \"pin{0}\"\ntype = \"planar_pin\"\nfrom = "
        "\"b{0}\"\nto = \"end{0}\"\n",
        i);
  text += "[loops]\ntreatment = \"multipliers\"\n";
  support::Diagnostics diagnostics("windows.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  JD_CHECK(mechanism, "{}", diagnostics.format());
  return *mechanism;
}

using Vector = std::vector<double>;

/// The state of motion in interpreted arithmetic.
class Simulation {
 public:
  explicit Simulation(const ClosedPrograms& programs)
      : programs_(programs), y_(programs.plan().y), z_(programs.plan().z) {}

  /// One step of the classical Runge-Kutta method, then the projection.
  void step(double h) {
    const Vector a1 = rates(y_, z_), v1 = z_;
    const Vector v2 = moved(z_, h / 2, a1), a2 = rates(moved(y_, h / 2, v1), v2);
    const Vector v3 = moved(z_, h / 2, a2), a3 = rates(moved(y_, h / 2, v2), v3);
    const Vector v4 = moved(z_, h, a3), a4 = rates(moved(y_, h, v3), v4);
    for (std::size_t i = 0; i < y_.size(); ++i) {
      y_[i] += h / 6 * (v1[i] + 2 * (v2[i] + v3[i]) + v4[i]);
      z_[i] += h / 6 * (a1[i] + 2 * (a2[i] + a3[i]) + a4[i]);
    }
    const auto projected = programs_.values("project", 0, y_, z_, {});
    for (std::size_t i = 0; i < y_.size(); ++i) {
      y_[i] = projected.at(fmt::format("y[{}]", i));
      z_[i] = projected.at(fmt::format("z[{}]", i));
    }
  }

  double energy() const {
    return programs_.values("kinetic_energy", 0, y_, z_, {}).at("T") +
           programs_.values("potential_energy", 0, y_, z_, {}).at("V");
  }
  double opening() const {
    double worst = 0;
    for (const auto& [name, value] : programs_.values("constraint_residual", 0, y_, z_, {}))
      if (name[1] == '[') worst = std::max(worst, std::fabs(value));
    return worst;
  }

 private:
  static Vector moved(Vector x, double h, const Vector& rate) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * rate[i];
    return x;
  }
  Vector rates(const Vector& y, const Vector& z) const {
    const auto values = programs_.values("forward_dynamics", 0, y, z, {});
    Vector zdot(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) zdot[i] = values.at(fmt::format("zdot[{}]", i));
    return zdot;
  }

  const ClosedPrograms& programs_;
  Vector y_, z_;
};

TEST(ChainOfWindows, CostsInProportionToItsLength) {
  std::map<int, std::size_t> cost;
  std::vector<int> lengths = {2, 5, 10, 20};
  if (draws_all_cases()) lengths.push_back(40);
  fmt::print("  N   forward_dynamics   project   rk4_step\n");
  for (const int count : lengths) {
    const ClosedPrograms programs(windows(count));
    const std::size_t dynamics = programs.operations("forward_dynamics"),
                      project = programs.operations("project");
    cost[count] = 4 * dynamics + project;
    fmt::print("{:3}   {:16}   {:7}   {:8}\n", count, dynamics, project, cost[count]);
  }
  // A straight line from the second case on: each window costs the same.
  const double first = double(cost[10] - cost[5]) / 5;
  for (const auto& [shorter, longer] : {std::pair(10, 20), {20, 40}}) {
    if (!cost.contains(longer)) continue;
    EXPECT_NEAR(double(cost[longer] - cost[shorter]) / (longer - shorter), first, 0.02 * first);
  }
}

TEST(ChainOfWindows, OfManyRunsThroughItsFirstSingularPosition) {
  const int count = draws_all_cases() ? 40 : 10;
  const ClosedPrograms programs(windows(count));
  EXPECT_EQ(programs.plan().freedom, 1u);
  Simulation run(programs);
  const double at_start = run.energy();
  double drift = 0, opening = 0;
  for (int i = 0; i < 500; ++i) {
    run.step(2e-3);
    drift = std::max(drift, std::fabs(run.energy() - at_start));
    opening = std::max(opening, run.opening());
  }
  fmt::print("N = {}, 1 s: energy drift {:.1e} J, residual {:.1e} m\n", count, drift, opening);
  EXPECT_LT(drift, 1e-5);
  EXPECT_LT(opening, 1e-9);
}

}  // namespace
}  // namespace jourdain::tests
