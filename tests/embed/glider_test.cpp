// The glider, whose lift and drag are functions that its user writes, against the closed form of its steady glide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "embed/emitted_models.hpp"

namespace jourdain::tests {
namespace {

struct Glide {
  double speed, down;  ///< m/s; the path's angle under the horizon, rad
};

/// Where lift and drag hold the weight at the incidence that the tail asks for.
Glide steady_glide(const glider::Model<>& model) {
  const glider::Parameters<> p;
  const double lift = model.functions.lift(p.trim), drag = model.functions.drag(p.trim);
  const double weight = p.mass * 9.81;
  return {std::sqrt(2 * weight / (p.density * p.area * std::hypot(lift, drag))), std::atan2(drag, lift)};
}

void fly(const glider::Model<>& model, double& rest, double& missed) {
  const Glide glide = steady_glide(model);
  glider::State<> state = initial_state(model);
  state.y[2] = glider::Parameters<>().trim - glide.down;
  state.z[0] = glide.speed * std::cos(glide.down);
  state.z[1] = -glide.speed * std::sin(glide.down);
  state.z[2] = 0;
  double zdot[3];
  forward_dynamics(model, state, {}, zdot);
  rest = 0;
  for (const double entry : zdot) rest = std::max(rest, std::fabs(entry));
  state = initial_state(model);
  for (int i = 0; i < 150000; ++i) rk4_step(model, state, {}, 0.01);
  missed = std::max(std::fabs(std::hypot(state.z[0], state.z[1]) - glide.speed),
                    std::fabs(std::atan2(-state.z[1], state.z[0]) - glide.down));
}

TEST(Glider, GlidesSteadilyAsItsFunctionsSay) {
  glider::Model<> model;
  double rest = 0, missed = 0;
  fly(model, rest, missed);
  EXPECT_LT(rest, 1e-13);
  EXPECT_LT(missed, 1e-12);
  std::printf("glider: accelerations %.1e in a steady glide, %.1e from it after 1500 s\n", rest, missed);
  const Glide before = steady_glide(model);
  model.functions.parasitic = 0.05;  // brakes
  fly(model, rest, missed);
  EXPECT_LT(rest, 1e-13);
  EXPECT_LT(missed, 1e-12);
  EXPECT_GT(steady_glide(model).down, 1.5 * before.down);
  std::printf("with brakes: accelerations %.1e in a steady glide, %.1e from it after 1500 s\n", rest, missed);
}

}  // namespace
}  // namespace jourdain::tests
