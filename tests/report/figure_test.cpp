// What figures know of the ground that bodies touch.
#include "report/figure.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "agreement/shared_data.hpp"
#include "model/read/read.hpp"

namespace jourdain::tests {
namespace {

report::Figure figure_of(const model::Mechanism& mechanism) {
  return report::make_figure(mechanism, model::default_values(mechanism));
}

report::Figure figure_named(const std::string& name) {
  return figure_of(read_model(model_path(name + ".toml")));
}

TEST(Figure, FeetShareTheGroundThatTheyStandOn) {
  const report::Figure figure = figure_named("standing_quadruped");
  ASSERT_EQ(figure.grounds.size(), 1u);
  const report::FigureGround& ground = figure.grounds[0];
  EXPECT_EQ(ground.touching.size(), 4u);
  EXPECT_FALSE(ground.body);
  EXPECT_FALSE(ground.height);
  EXPECT_EQ(ground.normal, (model::Numbers3{0, 0, 1}));
}

TEST(Figure, GroundHasTheHeightOfTheDescription) {
  const report::Figure hills = figure_named("rolling_hills");
  ASSERT_EQ(hills.grounds.size(), 1u);
  ASSERT_TRUE(hills.grounds[0].height);
  EXPECT_EQ(hills.grounds[0].height(0.7, -0.4), 0.1 * std::sin(1.6 * 0.7) * std::cos(1.6 * -0.4));
  const report::Figure bowl = figure_named("ball_in_bowl");
  ASSERT_EQ(bowl.grounds.size(), 1u);
  ASSERT_TRUE(bowl.grounds[0].height);
  EXPECT_GT(bowl.grounds[0].height(0.2, 0.1), bowl.grounds[0].height(0, 0));
}

/// The origin of `plane` is a point of the ground, which moves with its body.
TEST(Figure, GroundMayBeOnABody) {
  const std::string text = R"toml(
[model]
name = "table"
[[body]]
name = "table"
mass = 1
inertia = [1, 1, 1]
[[joint]]
name = "turn"
type = "revolute"
axis = [0, 0, 1]
parent = "world"
child = "table"
[[body]]
name = "ball"
mass = 1
inertia = [0.01, 0.01, 0.01]
[[joint]]
name = "flight"
type = "free"
parent = "world"
child = "ball"
initial_position = [0, 0, 0.4]
[[frame]]
name = "top"
body = "table"
position = [0.1, 0, 0.3]
rpy = [0, 0, "90 deg"]
[[constraint]]
name = "rolls"
type = "rolling_ball"
frame = "ball"
plane = "top"
radius = 0.1
height = "0.05*sin(x)"
)toml";
  support::Diagnostics diagnostics("table.toml", text);
  const auto mechanism = model::read_mechanism(diagnostics, {});
  ASSERT_TRUE(mechanism) << diagnostics.format();
  const report::Figure figure = figure_of(*mechanism);
  ASSERT_EQ(figure.grounds.size(), 1u);
  const report::FigureGround& ground = figure.grounds[0];
  EXPECT_EQ(ground.body, std::size_t{0});
  EXPECT_EQ(ground.point, (model::Numbers3{0.1, 0, 0.3}));
  EXPECT_NEAR(ground.along[0][1], 1, 1e-15);  // x of the frame is y of the body
  EXPECT_EQ(ground.touching, std::vector<std::size_t>{1});
  EXPECT_EQ(ground.height(0.5, 3), 0.05 * std::sin(0.5));
}

}  // namespace
}  // namespace jourdain::tests
