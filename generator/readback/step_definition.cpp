// Explicit methods by their definition.
#include <fmt/format.h>

#include "readback/step_data.hpp"
#include "readback/tokens.hpp"

namespace jourdain::readback {

namespace {

ExactVector plus(const ExactVector& x, const Exact& factor, const ExactVector& v) {
  ExactVector sum = x;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + factor * v[i];
  return sum;
}

struct Rates {
  ExactVector y, z;
};

ExactVector velocities(const Expected& expected, OpaqueSystem& system, const Motion& motion) {
  return has_rate(expected) ? system.position_rate(motion) : motion.z;
}

Rates rates(const Expected& expected, OpaqueSystem& system, const StepData& data, const Motion& motion) {
  return {velocities(expected, system, motion),
          system.forward_dynamics(motion, input_at(system, data, motion))};
}

/// Unit quaternions, closed loops.
void finish(const Expected& expected, OpaqueSystem& system, Motion& motion) {
  normalise_quaternions(expected, motion);
  system.correct(motion);
}

void runge_kutta(const Expected& expected, const Tableau& tableau, OpaqueSystem& system, StepData& data) {
  const Motion start = data.motion;
  std::vector<Rates> k;
  for (std::size_t i = 0; i < tableau.b.size(); ++i) {
    Motion stage = start;
    stage.t = start.t + exact(tableau.c[i]) * data.h;
    for (std::size_t j = 0; j < i; ++j) {
      const Exact factor = data.h * exact(tableau.a[i][j]);
      stage.y = plus(stage.y, factor, k[j].y);
      stage.z = plus(stage.z, factor, k[j].z);
    }
    k.push_back(rates(expected, system, data, stage));
  }
  for (std::size_t i = 0; i < k.size(); ++i) {
    const Exact factor = data.h * exact(tableau.b[i]);
    data.motion.y = plus(data.motion.y, factor, k[i].y);
    data.motion.z = plus(data.motion.z, factor, k[i].z);
  }
  data.motion.t = start.t + data.h;
  finish(expected, system, data.motion);
}

/// Velocities first, positions with the new velocities at the old time and positions.
void semi_implicit_euler(const Expected& expected, OpaqueSystem& system, StepData& data) {
  Motion& motion = data.motion;
  motion.z = plus(motion.z, data.h, system.forward_dynamics(motion, input_at(system, data, motion)));
  motion.y = plus(motion.y, data.h, velocities(expected, system, motion));
  motion.t = motion.t + data.h;
  finish(expected, system, motion);
}

/// Until the history is full a step of RK4; then a polynomial through the rates of this and earlier steps.
void adams_bashforth_step(const Expected& expected, std::size_t earlier, OpaqueSystem& system,
                          StepData& data) {
  const Rates now = rates(expected, system, data, data.motion);
  if (data.count < static_cast<int>(earlier)) {
    runge_kutta(expected, *find_tableau("rk4"), system, data);
    ++data.count;
  } else {
    const std::vector<Fraction> weights = adams_bashforth(static_cast<int>(earlier) + 1);
    for (std::size_t k = 0; k <= earlier; ++k) {
      const Exact factor = data.h * exact(weights[k]);
      data.motion.y = plus(data.motion.y, factor, k == 0 ? now.y : data.ydot[k - 1]);
      data.motion.z = plus(data.motion.z, factor, k == 0 ? now.z : data.zdot[k - 1]);
    }
    data.motion.t = data.motion.t + data.h;
  }
  data.ydot.insert(data.ydot.begin(), now.y);
  data.zdot.insert(data.zdot.begin(), now.z);
  data.ydot.pop_back();
  data.zdot.pop_back();
  finish(expected, system, data.motion);
}

}  // namespace

void normalise_quaternions(const Expected& expected, Motion& motion) {
  for (const ExpectedTangent& quaternion : expected.quaternions) {
    Exact square = exact(0.0);
    for (std::size_t i = 0; i < 4; ++i) {
      const Exact& part = motion.y[quaternion.position + i];
      square = square + part * part;
    }
    const Exact length = cln::sqrt(square);
    for (std::size_t i = 0; i < 4; ++i)
      motion.y[quaternion.position + i] = motion.y[quaternion.position + i] / length;
  }
}

ExactVector input_at(OpaqueSystem& system, const StepData& data, const Motion& motion) {
  return data.is_sampled ? system.sample(motion) : data.input;
}

void step_by_definition(const Expected& expected, const std::string& method, OpaqueSystem& system,
                        StepData& data) {
  if (expected.has_samples) system.take_samples(data.motion, input_at(system, data, data.motion), data.h);
  if (expected.velocities.empty()) {
    data.motion.t = data.motion.t + data.h;
    for (int i = 0; i < expected.closings; ++i) system.correct(data.motion);
  } else if (const Tableau* tableau = find_tableau(method)) {
    runge_kutta(expected, *tableau, system, data);
  } else if (const RosenbrockTable* table = find_rosenbrock_table(method)) {
    rosenbrock_step(expected, *table, system, data);
  } else if (method == "semi_implicit_euler") {
    semi_implicit_euler(expected, system, data);
  } else if (method == "adams_bashforth2" || method == "adams_bashforth3") {
    adams_bashforth_step(expected, method.back() == '2' ? 1 : 2, system, data);
  } else {
    throw Refusal(fmt::format("the method {} has no definition", method));
  }
}

}  // namespace jourdain::readback
