// [[state]], [[signal]] and [[friction]] as they are read: what they name, by imports, repeats and locks too.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "model/coordinates.hpp"
#include "model/read/read.hpp"
#include "support/files.hpp"
#include "support/temporary_folder.hpp"

namespace jourdain::model {
namespace {

constexpr const char* kStateSlider = R"toml([parameters]
rate_constant = { value = 4, unit = "1/s" }
[[body]]
name = "bob"
mass = 1
[[joint]]
name = "slide"
type = "prismatic"
parent = "world"
child = "bob"
)toml";

Mechanism state_file(const std::string& path) {
  support::Diagnostics diagnostics(path, support::read_file(path));
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

Mechanism state_scene(const std::string& more, const ReadOptions& options = {}) {
  support::Diagnostics diagnostics("scene.toml",
                                   std::string("[model]\nname = \"scene\"\n") + kStateSlider + more);
  const std::optional<Mechanism> mechanism = read_mechanism(diagnostics, options);
  EXPECT_EQ(diagnostics.format(), "");
  return mechanism.value_or(Mechanism());
}

/// With each variable as `value` says.
double state_value(const Mechanism& mechanism, const Expression& expression,
                   const std::function<double(const Variable&)>& value) {
  const std::vector<double> parameters = default_values(mechanism);
  return expression.evaluate<double>(
      std::span<const double>(parameters), [](double v) { return v; }, value);
}

/// A number for each variable that says which it is.
double distinct_number(const Variable& v) {
  return 1 + 100 * static_cast<double>(v.kind) + 10 * static_cast<double>(v.index) +
         static_cast<double>(v.component);
}

double of_state(std::size_t i) { return distinct_number({Variable::Kind::kState, i}); }
double of_position(std::size_t joint) { return distinct_number({Variable::Kind::kPosition, joint}); }

TEST(TomlState, SaysHowANumberMovesAndMayNameLaterOnes) {
  const Mechanism m = state_scene(R"toml([[state]]
name = "first"
unit = "A"
initial = "3 A"
description = "what it is"
rate = "rate_constant*(4.0*second - first)"
[[state]]
name = "second"
initial = -250
rate = "slide - second"
[[state]]
name = "third"
nominal = 1e-3
rate = "t"
)toml");
  ASSERT_EQ(m.states.size(), 3u);
  EXPECT_EQ(m.states[0].unit, "A");
  EXPECT_EQ(m.states[0].description, "what it is");
  EXPECT_EQ(m.states[0].initial.constant(), 3);
  EXPECT_EQ(m.states[0].nominal.constant(), 3);
  EXPECT_EQ(m.states[1].nominal.constant(), 250);
  EXPECT_EQ(m.states[2].nominal.constant(), 1e-3);
  EXPECT_EQ(state_value(m, m.states[0].rate, distinct_number), 4 * (4 * of_state(1) - of_state(0)));
  EXPECT_EQ(state_value(m, m.states[1].rate, distinct_number), of_position(0) - of_state(1));
  const CoordinateLayout layout = lay_out_coordinates(m);
  EXPECT_EQ(layout.velocity_names, (std::vector<std::string>{"slide", "first", "second", "third"}));
  EXPECT_EQ(layout.position_count(), 1u);
  EXPECT_EQ(layout.first_state(), 1u);
}

TEST(TomlState, OfImportsKeepWhatTheyName) {
  const support::TemporaryFolder folder;
  support::write_file(folder.path() + "/part.toml", std::string(kStateSlider) + R"toml([[state]]
name = "lag"
rate = "rate_constant*(slide - lag)"
[[force]]
joint = "slide"
value = "-3*lag"
)toml");
  support::write_file(folder.path() + "/model.toml", R"toml([model]
name = "two"
[[import]]
file = "part.toml"
prefix = "a_"
[[import]]
file = "part.toml"
prefix = "b_"
[[state]]
name = "sum"
rate = "a_lag + 2*b_lag"
)toml");
  const Mechanism m = state_file(folder.path() + "/model.toml");
  ASSERT_EQ(m.states.size(), 3u);
  EXPECT_EQ(m.states[1].name, "b_lag");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(state_value(m, m.states[i].rate, distinct_number), 4 * (of_position(i) - of_state(i))) << i;
    EXPECT_EQ(state_value(m, m.coordinate_forces[i].force, distinct_number), -3 * of_state(i)) << i;
  }
  EXPECT_EQ(state_value(m, m.states[2].rate, distinct_number), of_state(0) + 2 * of_state(1));
}

TEST(TomlState, IsWrittenOutByRepeats) {
  const Mechanism m = state_scene(R"toml([[repeat]]
count = 3
[[repeat.state]]
name = "filter{i}"
rate = "{i}*slide - filter{i}"
)toml");
  ASSERT_EQ(m.states.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(state_value(m, m.states[i].rate, distinct_number), double(i + 1) * of_position(0) - of_state(i))
        << i;
}

TEST(TomlState, OfALockedJointSeesItStandStill) {
  const std::string other = R"toml([[body]]
name = "second"
mass = 1
[[joint]]
name = "other"
type = "prismatic"
parent = "bob"
child = "second"
[[state]]
name = "lag"
rate = "slide + 5*other.rate - lag"
)toml";
  ReadOptions options;
  options.locked_joints = {"other"};
  const Mechanism m = state_scene(other, options);
  EXPECT_EQ(state_value(m, m.states[0].rate, distinct_number), of_position(0) - of_state(0));
}

TEST(TomlSignal, StandsForItsExpression) {
  const Mechanism m = state_scene(R"toml([[state]]
name = "lag"
rate = "twice - lag"
[[signal]]
name = "error"
unit = "m"
value = "0.5 - slide"
[[signal]]
name = "twice"
value = "2*error + bob.vx"
[[force]]
joint = "slide"
value = "twice*twice"
)toml");
  const auto value = [](const Variable& v) {
    return v.kind == Variable::Kind::kFrameVelocity ? 7 : distinct_number(v);
  };
  const double twice = 2 * (0.5 - of_position(0)) + 7;
  EXPECT_EQ(state_value(m, m.states[0].rate, value), twice - of_state(0));
  EXPECT_EQ(state_value(m, m.coordinate_forces[0].force, value), twice * twice);
}

/// Sliding steadily its bristles stand still; at rest it is a spring.
TEST(TomlFriction, IsLuGres) {
  const Mechanism m = state_scene(R"toml([[friction]]
name = "seal"
joint = "slide"
coulomb = 10
breakaway = 15
stribeck_speed = 0.1
bristle_stiffness = 1e5
bristle_damping = 300
viscous = 4
)toml");
  ASSERT_EQ(m.states.size(), 1u);
  EXPECT_EQ(m.states[0].unit, "m");
  EXPECT_EQ(m.states[0].nominal.constant(), 1e-4);
  const auto at = [&m](const Expression& expression, double speed, double bristle) {
    return state_value(m, expression,
                       [&](const Variable& v) { return v.kind == Variable::Kind::kState ? bristle : speed; });
  };
  for (const double v : {-0.3, -0.05, 0.02, 1.0}) {
    const double g = 10 + 5 * std::exp(-(v / 0.1) * (v / 0.1)), bristle = (v < 0 ? -g : g) / 1e5;
    EXPECT_NEAR(at(m.states[0].rate, v, bristle), 0, 1e-15) << v;
    EXPECT_NEAR(at(m.coordinate_forces[0].force, v, bristle), (v < 0 ? g : -g) - 4 * v, 1e-12) << v;
    EXPECT_NEAR(at(m.states[0].rate, v, 0), v, 1e-15) << v;
    EXPECT_NEAR(at(m.coordinate_forces[0].force, v, 0), -304 * v, 1e-12) << v;
  }
  EXPECT_EQ(at(m.states[0].rate, 0, 3e-5), 0);
  EXPECT_NEAR(at(m.coordinate_forces[0].force, 0, 3e-5), -3, 1e-12);
}

}  // namespace
}  // namespace jourdain::model
