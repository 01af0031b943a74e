// The emitted steppers of tops, governor, pendulum and driven scenes against closed forms and published digits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <vector>

#include "agreement/shared_data.hpp"
#include "cart_stops/cart_stops_kernels.hpp"
#include "flyball_governor/flyball_governor_kernels.hpp"
#include "hoop_bead/hoop_bead_kernels.hpp"
#include "lagrange_top/lagrange_top_kernels.hpp"
#include "quadrotor/quadrotor_kernels.hpp"
#include "rolling_ball/rolling_ball_kernels.hpp"
#include "shaking_cart/shaking_cart_kernels.hpp"
#include "spring_pendulum/spring_pendulum_kernels.hpp"
#include "tumbling_body/tumbling_body_kernels.hpp"
#include "tumbling_box/tumbling_box_kernels.hpp"
#include "wind_turbine/wind_turbine_kernels.hpp"

namespace jourdain::tests {
namespace {

using nlohmann::json;
using std::numbers::pi;

json reference_json(const std::string& name) {
  std::ifstream file(data_path("reference") / name);
  return json::parse(file);
}

double number(const json& text) { return std::stod(text.get<std::string>()); }

template <class Model>
typename Model::State stepped(const Model& model, typename Model::State state, double h, long steps) {
  for (long i = 0; i < steps; ++i) rk4_step(model, state, {}, h);
  return state;
}

TEST(ClosedForms, TorqueFreeTopsFollowJacobisFunctions) {
  const json data = reference_json("tops_and_pendulum.json");
  constexpr double h = 5e-4;
  struct Top {
    const char* key;
    double w[3];
  };
  const Top tops[] = {{"dzhanibekov I=(1,2,3) w0=(0.01,5,0.01)", {0.01, 5, 0.01}},
                      {"asymmetric I=(1,2,3) w0=(1,1,1)", {1, 1, 1}},
                      {"asymmetric I=(1,2,3) w0=(2,0.5,0.3)", {2, 0.5, 0.3}}};
  const tumbling_body::Model<> model;
  for (const Top& top : tops)
    for (const json& row : data[top.key]["rows"]) {
      auto state = initial_state(model);
      for (int k = 0; k < 3; ++k) state.z[3 + k] = top.w[k];
      const double t = row["t"];
      state = stepped(model, state, h, std::lround(t / h));
      double error = 0;
      for (int k = 0; k < 3; ++k)
        error = std::max(error, std::fabs(state.z[3 + k] - number(row["w"][std::size_t(k)])));
      fmt::print("{:<42} t = {:>2} s, h = {} s: error of the rates {:.1e} rad/s\n", top.key, t, h, error);
      EXPECT_LE(error, 1e-8) << top.key << " " << t;
    }
}

/// Distance of two attitudes and rates of a free body.
double distance(const tumbling_body::State<>& a, const tumbling_body::State<>& b) {
  double same = 0, opposite = 0, rates = 0;
  for (int k = 3; k < 7; ++k) {
    same = std::hypot(same, a.y[k] - b.y[k]);
    opposite = std::hypot(opposite, a.y[k] + b.y[k]);
  }
  for (int k = 3; k < 6; ++k) rates = std::hypot(rates, a.z[k] - b.z[k]);
  return std::min(same, opposite) + rates;
}

TEST(ClosedForms, RungeKuttaKeepsOrderFourOnQuaternions) {
  const tumbling_body::Model<> model;
  auto start = initial_state(model);
  const double w[3] = {3, 0.5, 4};
  for (int k = 0; k < 3; ++k) start.z[3 + k] = w[k];
  const double speed = std::hypot(w[0], w[1], w[2]), duration = 2;
  const auto exact = stepped(model, start, duration / 100000, 100000);
  double previous = 0;
  for (int steps = 20; steps <= 320; steps *= 2) {
    const double h = duration / steps;
    const double error = distance(stepped(model, start, h, steps), exact);
    const double order = previous > 0 ? std::log2(previous / error) : 0;
    fmt::print("|omega| h = {:.3f}: error {:.2e}, order {:.2f}\n", speed * h, error, order);
    if (previous > 0) {
      EXPECT_NEAR(order, 4, 0.5) << h;
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-7);
}

TEST(ClosedForms, QuaternionsStayAtUnitLength) {
  const tumbling_body::Model<> model;
  const auto end = stepped(model, initial_state(model), 0.05, 2000);
  EXPECT_NEAR(std::hypot(std::hypot(end.y[3], end.y[4]), std::hypot(end.y[5], end.y[6])), 1, 1e-15);
}

/// Inclination (from the vertical) and azimuth of the top's axis.
struct Axis {
  double theta, phi;
};

Axis axis_of(const lagrange_top::Model<>& model, const lagrange_top::State<>& state) {
  lagrange_top::Outputs<> results;
  outputs(model, state, {}, results);
  const auto& R = results.pose.rotation;
  return {std::acos(R[2][2]), std::atan2(R[1][2], R[0][2])};
}

TEST(ClosedForms, LagrangeTopNutatesBetweenItsCusps) {
  const json data = reference_json("tops_and_pendulum.json");
  const json& top = data["lagrange_top"];
  const lagrange_top::Model<> model;
  constexpr double h = 1e-4;
  auto state = initial_state(model);
  std::vector<Axis> way;
  for (int i = 0; i < 12000; ++i) {
    way.push_back(axis_of(model, state));
    rk4_step(model, state, {}, h);
  }
  // Largest inclinations, each by a parabola through three points.
  std::vector<double> times, azimuths, heights;
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const double a = way[i - 1].theta, b = way[i].theta, c = way[i + 1].theta;
    if (!(b > a && b >= c)) continue;
    const double offset = 0.5 * (a - c) / (a - 2 * b + c);
    times.push_back((double(i) + offset) * h);
    heights.push_back(b - 0.25 * (a - c) * offset);
    azimuths.push_back(way[i].phi + offset * (way[i + 1].phi - way[i - 1].phi) / 2);
  }
  ASSERT_GE(times.size(), 3u);
  const double period = times[2] - times[1], precession = azimuths[2] - azimuths[1];
  fmt::print("h = {} s: period {:.9f} s, largest inclination {:.9f} deg, precession {:.9f} rad\n", h, period,
             heights[1] * 180 / pi, precession);
  EXPECT_NEAR(period, number(top["nutation_period"]), 1e-6);
  EXPECT_NEAR(heights[1] * 180 / pi, number(top["theta_max_deg"]), 1e-7);
  EXPECT_NEAR(precession, number(top["precession_per_nutation"]), 1e-6);
}

TEST(ClosedForms, FlyballGovernorFollowsThePublishedMotion) {
  std::ifstream file(data_path("reference/flyball_governor.csv"));
  std::string line;
  std::getline(file, line);
  const flyball_governor::Model<> model;
  auto state = initial_state(model);
  ASSERT_STREQ(flyball_governor::position_names[1], "slider");
  constexpr double h = 3e-4;
  double worst = 0;
  long rows = 0, steps = 0;
  while (std::getline(file, line)) {
    const double t = std::stod(line), s = std::stod(line.substr(line.find(',') + 1));
    for (; static_cast<double>(steps + 1) * h <= t + 1e-12; ++steps) rk4_step(model, state, {}, h);
    auto there = state;
    if (const double rest = t - static_cast<double>(steps) * h; rest > 1e-12)
      rk4_step(model, there, {}, rest);
    worst = std::max(worst, std::fabs(there.y[1] - s));
    ++rows;
  }
  fmt::print("h = {} s: largest error of s over 10 s {:.1e} m at {} times\n", h, worst, rows);
  EXPECT_EQ(rows, 101);
  EXPECT_LE(worst, 1e-6);
}

TEST(ClosedForms, SpringPendulumReachesThePublishedStates) {
  const json data = reference_json("spring_and_double_pendulum.json");
  for (const double k : {1e2, 1e4}) {
    spring_pendulum::Parameters<> parameters;
    parameters.k = k;
    const spring_pendulum::Model<> model(parameters);
    const double h = k > 1e3 ? 1e-5 : 1e-4;
    const auto end = stepped(model, initial_state(model), h, std::lround(1 / h));
    const json& expected = data[fmt::format("spring_pendulum_k{:.0f}", k)];
    const double error = std::max(
        {std::fabs(end.y[0] - number(expected["theta"])), std::fabs(end.y[1] - number(expected["r"])),
         std::fabs(end.z[0] - number(expected["thetadot"])), std::fabs(end.z[1] - number(expected["rdot"]))});
    fmt::print("k = {} N/m, h = {} s: error {:.1e}\n", k, h, error);
    EXPECT_LE(error, 1e-9) << k;
  }
}

TEST(ClosedForms, BeadRestsWhereGravityBalancesTheHoop) {
  const hoop_bead::Model<> model;
  auto state = initial_state(model);
  double zdot[1];
  state.z[0] = 0;
  state.y[0] = std::acos(9.81 / (64 * 0.5));
  forward_dynamics(model, state, {}, zdot);
  EXPECT_NEAR(zdot[0], 0, 1e-13);
  // s'' = rate^2 sin s cos s - g/R sin s - damping s'/(m R^2)
  state.y[0] = 1.1;
  state.z[0] = 0.7;
  forward_dynamics(model, state, {}, zdot);
  EXPECT_NEAR(zdot[0],
              64 * std::sin(1.1) * std::cos(1.1) - 9.81 / 0.5 * std::sin(1.1) - 0.01 * 0.7 / (0.1 * 0.25),
              1e-12);
}

/// x'' + 2 d x' + w² x = a W² sin(W t) for the cart seen from the table, at rest at t = 0.
struct ForcedOscillator {
  double d = 15.0 / 16, w = std::sqrt(900.0 / 8), a = 0.05, W = 12;

  double position(double t) const {
    const double D = (w * w - W * W) * (w * w - W * W) + 4 * d * d * W * W, f = a * W * W;
    const double S = f * (w * w - W * W) / D, C = -2 * f * d * W / D;
    const double v = std::sqrt(w * w - d * d);
    // Particular solution S sin(Wt) + C cos(Wt); x(0) = 0, x'(0) = 0.
    const double A = -C, B = (-S * W + d * A) / v;
    return S * std::sin(W * t) + C * std::cos(W * t) +
           std::exp(-d * t) * (A * std::cos(v * t) + B * std::sin(v * t));
  }
};

TEST(ClosedForms, RungeKuttaKeepsOrderFourOnADrivenScene) {
  const shaking_cart::Model<> model;
  const double duration = 2;
  double previous = 0;
  for (int steps = 200; steps <= 1600; steps *= 2) {
    const auto end = stepped(model, initial_state(model), duration / steps, steps);
    const double error = std::fabs(end.y[0] - ForcedOscillator{}.position(duration));
    const double order = previous > 0 ? std::log2(previous / error) : 0;
    fmt::print("h = {:.4f} s: error {:.2e} m, order {:.2f}\n", duration / steps, error, order);
    if (previous > 0) {
      EXPECT_NEAR(order, 4, 0.25);
    }
    previous = error;
  }
  EXPECT_LT(previous, 1e-7);
}

/// Freely from stop to stop, and half a period of an oscillator at each; with a damper there it leaves a stop with
/// exp(−D π/√(1 − D²)) of its speed if the damper may pull, faster as it is.
TEST(ClosedForms, CartBouncesBetweenItsStops) {
  cart_stops::Parameters<> parameters;
  parameters.static_friction = parameters.sliding_friction = 0;
  parameters.stop_damping = 0;
  const cart_stops::Model<> model(parameters);
  const double w = std::sqrt(parameters.stop_stiffness / parameters.cart_mass), speed = 1;
  const double period = 4 * parameters.reach / speed + 2 * pi / w;
  double previous = 0;
  for (const long steps : {4000L, 16000L, 64000L}) {
    const auto end = stepped(model, initial_state(model), period / double(steps), steps);
    const double error = std::fabs(end.y[0]) + std::fabs(end.z[0] - speed);
    fmt::print("h = {:.1e} s: error {:.1e}\n", period / double(steps), error);
    EXPECT_LE(error, 1e-3 * std::pow(period / double(steps) * w, 2));  // a kink costs h² of the speed
    previous = error;
  }
  EXPECT_LT(previous, 1e-10);

  parameters.stop_damping = 60;
  const cart_stops::Model<> damped(parameters);
  const double D = parameters.stop_damping / (2 * parameters.cart_mass * w), v = w * std::sqrt(1 - D * D);
  // In contact from 0 on until the force is zero: x = s e^(−D w t) sin(v t)/v, k x + c x' = 0.
  const double leaves = (pi - std::atan(2 * D * std::sqrt(1 - D * D) / (1 - 2 * D * D))) / v;
  const auto rate = [&](double t) {
    return std::exp(-D * w * t) * (std::cos(v * t) - D * w / v * std::sin(v * t));
  };
  auto state = initial_state(damped);
  const double duration = (parameters.reach + 0.2) / speed + leaves;
  state = stepped(damped, state, duration / 40000, 40000);
  EXPECT_NEAR(state.z[0], rate(leaves), 1e-4);
}

TEST(ClosedForms, ABoxComesToRestOnAFaceAndStaysThere) {
  const tumbling_box::Parameters<> parameters;
  const tumbling_box::Model<> model(parameters);
  const auto landed = stepped(model, initial_state(model), 1e-3, 8000);
  const auto end = stepped(model, landed, 1e-3, 8000);
  // Four corners carry its weight; no step closes the gap by less than rounding leaves of it.
  EXPECT_NEAR(end.y[2], 0.05 - parameters.mass * 9.81 / (4 * parameters.ground_stiffness), 2e-6);
  for (const double velocity : end.z) EXPECT_NEAR(velocity, 0, 1e-5);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(end.y[i], landed.y[i], 1e-9);
  for (int i = 3; i < 7; ++i) EXPECT_NEAR(end.y[i], landed.y[i], 1e-9);
}

/// Friction at the radius changes m v + I w/r by nothing, whatever its law is.
TEST(ClosedForms, ABallRollsAtLastWithWhatItsThrowAndItsSpinGiveIt) {
  const rolling_ball::Parameters<> parameters;
  const rolling_ball::Model<> model(parameters);
  const auto thrown = initial_state(model);
  const auto rolling = stepped(model, thrown, 1e-4, 500000);
  const double r = parameters.radius, last = (thrown.z[0] + 0.4 * r * thrown.z[4]) / 1.4;
  EXPECT_LT(last, -1);
  EXPECT_NEAR(rolling.z[0], last, 1e-8);
  EXPECT_NEAR(r * rolling.z[4], last, 1e-8);
  EXPECT_NEAR(rolling.z[2], 0, 1e-6);
  const double depth = std::pow(parameters.mass * 9.81 / parameters.ground_stiffness, 1 / 1.5);
  EXPECT_NEAR(rolling.y[2], r - depth, 1e-7);
}

/// Of the natural cubic spline through `values` at 0, 1, 2, …, by its curvatures.
double natural_spline(const Eigen::VectorXd& values, double at) {
  const Eigen::Index n = values.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 1; i + 1 < n; ++i) {
    matrix.block<1, 3>(i, i - 1) << 1, 4, 1;
    right[i] = 6 * (values[i - 1] - 2 * values[i] + values[i + 1]);
  }
  const Eigen::VectorXd curvature = reference::solved_by_lu<double>(matrix, right);
  const Eigen::Index k = std::clamp(static_cast<Eigen::Index>(at), Eigen::Index(0), n - 2);
  const double t = at - static_cast<double>(k), s = 1 - t;
  return s * values[k] + t * values[k + 1] +
         ((s * s * s - s) * curvature[k] + (t * t * t - t) * curvature[k + 1]) / 6;
}

/// The model's coefficients are Heier's, in five digits at tip speed ratios 2 … 14 and pitches of 0 … 20 deg.
double torque_coefficient(double ratio, double degrees) {
  Eigen::VectorXd of_ratios(13);
  for (int i = 0; i < 13; ++i) {
    Eigen::VectorXd of_pitches(5);
    for (int j = 0; j < 5; ++j) {
      const double l = 2 + i, b = 5 * j, x = 1 / (l + 0.08 * b) - 0.035 / (b * b * b + 1);
      const double exact = (0.5176 * (116 * x - 0.4 * b - 5) * std::exp(-21 * x) + 0.0068 * l) / l;
      of_pitches[j] = std::round(1e5 * exact) / 1e5;
    }
    of_ratios[i] = natural_spline(of_pitches, degrees / 5);
  }
  return natural_spline(of_ratios, ratio - 2);
}

/// In a steady wind the generator takes what the wind gives: the torque of the coefficients' table, interpolated here,
/// and the generator's law, of which its table has points.
TEST(ClosedForms, AWindTurbineSettlesWhereItsTablesMeet) {
  const wind_turbine::Parameters<> parameters;
  const wind_turbine::Model<> model(parameters);
  for (const double wind : {9.5, 10.0}) {
    auto state = initial_state(model);
    const double pitch = 2 * pi / 180;
    for (int i = 0; i < 60000; ++i) rk4_step(model, state, {{wind, pitch}}, 0.01);
    const double rate = state.z[0], ratio = parameters.radius * rate / wind;
    ASSERT_TRUE(ratio > 2 && ratio < 14) << ratio;
    const double coefficient = torque_coefficient(ratio, 2);
    const double torque =
        parameters.density / 2 * pi * std::pow(parameters.radius, 3) * wind * wind * coefficient;
    wind_turbine::Outputs<> results;
    outputs(model, state, {{wind, pitch}}, results);
    EXPECT_NEAR(results.power / (torque * rate), 1, 1e-9);
    const double rpm = parameters.gear * rate * 30 / pi;
    ASSERT_TRUE(rpm > 871 && rpm < 1100) << rpm;
    EXPECT_NEAR(results.power / (parameters.gear * rate * 0.0255764 * rpm * rpm), 1, 2e-3);
    EXPECT_NEAR(state.y[1], -parameters.gear * results.power / (parameters.gear * rate) / 8.67637e8, 1e-12);
    fmt::print("wind {} m/s: tip speed ratio {:.3f}, {:.0f} rpm, {:.2f} MW\n", wind, ratio, rpm,
               results.power / 1e6);
  }
}

TEST(ClosedForms, DrivesPayForWhatTheyMove) {
  const shaking_cart::Model<> model;
  auto state = initial_state(model);
  state.t = 0.3;
  state.y[0] = 0.02;
  state.z[0] = -0.1;
  shaking_cart::Outputs<> results;
  outputs(model, state, {}, results);
  // m_table a_table less the spring and the damper of the cart.
  const double table = -0.05 * 144 * std::sin(12 * 0.3);
  EXPECT_NEAR(results.table_force, 40 * table - 900 * 0.02 + 15 * 0.1, 1e-11);
}

TEST(ClosedForms, QuadrotorHoversAndTurns) {
  const quadrotor::Model<> model;
  const auto state = initial_state(model);
  quadrotor::Input<> input;
  for (double& thrust : input.u) thrust = 0.028 * 9.81 / 4;
  double zdot[6];
  forward_dynamics(model, state, input, zdot);
  for (double a : zdot) EXPECT_NEAR(a, 0, 1e-11);
  input.u[1] += 0.01;
  input.u[3] += 0.01;
  forward_dynamics(model, state, input, zdot);
  EXPECT_NEAR(zdot[2], 0.02 / 0.028, 1e-12);
  EXPECT_GT(zdot[5], 0);
}

}  // namespace
}  // namespace jourdain::tests
