// Every stepper on emitted models: operations, orders, sampled inputs, memory that the caller owns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>

#include "cart_pole_all/cart_pole_all_kernels.hpp"
#include "crane_all/crane_all_kernels.hpp"
#include "crane_applied/crane_applied_kernels.hpp"
#include "embed/counting.hpp"
#include "embed/pack.hpp"
#include "flyball_governor_all/flyball_governor_all_kernels.hpp"
#include "flyball_governor_applied/flyball_governor_applied_kernels.hpp"
#include "hoop_bead_all/hoop_bead_all_kernels.hpp"
#include "quadrotor_all/quadrotor_all_kernels.hpp"
#include "rocking_four_bar_all/rocking_four_bar_all_kernels.hpp"
#include "spring_four_bar_all/spring_four_bar_all_kernels.hpp"
#include "steppers/dual.hpp"
#include "steppers/measured_order.hpp"
#include "steppers/visit_steppers.hpp"

namespace jourdain::tests {
namespace {

template <class State>
concept HasClock = requires(State state) {
  state.t;
};

/// Quotients of literals in the template of rk5, which compilers fold: the counting type cannot. Four move the time.
template <class State>
constexpr std::size_t kQuotientsOfRk5 = HasClock<State> ? 24 : 20;

TEST(Steppers, OperationsAreThoseOfTheManifest){
#define JOURDAIN_COUNT_STEPS(ns)                                                                            \
  {                                                                                                         \
    std::ifstream file(JOURDAIN_STEPPERS "/" #ns "/" #ns ".json");                                          \
    const nlohmann::json stated = nlohmann::json::parse(file)["steps"];                                     \
    EXPECT_EQ(stated.size(), 11u) << #ns;                                                                   \
    const auto visit = [&](const std::string& name, int order, auto step, auto& history) {                  \
      auto state = ::ns::initial_state(::ns::Model<Counting>());                                            \
      ::ns::Input<Counting> input{};                                                                        \
      for (int i = 0; i < 2; ++i) step(state, input, Counting(1e-3), history);                              \
      counted = {};                                                                                         \
      step(state, input, Counting(1e-3), history);                                                          \
      const std::size_t folded = name == "rk5" ? kQuotientsOfRk5<decltype(state)> : 0;                      \
      EXPECT_EQ(counted.arithmetic() - folded, stated[name + "_step"]["operations"]) << #ns << " " << name; \
      EXPECT_EQ(stated[name + "_step"]["order"], order);                                                    \
    };                                                                                                      \
    JOURDAIN_VISIT_STEPPERS(ns, Counting, visit);                                                           \
  }
    JOURDAIN_COUNT_STEPS(quadrotor_all) JOURDAIN_COUNT_STEPS(cart_pole_all)
        JOURDAIN_COUNT_STEPS(flyball_governor_all) JOURDAIN_COUNT_STEPS(spring_four_bar_all)
            JOURDAIN_COUNT_STEPS(rocking_four_bar_all)}

TEST(Steppers, HaveTheirOrders){
#define JOURDAIN_CHECK_ORDERS(ns, duration, fewest)                                           \
  {                                                                                           \
    const auto visit = [&](const std::string& name, int order, auto step, auto& history) {    \
      const auto start = ::ns::initial_state(::ns::Model<long double>());                     \
      const double measured =                                                                 \
          measured_order(start, ::ns::Input<long double>{}, duration, step, history, fewest); \
      EXPECT_NEAR(measured, order, 0.1) << #ns << " " << name;                                \
    };                                                                                        \
    JOURDAIN_VISIT_STEPPERS(ns, long double, visit);                                          \
  }
    JOURDAIN_CHECK_ORDERS(crane_all, 6, 200)            // quaternions, prescribed motion
    JOURDAIN_CHECK_ORDERS(hoop_bead_all, 0.5L, 200)     // a curve
    JOURDAIN_CHECK_ORDERS(spring_four_bar_all, 2, 200)  // dependent coordinates by Newton's method
    // Multipliers, through a dead position. Rounding is seen in short steps of the fifth order: 1e-17 of 3e-16.
    JOURDAIN_CHECK_ORDERS(rocking_four_bar_all, 0.16L, order < 5 ? 200 : 100)}

TEST(Steppers, OfMechanismsWithMultipliersGiveTheBitsOfDoubleInPacks) {
  const auto ends = [](auto real) {
    using Real = decltype(real);
    std::vector<Real> values;
    const auto visit = [&values](const std::string&, int, auto step, auto& history) {
      auto state = rocking_four_bar_all::initial_state(rocking_four_bar_all::Model<Real>());
      for (int i = 0; i < 20; ++i) step(state, rocking_four_bar_all::Input<Real>{}, Real(1e-3), history);
      values.insert(values.end(), std::begin(state.y), std::end(state.y));
      values.insert(values.end(), {state.regularity, state.opening});
    };
    JOURDAIN_VISIT_STEPPERS(rocking_four_bar_all, Real, visit);
    return values;
  };
  const std::vector<double> one = ends(0.0);
  const std::vector<Pack> four = ends(Pack());
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (const double lane : four[i].v) EXPECT_EQ(lane, one[i]) << i;
}

TEST(Steppers, OfWMethodsKeepTheirReducedOrdersWhenDerivativesLeaveTermsOut) {
  const crane_applied::Model<long double> model;
  const auto order = [&](auto step) {
    return measured_order(
        crane_applied::initial_state(model), crane_applied::Input<long double>{}, 6,
        [&](auto& state, const auto& input, long double h, auto& memory) {
          step(model, state, input, h, memory);
        },
        crane_applied::Accelerations<long double>{});
  };
  EXPECT_NEAR(order([](auto&... a) { crane_applied::linearly_implicit_euler_step(a...); }), 1, 0.1);
  EXPECT_NEAR(order([](auto&... a) { crane_applied::ros34pw2_step(a...); }), 3, 0.1);
  EXPECT_NEAR(order([](auto&... a) { crane_applied::rosw43_step(a...); }), 3, 0.1);
}

TEST(Steppers, WithDerivativesOfAppliedForcesTakeFewerOperations) {
  const auto steps = [](const std::string& name) {
    std::ifstream file(JOURDAIN_STEPPERS "/" + name + "/" + name + ".json");
    return nlohmann::json::parse(file)["steps"];
  };
  const auto all = steps("flyball_governor_all"), applied = steps("flyball_governor_applied");
  for (const char* step : {"linearly_implicit_euler_step", "ros34pw2_step", "rosw43_step"})
    EXPECT_LT(applied[step]["operations"], all[step]["operations"]) << step;
  EXPECT_EQ(all["rosw43_step"]["order"], 4);
  EXPECT_EQ(applied["rosw43_step"]["order"], 3);
}

TEST(Steppers, KeepTheirOrdersWithSampledInputs) {
  const auto push = [](const cart_pole_all::State<long double>& state) {
    cart_pole_all::Input<long double> input;
    for (auto& u : input.u) u = 3 * std::sin(4 * static_cast<long double>(state.t));
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

/// Whoever gives inputs may look at the state that is stepped: it is that of the step's start, whatever the stage.
TEST(Steppers, LeaveTheStateUntilAllInputsAreAskedFor){
#define JOURDAIN_LOOK_AT_THE_STATE(ns)                                                      \
  {                                                                                         \
    const auto visit = [](const std::string& name, int, auto step, auto& history) {         \
      auto state = ::ns::initial_state(::ns::Model<>());                                    \
      for (auto& z : state.z) z += 0.5;                                                     \
      for (int i = 0; i < 3; ++i) {                                                         \
        const auto start = state;                                                           \
        int asked = 0;                                                                      \
        const auto look = [&](const ::ns::State<>&) {                                       \
          ++asked;                                                                          \
          EXPECT_TRUE(std::equal(std::begin(start.y), std::end(start.y), state.y)) << name; \
          EXPECT_TRUE(std::equal(std::begin(start.z), std::end(start.z), state.z)) << name; \
          ::ns::Input<> input{};                                                            \
          input.u[0] = 1;                                                                   \
          return input;                                                                     \
        };                                                                                  \
        step(state, look, 1e-3, history);                                                   \
        EXPECT_GE(asked, 1) << name;                                                        \
        EXPECT_FALSE(std::equal(std::begin(start.y), std::end(start.y), state.y)) << name;  \
      }                                                                                     \
    };                                                                                      \
    JOURDAIN_VISIT_STEPPERS(ns, double, visit);                                             \
  }
    JOURDAIN_LOOK_AT_THE_STATE(cart_pole_all) JOURDAIN_LOOK_AT_THE_STATE(quadrotor_all)}

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

/// Largest difference between the lower half of A and dual numbers through forward_dynamics; displacements of the
/// quaternion whose w is y[quaternion] (negative: none) and whose angular velocity begins at z[spin] are small
/// rotations.
template <int quaternion, int spin, template <class> class Model, template <class> class State,
          template <class> class Input>
double linearisation_error(State<double> state, const Input<Dual>& input) {
  constexpr int nz = Model<double>::velocity_count;
  typename Model<double>::Linearization linear;
  Input<double> held{};
  if constexpr (Model<double>::input_count > 0)
    for (int i = 0; i < Model<double>::input_count; ++i) held.u[i] = input.u[i].value;
  linearize(Model<double>(), state, held, linear);
  double worst = 0;
  for (int c = 0; c < 2 * nz; ++c) {
    State<Dual> dual;
    if constexpr (requires { state.t; }) dual.t = Dual(static_cast<double>(state.t));
    for (int i = 0; i < Model<double>::position_count; ++i) dual.y[i] = Dual(state.y[i]);
    for (int i = 0; i < nz; ++i) dual.z[i] = Dual(state.z[i], i + nz == c ? 1 : 0);
    if (c < nz && (quaternion < 0 || c < spin || c >= spin + 3)) dual.y[c].slope = 1;
    if constexpr (quaternion >= 0) {
      const double* q = state.y + quaternion;
      const double by[3][4] = {
          {-q[1], q[0], q[3], -q[2]}, {-q[2], -q[3], q[0], q[1]}, {-q[3], q[2], -q[1], q[0]}};
      if (c >= spin && c < spin + 3)
        for (int k = 0; k < 4; ++k) dual.y[quaternion + k].slope = by[c - spin][k] / 2;
    }
    Dual zdot[nz];
    forward_dynamics(Model<Dual>(), dual, input, zdot);
    for (int i = 0; i < nz; ++i) worst = std::max(worst, std::fabs(linear.A[nz + i][c] - zdot[i].slope));
  }
  return worst;
}

TEST(Linearize, AgreesWithDualNumbersThroughForwardDynamics) {
  auto quadrotor = quadrotor_all::initial_state(quadrotor_all::Model<>());
  for (int i = 0; i < 6; ++i) quadrotor.z[i] = 0.3 * i - 0.7;
  quadrotor_all::Input<Dual> thrust{};
  for (auto& u : thrust.u) u = Dual(2.5);
  EXPECT_LE((linearisation_error<3, 3, quadrotor_all::Model, quadrotor_all::State>(quadrotor, thrust)),
            1e-11);
  auto crane = crane_all::initial_state(crane_all::Model<>());
  for (int i = 0; i < 3; ++i) crane.z[i] = 0.4 - 0.3 * i;
  EXPECT_LE((linearisation_error<0, 0, crane_all::Model, crane_all::State>(crane, crane_all::Input<Dual>{})),
            1e-12);
  const auto bead = hoop_bead_all::initial_state(hoop_bead_all::Model<>());
  EXPECT_LE((linearisation_error<-1, 0, hoop_bead_all::Model, hoop_bead_all::State>(
                bead, hoop_bead_all::Input<Dual>{})),
            1e-12);
}

TEST(Linearize, LetsDisplacementsOfAQuaternionTurnWithTheBody) {
  auto state = crane_all::initial_state(crane_all::Model<>());
  for (int i = 0; i < 3; ++i) state.z[i] = 1 + i;
  crane_all::Linearization<> linear;
  linearize(crane_all::Model<>(), state, {}, linear);
  const double upper[3][6] = {{0, 3, -2, 1, 0, 0}, {-3, 0, 1, 0, 1, 0}, {2, -1, 0, 0, 0, 1}};  // −[ω], 1
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j) EXPECT_EQ(linear.A[i][j], upper[i][j]) << i << j;
}

}  // namespace
}  // namespace jourdain::tests
