// Emitted models with number types of the user's, several of them in one translation unit.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "embed/emitted_models.hpp"
#include "embed/generic_driver.hpp"
#include "embed/pack.hpp"

namespace jourdain::tests {

/// Value and derivative with respect to one seed variable.
struct Dual {
  double value = 0, derivative = 0;

  Dual() = default;
  explicit Dual(double v, double d = 0) : value(v), derivative(d) {}
  friend Dual operator+(Dual a, Dual b) { return Dual(a.value + b.value, a.derivative + b.derivative); }
  friend Dual operator-(Dual a, Dual b) { return Dual(a.value - b.value, a.derivative - b.derivative); }
  friend Dual operator-(Dual a) { return Dual(-a.value, -a.derivative); }
  friend Dual operator*(Dual a, Dual b) {
    return Dual(a.value * b.value, a.derivative * b.value + a.value * b.derivative);
  }
  friend Dual operator/(Dual a, Dual b) {
    return Dual(a.value / b.value, (a.derivative * b.value - a.value * b.derivative) / (b.value * b.value));
  }
  friend Dual sin(Dual a) { return Dual(std::sin(a.value), a.derivative * std::cos(a.value)); }
  friend Dual cos(Dual a) { return Dual(std::cos(a.value), -a.derivative * std::sin(a.value)); }
  friend Dual sqrt(Dual a) { return Dual(std::sqrt(a.value), a.derivative / (2 * std::sqrt(a.value))); }
  friend Dual atan2(Dual a, Dual b) {
    return Dual(std::atan2(a.value, b.value),
                (b.value * a.derivative - a.value * b.derivative) / (a.value * a.value + b.value * b.value));
  }
};

namespace {

template <class Model>
typename Model::State after(int steps) {
  using Real = typename Model::Scalar;
  const Model model;
  auto state = initial_state(model);
  for (int i = 0; i < steps; ++i) rk4_step(model, state, typename Model::Input{}, Real(1e-4));
  return state;
}

/// Positions after some steps; of a number type with several lanes, all lanes.
template <class Real>
std::vector<Real> positions(auto state) {
  std::vector<Real> values;
  for_positions(state, [&values](const Real& y) { values.push_back(y); });
  return values;
}

TEST(NumberTypes, PacksOfFourGiveTheBitsOfDouble){
#define JOURDAIN_COMPARE_PACK(name)                                         \
  {                                                                         \
    const auto one = positions<double>(after<::name::Model<double>>(20));   \
    const auto four = positions<Pack>(after<::name::Model<Pack>>(20));      \
    for (std::size_t i = 0; i < one.size(); ++i)                            \
      for (double v : four[i].v) EXPECT_EQ(v, one[i]) << #name << " " << i; \
  }
    JOURDAIN_EMITTED_MODELS(JOURDAIN_COMPARE_PACK)}

TEST(NumberTypes, DualNumbersGiveTheGradientOfThePotential) {
  // dV/dy_0 of the Panda arm is q_bar without inputs.
  const panda::Model<Dual> model;
  for (int j = 0; j < panda::Model<>::velocity_count; ++j) {
    auto state = initial_state(model);
    state.y[j].derivative = 1;
    Dual q[7];
    q_bar(model, state, {}, q);
    EXPECT_NEAR(potential_energy(model, state).derivative, q[j].value, 1e-13);
  }
}

TEST(NumberTypes, LongDoubleAndFloatAgreeWithDouble){
#define JOURDAIN_COMPARE_LENGTHS(name)                                            \
  {                                                                               \
    const auto d = positions<double>(after<::name::Model<double>>(10));           \
    const auto l = positions<long double>(after<::name::Model<long double>>(10)); \
    const auto f = positions<float>(after<::name::Model<float>>(10));             \
    for (std::size_t i = 0; i < d.size(); ++i) {                                  \
      EXPECT_NEAR(d[i], double(l[i]), 1e-12) << #name;                            \
      EXPECT_NEAR(d[i], double(f[i]), 1e-3) << #name;                             \
    }                                                                             \
  }
    JOURDAIN_EMITTED_MODELS(JOURDAIN_COMPARE_LENGTHS)}

TEST(State, CopiesGoOnInTwoThreadsWithTheSameBits) {
  const panda::Model<> model;
  auto first = initial_state(model), second = first;
  const auto run = [&model](panda::State<>& state) {
    for (int i = 0; i < 2000; ++i) rk4_step(model, state, {}, 1e-3);
  };
  std::thread thread(run, std::ref(first));
  run(second);
  thread.join();
  for (int i = 0; i < 7; ++i) EXPECT_EQ(first.y[i], second.y[i]);
  EXPECT_EQ(first.t, second.t);
}

TEST(Parameters, ChangeTheModelAtRunTime) {
  pendulum::Parameters<> parameters;
  parameters.l = 4.0;
  const pendulum::Model<> model(parameters);
  const auto state = initial_state(model);
  double zdot[1];
  forward_dynamics(model, state, {}, zdot);
  EXPECT_DOUBLE_EQ(zdot[0], 9.81 / 4.0);
}

TEST(Names, AreClosedByANullPointer) {
  EXPECT_STREQ(panda::position_names[0], "joint1");
  EXPECT_EQ(panda::position_names[7], nullptr);
  EXPECT_EQ(pendulum::input_names[0], nullptr);
  EXPECT_STREQ(pendulum::parameter_names[0], "m");
}

}  // namespace
}  // namespace jourdain::tests
