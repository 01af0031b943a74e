// Every stepper on emitted models: operations, orders, sampled inputs, memory that the caller owns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "cart_pole_all/cart_pole_all_kernels.hpp"
#include "crane_all/crane_all_kernels.hpp"
#include "embed/counting.hpp"
#include "hoop_bead_all/hoop_bead_all_kernels.hpp"
#include "quadrotor_all/quadrotor_all_kernels.hpp"

namespace jourdain::tests {
namespace {

/// Calls `visit(name, order, history, step)` for each stepper of the model's namespace, `step(state, input, h, history)`.
#define JOURDAIN_VISIT_STEPPERS(ns, Real, visit)                                                             \
  do {                                                                                                       \
    int none = 0;                                                                                            \
    ::ns::RateHistory<1, Real> one;                                                                          \
    ::ns::RateHistory<2, Real> two;                                                                          \
    const ::ns::Model<Real> model;                                                                           \
    const auto simple = [&](auto step) {                                                                     \
      return [&model, step](auto& state, const auto& input, Real h, int&) { step(model, state, input, h); }; \
    };                                                                                                       \
    const auto remembering = [&](auto step) {                                                                \
      return [&model, step](auto& state, const auto& input, Real h, auto& history) {                         \
        step(model, state, input, h, history);                                                               \
      };                                                                                                     \
    };                                                                                                       \
    visit("euler", 1, simple([](auto&... a) { ::ns::euler_step(a...); }), none);                             \
    visit("semi_implicit_euler", 1, simple([](auto&... a) { ::ns::semi_implicit_euler_step(a...); }), none); \
    visit("heun", 2, simple([](auto&... a) { ::ns::heun_step(a...); }), none);                               \
    visit("rk4", 4, simple([](auto&... a) { ::ns::rk4_step(a...); }), none);                                 \
    visit("rk5", 5, simple([](auto&... a) { ::ns::rk5_step(a...); }), none);                                 \
    visit("adams_bashforth2", 2, remembering([](auto&... a) { ::ns::adams_bashforth2_step(a...); }), one);   \
    visit("adams_bashforth3", 3, remembering([](auto&... a) { ::ns::adams_bashforth3_step(a...); }), two);   \
  } while (false)

/// Quotients of literals in the template, which compilers fold: the counting type cannot.
constexpr std::size_t kQuotientsOfRk5 = 24;

TEST(Steppers, OperationsAreThoseOfTheManifest) {
#define JOURDAIN_COUNT_STEPS(ns)                                                                            \
  {                                                                                                         \
    std::ifstream file(JOURDAIN_STEPPERS "/" #ns "/" #ns ".json");                                          \
    const nlohmann::json stated = nlohmann::json::parse(file)["steps"];                                     \
    EXPECT_EQ(stated.size(), 7u) << #ns;                                                                    \
    const auto visit = [&](const std::string& name, int order, auto step, auto& history) {                  \
      auto state = ::ns::initial_state(::ns::Model<Counting>());                                            \
      ::ns::Input<Counting> input{};                                                                        \
      for (int i = 0; i < 2; ++i) step(state, input, Counting(1e-3), history);                              \
      counted = {};                                                                                         \
      step(state, input, Counting(1e-3), history);                                                          \
      const std::size_t folded = name == "rk5" ? kQuotientsOfRk5 : 0;                                       \
      EXPECT_EQ(counted.arithmetic() - folded, stated[name + "_step"]["operations"]) << #ns << " " << name; \
      EXPECT_EQ(stated[name + "_step"]["order"], order);                                                    \
    };                                                                                                      \
    JOURDAIN_VISIT_STEPPERS(ns, Counting, visit);                                                           \
  }
  JOURDAIN_COUNT_STEPS(crane_all)
  JOURDAIN_COUNT_STEPS(quadrotor_all)
  JOURDAIN_COUNT_STEPS(hoop_bead_all)
  JOURDAIN_COUNT_STEPS(cart_pole_all)
}

/// Positions after `duration` (s) in `steps` steps from the initial state.
template <class State, class Input, class Step, class History>
std::vector<long double> after(State state, const Input& input, long double duration, int steps, Step step,
                               History history) {
  for (int i = 0; i < steps; ++i) step(state, input, duration / steps, history);
  return {std::begin(state.y), std::end(state.y)};
}

long double distance(const std::vector<long double>& a, const std::vector<long double>& b) {
  long double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// Orders from the differences of four resolutions, extrapolated to steps of length zero. In long double, so that
/// rounding does not reach the fifth-order method.
template <class State, class Input, class Step, class History>
double measured_order(const State& state, const Input& input, long double duration, Step step,
                      const History& history) {
  std::vector<std::vector<long double>> ends;
  for (const int steps : {200, 400, 800, 1600})
    ends.push_back(after(state, input, duration, steps, step, history));
  const auto slope = [&ends](std::size_t i) {
    return std::log2(distance(ends[i], ends[i + 1]) / distance(ends[i + 1], ends[i + 2]));
  };
  return double(2 * slope(1) - slope(0));
}

TEST(Steppers, HaveTheirOrders){
#define JOURDAIN_CHECK_ORDERS(ns, duration)                                                               \
  {                                                                                                       \
    const auto visit = [&](const std::string& name, int order, auto step, auto& history) {                \
      const auto start = ::ns::initial_state(::ns::Model<long double>());                                 \
      const double measured = measured_order(start, ::ns::Input<long double>{}, duration, step, history); \
      EXPECT_NEAR(measured, order, 0.1) << #ns << " " << name;                                            \
    };                                                                                                    \
    JOURDAIN_VISIT_STEPPERS(ns, long double, visit);                                                      \
  }
    JOURDAIN_CHECK_ORDERS(crane_all, 6)  // quaternions, prescribed motion
    JOURDAIN_CHECK_ORDERS(hoop_bead_all, 0.5L)}

TEST(Steppers, KeepTheirOrdersWithSampledInputs) {
  const auto push = [](const cart_pole_all::State<long double>& state) {
    cart_pole_all::Input<long double> input;
    for (auto& u : input.u) u = 3 * std::sin(4 * state.t);
    return input;
  };
  const auto visit = [&](const std::string& name, int order, auto step, auto& history) {
    const auto start = cart_pole_all::initial_state(cart_pole_all::Model<long double>());
    EXPECT_NEAR(measured_order(start, push, 1, step, history), order, 0.1) << name;
  };
  JOURDAIN_VISIT_STEPPERS(cart_pole_all, long double, visit);
}

TEST(Steppers, SampledInputsThatDoNotChangeGiveTheBitsOfHeldOnes) {
  quadrotor_all::Input<> held{};
  for (int i = 0; i < quadrotor_all::Model<>::input_count; ++i) held.u[i] = 2 + i;
  const auto sampled = [&held](const quadrotor_all::State<>&) { return held; };
  const auto visit = [&](const std::string& name, int, auto step, auto& history) {
    auto first = quadrotor_all::initial_state(quadrotor_all::Model<>()), second = first;
    auto first_history = history, second_history = history;
    for (int i = 0; i < 10; ++i) {
      step(first, held, 1e-3, first_history);
      step(second, sampled, 1e-3, second_history);
    }
    for (int i = 0; i < 7; ++i) EXPECT_EQ(first.y[i], second.y[i]) << name;
  };
  JOURDAIN_VISIT_STEPPERS(quadrotor_all, double, visit);
}

TEST(Steppers, CopiesOfStateAndHistoryGoOnWithTheSameBits) {
  const crane_all::Model<> model;
  auto state = initial_state(model);
  crane_all::RateHistory<2> history;
  for (int i = 0; i < 5; ++i) adams_bashforth3_step(model, state, {}, 1e-3, history);
  auto copy = state;
  auto remembered = history;
  for (int i = 0; i < 5; ++i) adams_bashforth3_step(model, state, {}, 1e-3, history);
  for (int i = 0; i < 5; ++i) adams_bashforth3_step(model, copy, {}, 1e-3, remembered);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(state.y[i], copy.y[i]);
  EXPECT_NEAR(std::hypot(std::hypot(copy.y[0], copy.y[1]), std::hypot(copy.y[2], copy.y[3])), 1, 1e-15);
}

}  // namespace
}  // namespace jourdain::tests
