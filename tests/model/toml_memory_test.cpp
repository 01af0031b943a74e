// [[memory]] as it is read: what it is sampled to, when, and which states it takes.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "model/coordinates.hpp"
#include "model/read/read.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::model {
namespace {

Mechanism memory_file(const std::string& path) {
  support::Diagnostics diagnostics(path, support::read_file(path));
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

Mechanism memory_scene(const std::string& more) {
  support::Diagnostics diagnostics("scene.toml", R"toml([model]
name = "scene"
[parameters]
tick = { value = 0.01, unit = "s" }
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
)toml" + more);
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

/// Names of the states and their values, the slide's place, and steps of one length.
class SampledRun {
 public:
  SampledRun(Mechanism mechanism, double h)
      : mechanism_(std::move(mechanism)), h_(h), parameters_(default_values(mechanism_)) {
    for (const StateVariable& state : mechanism_.states)
      states_.push_back(state.initial.evaluate<double>(parameters_));
  }

  double place = 0;

  void step() {
    std::vector<double> next = states_;
    for (std::size_t i = 0; i < next.size(); ++i)
      if (mechanism_.states[i].sampled) next[i] = value(*mechanism_.states[i].sampled);
    states_ = next;
  }

  double operator[](const std::string& name) const {
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (mechanism_.states[i].name == name) return states_[i];
    ADD_FAILURE() << name;
    return 0;
  }

 private:
  double value(const Expression& expression) const {
    return expression.evaluate<double>(
        std::span<const double>(parameters_), [](double v) { return v; },
        [this](const Variable& v) {
          if (v.kind == Variable::Kind::kState) return states_[v.index];
          if (v.kind == Variable::Kind::kStepLength) return h_;
          EXPECT_EQ(int(v.kind), int(Variable::Kind::kPosition));
          return place;
        });
  }

  Mechanism mechanism_;
  double h_;
  std::vector<double> parameters_, states_;
};

constexpr const char* kHeld = R"toml([[memory]]
name = "held"
unit = "m"
initial = 7
update = "slide"
period = "tick"
)toml";

TEST(TomlMemory, IsAStateWithoutRateAndATimer) {
  const Mechanism m = memory_scene(kHeld);
  ASSERT_EQ(m.states.size(), 2u);
  EXPECT_EQ(m.states[0].name, "held");
  EXPECT_EQ(m.states[0].initial.constant(), 7);
  EXPECT_EQ(m.states[0].nominal.constant(), 7);
  EXPECT_TRUE(m.states[0].rate.is_zero());
  EXPECT_EQ(m.states[1].name, "held_timer");
  EXPECT_EQ(m.states[1].unit, "s");
  EXPECT_TRUE(m.states[1].rate.is_zero());
  EXPECT_TRUE(m.states[1].period);
}

TEST(TomlMemory, IsSampledAtTheStartAndThenEveryPeriod) {
  SampledRun run(memory_scene(kHeld), 0.0025);  // four steps a sample
  for (int n = 0; n < 4000; ++n) {
    run.place = n;
    run.step();
    EXPECT_EQ(run["held"], n - n % 4) << n;
  }
}

/// 0.01 is seven steps of no binary number, a million steps: samples do not move off.
TEST(TomlMemory, KeepsItsTimesOverManySteps) {
  SampledRun run(memory_scene(kHeld), 0.01 / 7);
  for (int n = 0; n < 1000000; ++n) {
    run.place = n;
    run.step();
    ASSERT_EQ(run["held"], n - n % 7) << n;
  }
}

/// As often as there are periods, each within half a step of its time.
TEST(TomlMemory, TakesTheStepsThatBeginNearestToItsTimes) {
  const double h = 0.0037;
  SampledRun run(memory_scene(kHeld), h);
  int samples = 0;
  for (int n = 0; n < 10000; ++n) {
    run.place = n;
    run.step();
    if (run["held"] != n) continue;
    EXPECT_LE(std::fabs(n * h - samples * 0.01), h / 2 * (1 + 1e-9)) << n;
    ++samples;
  }
  EXPECT_EQ(samples, 3700);
}

/// Steps longer than a period: each is a sample, and none is made up for afterwards.
TEST(TomlMemory, OwesNoSamples) {
  SampledRun slow(memory_scene(kHeld), 0.05);
  for (int n = 0; n < 1000; ++n) {
    slow.place = n;
    slow.step();
    EXPECT_EQ(slow["held"], n);
  }
  EXPECT_GE(slow["held_timer"], -0.0251);
}

TEST(TomlMemory, WithoutPeriodIsSampledAtEveryStep) {
  const Mechanism m = memory_scene(R"toml([[memory]]
name = "count"
update = "count + 1"
period = 0
)toml");
  ASSERT_EQ(m.states.size(), 1u);
  SampledRun run(m, 0.3);
  for (int n = 0; n < 10; ++n) run.step();
  EXPECT_EQ(run["count"], 10);
}

TEST(TomlMemory, LagsBySamples) {
  SampledRun run(memory_scene(R"toml([[memory]]
name = "late"
initial = -1
update = "slide"
period = 0.02
delay = 3
)toml"),
                 0.01);
  for (int n = 0; n < 100; ++n) {
    run.place = n;
    run.step();
    const int sample = n - n % 2 - 6;
    EXPECT_EQ(run["late"], sample < 0 ? -1 : sample) << n;
  }
}

/// Each by what was before: none sees the other's new value.
TEST(TomlMemory, AreSampledAtOnce) {
  SampledRun run(memory_scene(R"toml([[memory]]
name = "first"
initial = 1
update = "second"
period = 0
[[memory]]
name = "second"
initial = 2
update = "first"
period = 0
)toml"),
                 0.1);
  run.step();
  EXPECT_EQ(run["first"], 2);
  EXPECT_EQ(run["second"], 1);
}

TEST(TomlMemory, OfOnePeriodHaveOneTimer) {
  const Mechanism m = memory_scene(std::string(kHeld) + R"toml([[memory]]
name = "other"
update = "held"
period = "tick"
[[memory]]
name = "constant"
update = "held"
period = 0.01
[[memory]]
name = "milliseconds"
update = "held"
period = "10 ms"
[[memory]]
name = "longer"
update = "held"
period = "2*tick"
)toml");
  std::vector<std::string> names;
  for (const StateVariable& state : m.states) names.push_back(state.name);
  EXPECT_EQ(names, (std::vector<std::string>{"held", "held_timer", "other", "constant", "constant_timer",
                                             "milliseconds", "longer", "longer_timer"}));
}

TEST(TomlMemory, RatesForcesAndSignalsMayNameThem) {
  const Mechanism m = memory_scene(std::string(kHeld) + R"toml([[state]]
name = "filtered"
rate = "held - filtered"
[[signal]]
name = "off"
value = "slide - held"
[[force]]
joint = "slide"
value = "-5*off"
)toml");
  EXPECT_EQ(m.states.front().name, "filtered");
  EXPECT_EQ(m.coordinate_forces.size(), 1u);
}

TEST(TomlMemory, AreImportedAndRepeatedWithTheirNumbers) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/part.toml", R"toml([[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
[[repeat]]
count = 2
[[repeat.memory]]
name = "held{i}"
update = "{i}*slide"
period = "0.01*{i}"
delay = 1
)toml");
  support::write_file(folder.path() + "/whole.toml", R"toml([model]
name = "whole"
[[import]]
file = "part.toml"
prefix = "left_"
[[import]]
file = "part.toml"
prefix = "right_"
)toml");
  SampledRun run(memory_file(folder.path() + "/whole.toml"), 0.01);
  for (int n = 0; n < 9; ++n) {
    run.place = n;
    run.step();
  }
  for (const char* side : {"left_", "right_"}) {
    EXPECT_EQ(run[std::string(side) + "held1"], 7);
    EXPECT_EQ(run[std::string(side) + "held2"], 12);
  }
}

}  // namespace
}  // namespace jourdain::model
