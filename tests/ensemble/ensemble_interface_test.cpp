// Ensembles through their table of C functions, against those of C++; the page's program is in page_test.cpp.
#include "jourdain/ensemble_interface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cart_pole_ensemble/cart_pole_ensemble_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "double_pendulum_packs/double_pendulum_packs_kernels.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "jourdain/draws.hpp"

JOURDAIN_ENSEMBLE(cart_pole_table, cart_pole_ensemble::Model, double)
JOURDAIN_ENSEMBLE(cart_pole_f_table, cart_pole_ensemble::Model, float)
JOURDAIN_ENSEMBLE(crane_table, crane_packs::Model, double)
JOURDAIN_ENSEMBLE(double_pendulum_table, double_pendulum_packs::Model, double)
JOURDAIN_ENSEMBLE(turned_double_pendulum_table, double_pendulum_packs::Model, double, jourdain::TurnedSines)
JOURDAIN_ENSEMBLE(four_bar_table, four_bar_packs::Model, double)

namespace jourdain::tests {
namespace {

constexpr std::size_t kStates = 7;
constexpr double kLength = 1e-3, kNan = std::numeric_limits<double>::quiet_NaN();

std::size_t numbers(int count) { return static_cast<std::size_t>(count); }

/// An ensemble of a table, and arrays for its numbers.
struct Tabled {
  const jourdain_ensemble* table;
  void* pointer;
  std::vector<double> t, y, z;

  explicit Tabled(const jourdain_ensemble* of, const double* parameters = nullptr)
      : table(of),
        pointer(of->create(kStates, parameters)),
        t(kStates),
        y(kStates * numbers(of->position_count)),
        z(kStates * numbers(of->velocity_count)) {
    read();
  }
  ~Tabled() { table->destroy(pointer); }
  Tabled(const Tabled&) = delete;
  Tabled& operator=(const Tabled&) = delete;

  void read() {
    EXPECT_EQ(table->get_states(pointer, 0, kStates, t.data(), y.data(), z.data()), JOURDAIN_OK);
  }
  jourdain_status write() { return table->set_states(pointer, 0, kStates, t.data(), y.data(), z.data()); }
  jourdain_status run(const std::string& stepper, std::size_t steps,
                      const jourdain_inputs* inputs = nullptr) {
    for (int k = 0; k < table->stepper_count; ++k)
      if (table->steppers[k] == stepper) return table->run(pointer, k, kLength, steps, 2, inputs);
    return JOURDAIN_WRONG_CALL;
  }
  std::vector<unsigned char> trusted() const {
    std::vector<unsigned char> result(kStates, 7);
    EXPECT_EQ(table->get_trusted(pointer, 0, kStates, result.data()), JOURDAIN_OK);
    return result;
  }
};

TEST(EnsembleInterface, SaysWhatTheModelHas) {
  const jourdain_ensemble& table = *cart_pole_table();
  EXPECT_EQ(table.version, JOURDAIN_ENSEMBLE_VERSION);
  EXPECT_EQ(table.real_bytes, 8);
  EXPECT_EQ(cart_pole_f_table()->real_bytes, 4);
  EXPECT_EQ(cart_pole_f_table()->lanes, 2 * table.lanes);
  EXPECT_EQ(table.position_count, 2);
  EXPECT_EQ(table.velocity_count, 2);
  EXPECT_EQ(table.input_count, 1);
  EXPECT_EQ(numbers(table.parameter_count), sizeof(cart_pole_ensemble::Parameters<>) / sizeof(double));
  std::vector<std::string> names(table.steppers, table.steppers + table.stepper_count);
  EXPECT_EQ(names, (std::vector<std::string>{"euler_step", "semi_implicit_euler_step", "heun_step",
                                             "rk4_step", "rk5_step"}));
  // Of a model that has no other step.
  EXPECT_EQ(crane_table()->stepper_count, 1);
  EXPECT_STREQ(crane_table()->steppers[0], "rk4_step");
}

TEST(EnsembleInterface, StepsWhatItIsGiven) {
  for (const char* stepper :
       {"euler_step", "semi_implicit_euler_step", "heun_step", "rk4_step", "rk5_step"}) {
    Tabled many(cart_pole_table());
    Ensemble<cart_pole_ensemble::Model> same(kStates);
    for (std::size_t k = 0; k < kStates; ++k) {
      auto state = same.state(k);
      EXPECT_EQ(state.y[1], many.y[2 * k + 1]);
      many.y[2 * k + 1] = state.y[1] = 0.1 * static_cast<double>(k);
      many.z[2 * k] = state.z[0] = normal(1, k, 0);
      same.set_state(k, state);
      const double push = normal(2, k, 0);
      same.set_input(k, {{push}});
      EXPECT_EQ(many.table->set_inputs(many.pointer, k, 1, &push), JOURDAIN_OK);
    }
    ASSERT_EQ(many.write(), JOURDAIN_OK);
    ASSERT_EQ(many.run(stepper, 20), JOURDAIN_OK);
    many.read();
    const std::string name = stepper;
    const auto run = [&same](const auto& method) { same.run(method, kLength, 20); };
    if (name == "euler_step") run(euler);
    if (name == "semi_implicit_euler_step") run(semi_implicit_euler);
    if (name == "heun_step") run(heun);
    if (name == "rk4_step") run(rk4);
    if (name == "rk5_step") run(rk5);
    for (std::size_t k = 0; k < kStates; ++k)
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(many.y[2 * k + i], same.state(k).y[i]) << name << k;
        EXPECT_EQ(many.z[2 * k + i], same.state(k).z[i]) << name << k;
      }
  }
}

TEST(EnsembleInterface, TurnsSinesWhereAsked) {
  Tabled many(turned_double_pendulum_table()), computed(double_pendulum_table());
  using Many = Ensemble<double_pendulum_packs::Model, double, natural_lanes<double>, TurnedSines>;
  Many same(kStates);
  double apart = 0;
  ASSERT_EQ(many.run("rk4_step", 200), JOURDAIN_OK);
  ASSERT_EQ(computed.run("rk4_step", 200), JOURDAIN_OK);
  many.read();
  computed.read();
  same.run(rk4, kLength, 200);
  for (std::size_t i = 0; i < many.z.size(); ++i) {
    EXPECT_EQ(many.z[i], same.state(i / 2).z[i % 2]) << i;
    apart = std::fmax(apart, std::fabs(many.z[i] - computed.z[i]));
  }
  EXPECT_GT(apart, 0);
  EXPECT_LT(apart, 1e-13);
}

TEST(EnsembleInterface, ReadsInputsByStateAndStep) {
  constexpr std::size_t steps = 9;
  std::vector<double> u;
  for (std::size_t i = 0; i < kStates * steps; ++i) u.push_back(normal(3, i, 0));
  const struct {
    std::size_t by_state, by_step;
  } cases[] = {{steps, 1}, {1, kStates}, {0, 1}, {steps, 0}, {0, 0}};
  for (const auto& [by_state, by_step] : cases) {
    Tabled many(cart_pole_table());
    const jourdain_inputs inputs = {u.data(), by_state, by_step};
    ASSERT_EQ(many.run("rk4_step", steps, &inputs), JOURDAIN_OK);
    many.read();
    const cart_pole_ensemble::Model<> model;
    for (std::size_t k = 0; k < kStates; ++k) {
      auto state = initial_state(model);
      for (std::size_t i = 0; i < steps; ++i)
        rk4_step(model, state, {{u[k * by_state + i * by_step]}}, kLength);
      EXPECT_EQ(many.z[2 * k], state.z[0]) << by_state << " " << by_step << " " << k;
      EXPECT_EQ(many.y[2 * k + 1], state.y[1]) << by_state << " " << by_step << " " << k;
    }
  }
}

TEST(EnsembleInterface, TakesParametersOfAllAndOfEach) {
  cart_pole_ensemble::Parameters<> long_pole;
  long_pole.pole_half_length = 2;
  const auto* all = reinterpret_cast<const double*>(&long_pole);  // numbers only
  Tabled many(cart_pole_table(), all);
  const cart_pole_ensemble::Parameters<> usual;
  ASSERT_EQ(many.table->set_parameters(many.pointer, 3, 1, reinterpret_cast<const double*>(&usual)),
            JOURDAIN_OK);
  for (std::size_t k = 0; k < kStates; ++k) many.y[2 * k + 1] = 0.3;
  ASSERT_EQ(many.write(), JOURDAIN_OK);
  ASSERT_EQ(many.run("rk4_step", 30), JOURDAIN_OK);
  many.read();
  for (std::size_t k = 0; k < kStates; ++k) {
    const cart_pole_ensemble::Model<> model(k == 3 ? usual : long_pole);
    auto state = initial_state(model);
    state.y[1] = 0.3;
    for (int i = 0; i < 30; ++i) rk4_step(model, state, {}, kLength);
    EXPECT_EQ(many.z[2 * k + 1], state.z[1]) << k;
  }
}

TEST(EnsembleInterface, KeepsTime) {
  Tabled many(crane_table());
  for (std::size_t k = 0; k < kStates; ++k) many.t[k] = 10.0 * static_cast<double>(k);
  ASSERT_EQ(many.write(), JOURDAIN_OK);
  ASSERT_EQ(many.run("rk4_step", 1000), JOURDAIN_OK);
  many.read();
  for (std::size_t k = 0; k < kStates; ++k) EXPECT_EQ(many.t[k], 10.0 * static_cast<double>(k) + 1);
  EXPECT_EQ(many.table->get_states(many.pointer, 0, kStates, nullptr, many.y.data(), many.z.data()),
            JOURDAIN_WRONG_CALL);
  EXPECT_EQ(many.table->set_states(many.pointer, 0, kStates, nullptr, many.y.data(), many.z.data()),
            JOURDAIN_WRONG_CALL);
}

TEST(EnsembleInterface, NeedsNeitherTimesNorInputsOfAModelWithout) {
  Tabled many(double_pendulum_table());
  EXPECT_EQ(many.table->input_count, 0);
  const auto get = [&many] {
    return many.table->get_states(many.pointer, 0, kStates, nullptr, many.y.data(), many.z.data());
  };
  for (std::size_t k = 0; k < kStates; ++k) many.z[2 * k] = 0.1 * static_cast<double>(k);
  ASSERT_EQ(many.table->set_states(many.pointer, 0, kStates, nullptr, many.y.data(), many.z.data()),
            JOURDAIN_OK);
  EXPECT_EQ(many.table->set_inputs(many.pointer, 0, kStates, nullptr), JOURDAIN_OK);
  const jourdain_inputs none = {nullptr, 0, 0};
  ASSERT_EQ(many.run("rk4_step", 40, &none), JOURDAIN_OK);
  ASSERT_EQ(get(), JOURDAIN_OK);
  const double_pendulum_packs::Model<> model;
  for (std::size_t k = 0; k < kStates; ++k) {
    auto state = initial_state(model);
    state.z[0] = 0.1 * static_cast<double>(k);
    for (int i = 0; i < 40; ++i) rk4_step(model, state, {}, kLength);
    EXPECT_EQ(many.y[2 * k + 1], state.y[1]) << k;
    EXPECT_EQ(many.t[k], 0);
  }
}

TEST(EnsembleInterface, SaysWhichStatesAreNotToBeTrusted) {
  Tabled open(four_bar_table());
  open.y[numbers(open.table->position_count) * 4 + 1] += 2.0;
  ASSERT_EQ(open.write(), JOURDAIN_OK);
  ASSERT_EQ(open.run("rk4_step", 3), JOURDAIN_OK);
  Tabled fast(cart_pole_table());
  fast.z[2 * 4 + 1] = 1e200;
  ASSERT_EQ(fast.write(), JOURDAIN_OK);
  ASSERT_EQ(fast.run("rk4_step", 3), JOURDAIN_OK);
  for (std::size_t k = 0; k < kStates; ++k) {
    EXPECT_EQ(open.trusted()[k], k != 4) << k;
    EXPECT_EQ(fast.trusted()[k], k != 4) << k;
  }
}

TEST(EnsembleInterface, RefusesWhatCannotBeMeant) {
  const jourdain_ensemble& table = *cart_pole_table();
  EXPECT_EQ(table.create(0, nullptr), nullptr);
  EXPECT_EQ(table.create(std::numeric_limits<std::size_t>::max(), nullptr), nullptr);
  const std::vector<double> wrong(numbers(table.parameter_count), kNan);
  EXPECT_EQ(table.create(3, wrong.data()), nullptr);
  table.destroy(nullptr);

  Tabled many(&table);
  const std::vector<double> before = many.y;
  double u = 1;
  unsigned char trusted = 7;
  EXPECT_EQ(table.set_parameters(many.pointer, 0, 1, wrong.data()), JOURDAIN_NOT_FINITE);
  EXPECT_EQ(table.set_inputs(many.pointer, kStates, 1, &u), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.set_inputs(many.pointer, 1, std::numeric_limits<std::size_t>::max(), &u),
            JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.set_inputs(many.pointer, 0, 1, nullptr), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.set_inputs(nullptr, 0, 1, &u), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.set_inputs(many.pointer, 0, 1, wrong.data()), JOURDAIN_NOT_FINITE);
  EXPECT_EQ(table.get_trusted(many.pointer, kStates, 1, &trusted), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(trusted, 7);
  EXPECT_EQ(table.run(many.pointer, table.stepper_count, kLength, 1, 1, nullptr), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.run(many.pointer, -1, kLength, 1, 1, nullptr), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.run(many.pointer, 0, kNan, 1, 1, nullptr), JOURDAIN_NOT_FINITE);
  const jourdain_inputs without = {nullptr, 0, 0}, not_finite = {wrong.data(), 0, 0};
  EXPECT_EQ(table.run(many.pointer, 0, kLength, 1, 1, &without), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.run(many.pointer, 0, kLength, 1, 1, &not_finite), JOURDAIN_NOT_FINITE);
  many.y[2 * 5] = kNan;
  EXPECT_EQ(many.write(), JOURDAIN_NOT_FINITE);
  many.read();
  EXPECT_EQ(many.y, before);
}

/// As the model keeps them.
TEST(EnsembleInterface, OfFloatsTakesNoNumberThatFloatHasNoRoomFor) {
  constexpr double large = 1e39, small = 1e-50;
  const jourdain_ensemble& table = *cart_pole_f_table();
  std::vector<double> parameters(numbers(table.parameter_count), 1);
  parameters.back() = large;
  EXPECT_EQ(table.create(kStates, parameters.data()), nullptr);
  Tabled many(&table);
  const std::vector<double> before = many.y;
  EXPECT_EQ(table.set_parameters(many.pointer, 0, 1, parameters.data()), JOURDAIN_NOT_FINITE);
  EXPECT_EQ(table.set_inputs(many.pointer, 0, 1, &large), JOURDAIN_NOT_FINITE);
  const jourdain_inputs inputs = {&large, 0, 0};
  EXPECT_EQ(table.run(many.pointer, 0, kLength, 1, 1, &inputs), JOURDAIN_NOT_FINITE);
  EXPECT_EQ(table.run(many.pointer, 0, large, 1, 1, nullptr), JOURDAIN_NOT_FINITE);
  EXPECT_EQ(table.run(many.pointer, 0, small, 1, 1, nullptr), JOURDAIN_WRONG_CALL);
  EXPECT_EQ(table.run(many.pointer, 0, 0, 1, 1, nullptr), JOURDAIN_OK);
  many.y[2 * 5] = large;
  EXPECT_EQ(many.write(), JOURDAIN_NOT_FINITE);
  many.read();
  EXPECT_EQ(many.y, before);
  Tabled of_double(cart_pole_table());
  EXPECT_EQ(of_double.table->run(of_double.pointer, 0, small, 1, 1, nullptr), JOURDAIN_OK);
}

}  // namespace
}  // namespace jourdain::tests
