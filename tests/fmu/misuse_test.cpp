// Wrong calls: an error, one line in the log, and nothing done.
#include <dlfcn.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fmu/importer.hpp"

namespace jourdain::tests {
namespace {

constexpr double kNan = NAN;

class Misuse : public testing::TestWithParam<int> {
 protected:
  Fmu fmu_{make_fmu("cart_pole", GetParam(), "--step 0.001")};

  /// The call answers kError, says why in one line, and changes no output.
  void expect_refused(Instance& instance, const std::function<int()>& call, const char* what) {
    const std::size_t lines = instance.log().size();
    const References outputs = fmu_.structure("Outputs");
    Numbers before, after;
    const int could_read = instance.get(outputs, before);
    const std::size_t more = instance.log().size() - lines;
    EXPECT_EQ(call(), kError) << what;
    ASSERT_EQ(instance.log().size(), lines + more + 1) << what;
    EXPECT_FALSE(instance.log().back().empty()) << what;
    EXPECT_EQ(instance.get(outputs, after), could_read) << what;
    EXPECT_EQ(before, after) << what;
  }
};

TEST_P(Misuse, OfTheOrderOfCallsInCoSimulation) {
  Instance one(fmu_, false);
  Numbers x(4);
  void* none = nullptr;
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  refused([&] { return one.step(0, 0.01); }, "step before the start");
  refused([&] { return one.exit_initialization(); }, "exit before enter");
  refused([&] { return one.terminate(); }, "terminate before the start");
  ASSERT_EQ(one.enter_initialization(), kOk);
  refused([&] { return one.enter_initialization(); }, "enter twice");
  refused([&] { return one.step(0, 0.01); }, "step while initializing");
  ASSERT_EQ(one.exit_initialization(), kOk);
  refused([&] { return one.exit_initialization(); }, "exit twice");
  refused([&] { return one.set("hinge", 1); }, "a start value after the initialization");
  refused([&] { return one.set_time(1); }, "time in co-simulation");
  refused([&] { return one.set_states(x); }, "states in co-simulation");
  refused([&] { return one.get_rates(x); }, "derivatives in co-simulation");
  refused([&] { return one.enter_event(); }, "event mode");
  refused([&] { return one.enter_continuous(); }, "continuous-time mode");
  refused([&] { return one.step(0.5, 0.01); }, "another time");
  refused([&] { return one.step(0, 0); }, "no step");
  refused([&] { return one.step(0, -0.01); }, "a step back");
  refused([&] { return one.step(0, kNan); }, "no number");
  refused([&] { return one.step(0, 1e30); }, "endless");
  refused([&] { return one.restore(none); }, "no state");
  ASSERT_EQ(one.step(0, 0.01), kOk);
  ASSERT_EQ(one.terminate(), kOk);
  refused([&] { return one.step(0.01, 0.01); }, "step after the end");
  refused([&] { return one.set("push", 1); }, "an input after the end");
  ASSERT_EQ(one.reset(), kOk);
  one.start();
  ASSERT_EQ(one.step(0, 0.01), kOk);
}

TEST_P(Misuse, OfTheOrderOfCallsInModelExchange) {
  Instance one(fmu_, true);
  Numbers x(4), few(3);
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  bool flag = false;
  refused([&] { return one.set_states(x); }, "states before the start");
  refused([&] { return one.enter_continuous(); }, "continuous-time mode before the start");
  one.start();
  refused([&] { return one.step(0, 0.01); }, "a step");
  refused([&] { return one.update(flag); }, "an update outside event mode");
  refused([&] { return one.set_states(few); }, "too few states");
  refused([&] { return one.get_rates(few); }, "too few derivatives");
  refused([&] { return one.set_time(INFINITY); }, "no time");
  refused([&] { return one.set("pole_mass", 1); }, "a parameter in continuous-time mode");
  x[2] = kNan;
  refused([&] { return one.set_states(x); }, "states that are no numbers");
}

TEST_P(Misuse, OfReferencesAndValues) {
  Instance one(fmu_, false);
  ASSERT_EQ(one.enter_initialization(), kOk);
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  Numbers values;
  const unsigned beyond = fmu_.reference("");
  refused([&] { return one.get({0, beyond}, values); }, "an unknown reference");
  refused([&] { return one.get({0xffffffffu}, values); }, "an unknown reference");
  refused([&] { return one.set(References{beyond}, Numbers{1}); }, "an unknown reference");
  for (const double wrong : {kNan, double(INFINITY), -double(INFINITY)}) {
    refused([&] { return one.set("hinge", wrong); }, "a start that is no number");
    refused([&] { return one.set("push", wrong); }, "an input that is no number");
    refused([&] { return one.set("pole_mass", wrong); }, "a parameter that is no number");
    refused(
        [&] {
          return one.set({fmu_.reference("slide"), fmu_.reference("hinge")}, {0.5, wrong});
        },
        "one of two");
  }
  for (const char* fixed : {"time", "der(hinge)", "gravity[2]"})
    refused([&] { return one.set(fixed, 1); }, "what cannot be set");
  EXPECT_EQ(one.get({}, values), kOk);
  EXPECT_EQ(one.set(References{}, {}), kOk);
}

TEST_P(Misuse, OfPointers) {
  Instance one(fmu_, false);
  one.start();
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  const unsigned reference = 1;
  double value = 0;
  if (GetParam() == 2) {
    auto* get = fmu_.function<decltype(fmi2GetReal)>("fmi2GetReal");
    auto* set = fmu_.function<decltype(fmi2SetReal)>("fmi2SetReal");
    refused([&] { return get(one.handle(), nullptr, 1, &value); }, "references");
    refused([&] { return get(one.handle(), &reference, 1, nullptr); }, "values");
    refused([&] { return set(one.handle(), nullptr, 1, &value); }, "references");
    refused([&] { return set(one.handle(), &reference, 1, nullptr); }, "values");
    refused(
        [&] { return fmu_.function<decltype(fmi2GetFMUstate)>("fmi2GetFMUstate")(one.handle(), nullptr); },
        "state");
    EXPECT_EQ(get(nullptr, &reference, 1, &value), fmi2Error);
    EXPECT_EQ(fmu_.function<decltype(fmi2DoStep)>("fmi2DoStep")(nullptr, 0, 0.01, 1), fmi2Error);
    EXPECT_EQ(fmu_.function<decltype(fmi2Reset)>("fmi2Reset")(nullptr), fmi2Error);
    fmu_.function<decltype(fmi2FreeInstance)>("fmi2FreeInstance")(nullptr);
    return;
  }
  auto* get = fmu_.function<decltype(fmi3GetFloat64)>("fmi3GetFloat64");
  auto* step = fmu_.function<decltype(fmi3DoStep)>("fmi3DoStep");
  refused([&] { return get(one.handle(), nullptr, 1, &value, 1); }, "references");
  refused([&] { return get(one.handle(), &reference, 1, nullptr, 1); }, "values");
  refused([&] { return get(one.handle(), &reference, 1, &value, 2); }, "more values than variables");
  refused([&] { return step(one.handle(), 0, 0.01, true, nullptr, nullptr, nullptr, nullptr); }, "flags");
  EXPECT_EQ(get(nullptr, &reference, 1, &value, 1), fmi3Error);
  EXPECT_EQ(fmu_.function<decltype(fmi3Reset)>("fmi3Reset")(nullptr), fmi3Error);
  fmu_.function<decltype(fmi3FreeInstance)>("fmi3FreeInstance")(nullptr);
}

TEST_P(Misuse, OfNamesAndTokens) {
  Instance other(fmu_, false, "one", "{00000000-0000-0000-0000-000000000000}");
  EXPECT_FALSE(other.handle());
  EXPECT_EQ(other.log().size(), 1u);
  Instance nameless(fmu_, true, "");
  EXPECT_FALSE(nameless.handle());
  EXPECT_EQ(nameless.log().size(), 1u);
}

TEST_P(Misuse, OfSavedStates) {
  Instance one(fmu_, false), exchange(fmu_, true);
  one.start();
  exchange.start();
  void *state = nullptr, *copy = nullptr;
  ASSERT_EQ(one.save(state), kOk);
  std::vector<char> bytes;
  ASSERT_EQ(one.serialize(state, bytes), kOk);
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  for (const std::size_t at : {std::size_t(0), bytes.size() / 2, bytes.size() - 1}) {
    std::vector<char> wrong = bytes;
    wrong[at] = static_cast<char>(wrong[at] ^ 1);
    refused([&] { return one.deserialize(wrong, copy); }, "bytes that changed");
    EXPECT_EQ(copy, nullptr);
  }
  refused([&] { return one.deserialize(std::vector<char>(bytes.begin(), bytes.end() - 1), copy); },
          "too few bytes");
  EXPECT_EQ(exchange.restore(state), kError);
  EXPECT_EQ(exchange.deserialize(bytes, copy), kError);
  EXPECT_EQ(one.restore(state), kOk);
  EXPECT_EQ(one.free_state(state), kOk);
  EXPECT_EQ(one.free_state(state), kOk);  // of a null pointer: nothing
}

TEST_P(Misuse, OfDerivatives) {
  Instance one(fmu_, true);
  one.start();
  const auto refused = [&](const std::function<int()>& call, const char* what) {
    expect_refused(one, call, what);
  };
  const unsigned rate = fmu_.reference("der(hinge_velocity)"), hinge = fmu_.reference("hinge");
  Numbers result;
  refused(
      [&] {
        return one.directional({{rate}, {fmu_.reference("pole_mass")}, {1}}, result);
      },
      "by a parameter");
  refused([&] { return one.directional({{fmu_.reference("push")}, {hinge}, {1}}, result); }, "of an input");
  refused([&] { return one.directional({{rate}, {hinge}, {kNan}}, result); }, "a seed that is no number");
  refused(
      [&] {
        return one.directional({{rate}, {fmu_.reference("")}, {1}}, result);
      },
      "an unknown reference");
}

/// Stop times bind; what a step says where numbers overflow, and that it leaves the instance at the time before.
TEST_P(Misuse, OfStepsThatCannotBeMade) {
  Instance one(fmu_, false);
  ASSERT_EQ(one.enter_initialization(0, true, 0.015), kOk);
  ASSERT_EQ(one.exit_initialization(), kOk);
  ASSERT_EQ(one.step(0, 0.01), kOk);
  expect_refused(
      one, [&] { return one.step(0.01, 0.01); }, "beyond the stop time");
  Instance fast(fmu_, false);
  ASSERT_EQ(fast.set("hinge_velocity", 1e200), kOk);
  fast.start();
  EXPECT_EQ(fast.step(0, 0.01), kDiscard);
  EXPECT_EQ(fast.log().size(), 1u);
  EXPECT_EQ(fast.value("time"), 0);
  EXPECT_EQ(fast.value("hinge_velocity"), 1e200);
}

INSTANTIATE_TEST_SUITE_P(Versions, Misuse, testing::Values(2, 3));

TEST(Quaternions, AtTheStartHaveNearlyTheNormOne) {
  const Fmu fmu(make_fmu("quadrotor", 2, "--step 0.001"));
  Instance far(fmu, false), near(fmu, false);
  ASSERT_EQ(far.set("root_qx", 1), kOk);
  ASSERT_EQ(far.enter_initialization(), kOk);
  EXPECT_EQ(far.exit_initialization(), kError);
  ASSERT_EQ(near.set("root_qw", 1.0005), kOk);
  ASSERT_EQ(near.enter_initialization(), kOk);
  ASSERT_EQ(near.exit_initialization(), kOk);
  EXPECT_EQ(near.log().size(), 1u);  // it was moved to the norm one
  const double w = near.value("root_qw"), x = near.value("root_qx");
  EXPECT_NEAR(w * w + x * x, 1, 1e-15);
}

}  // namespace
}  // namespace jourdain::tests
