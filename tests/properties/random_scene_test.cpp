// The random scenes themselves: repeatable, varied, and the same after writing and reading.
#include "properties/random_scene.hpp"

#include <gtest/gtest.h>

#include <set>

#include "model/coordinates.hpp"
#include "model/read/read.hpp"
#include "properties/effort.hpp"
#include "properties/random_tree.hpp"
#include "properties/to_toml.hpp"
#include "support/enumerators.hpp"

namespace jourdain::tests {
namespace {

TEST(RandomScene, GivesTheSameSceneForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    EXPECT_EQ(to_toml(random_scene(seed)), to_toml(random_scene(seed)));
}

TEST(RandomScene, DrawsEveryJointAndElement) {
  std::set<model::JointType> joints;
  std::set<model::OutputKind> outputs;
  int motions = 0, free = 0, loads = 0, springs = 0, bushings = 0, laws = 0, inputs = 0, rotors = 0,
      frictions = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const model::Mechanism scene = random_scene(seed);
    motions += has_motion(scene);
    free += has_free_joint(scene);
    loads += int(scene.loads.size());
    springs += int(scene.springs.size());
    bushings += int(scene.bushings.size());
    inputs += int(scene.inputs.size());
    for (const model::Spring& spring : scene.springs) laws += spring.potential.has_value();
    for (const model::Actuator& actuator : scene.actuators) rotors += !actuator.rotor_inertia.is_zero();
    for (const model::Output& output : scene.outputs) outputs.insert(output.kind);
    for (const model::Joint& joint : scene.joints) {
      joints.insert(joint.type);
      for (const model::Coordinate& c : joint.coordinates) frictions += !c.friction.is_zero();
    }
  }
  EXPECT_EQ(joints.size(), support::entry_count<model::JointType>());
  EXPECT_EQ(outputs.size(), support::entry_count<model::OutputKind>());
  for (const int count : {motions, free, loads, springs, bushings, laws, inputs, rotors, frictions})
    EXPECT_GE(count, 5);
}

TEST(RandomScene, ComesBackFromItsDescription) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    const model::Mechanism scene = random_scene(seed);
    const std::string text = to_toml(scene);
    support::Diagnostics diagnostics("scene.toml", text);
    const auto read = model::read_mechanism(diagnostics);
    ASSERT_TRUE(read) << diagnostics.format() << text;
    EXPECT_EQ(to_toml(*read), text);
    const auto state = random_state(scene, seed);
    const auto u = random_inputs(scene, seed);
    const reference::Reference<double> before(scene), after(*read);
    const auto one = before.evaluate(state, u), other = after.evaluate(state, u);
    EXPECT_EQ(one.M, other.M) << seed;
    EXPECT_EQ(one.k_bar, other.k_bar) << seed;
    EXPECT_EQ(one.q_bar, other.q_bar) << seed;
  }
}

}  // namespace
}  // namespace jourdain::tests
