// Limbs that are computed at once: compiled random scenes of like limbs against the interpreter, bit by bit; what lanes
// save robots.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "agreement/compiled_batch.hpp"
#include "agreement/shared_data.hpp"
#include "compile/articulation.hpp"
#include "model/read/read.hpp"
#include "passes/lanes.hpp"
#include "programs/like_limbs.hpp"
#include "properties/effort.hpp"

namespace jourdain::tests {
namespace {

const std::uint64_t kScenes = cases(24);
constexpr double kBackward = 1e-13;

std::string joint(std::mt19937& random, const std::string& name, const std::string& parent, double side) {
  const auto number = [&](int size) { return 0.01 * double(static_cast<int>(random() % 100) - 50) * size; };
  const char* types[] = {"revolute", "revolute", "revolute", "prismatic", "spherical", "universal"};
  const std::string type = types[random() % 6];
  const char* axes[] = {"[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]", "[0, 0.6, 0.8]"};
  std::string text = fmt::format(
      "[[joint]]\nname = \"j{0}\"\ntype = \"{1}\"\nparent = \"{2}\"\nchild = \"{0}\"\n"
      "position = [{3}, {4}, {5}]\n",
      name, type, parent, number(1), side * number(1), number(1));
  if (type == "revolute" || type == "prismatic" || type == "universal")
    text += fmt::format("axis = {}\n", type == "universal" ? "[1, 0, 0]" : axes[random() % 4]);
  if (type == "universal") text += "second_axis = [0, 1, 0]\n";
  if (type == "revolute" && random() % 2 == 0) text += fmt::format("damping = {}\n", 0.1 + number(0));
  if (type == "revolute" && random() % 2 == 0)
    text += fmt::format("[[actuator]]\nname = \"u{0}\"\njoint = \"j{0}\"\n", name);
  return text;
}

std::string body(std::mt19937& random, const std::string& name, double side) {
  const auto number = [&] { return 0.01 * double(static_cast<int>(random() % 100) - 50); };
  const bool is_plain = random() % 3 == 0;
  return fmt::format(
      "[[body]]\nname = \"{}\"\nmass = {}\ncenter_of_mass = [{}, {}, {}]\n"
      "inertia = {{ xx = {}, yy = {}, zz = {}, xy = {} }}\n",
      name, 1.5 + number(), is_plain ? 0 : number(), is_plain ? 0 : side * number(), number(),
      0.3 + 0.1 * number(), 0.32 + 0.1 * number(), 0.33 + 0.1 * number(), is_plain ? 0 : side * 0.01);
}

/// Two to six limbs of one to four joints on a body that is free, turns, or is the world; mirrored, alike but for their
/// numbers, which are random.
model::Mechanism random_limbs(std::uint64_t seed) {
  std::mt19937 draw(static_cast<std::uint32_t>(seed));
  const std::size_t limbs = 2 + draw() % 5, joints = 2 + draw() % 3;
  const std::uint32_t shape = draw(), root = draw() % 3;
  std::string text = fmt::format("[model]\nname = \"limbs{}\"\n[parameters]\nload = 0.4\n", seed);
  const std::string trunk = root == 2 ? "world" : "trunk";
  if (root != 2) {
    text += "[[body]]\nname = \"trunk\"\nmass = \"5 + load\"\ninertia = [0.5, 0.6, 0.7]\n";
    text +=
        fmt::format("[[joint]]\nname = \"root\"\ntype = \"{}\"\nparent = \"world\"\nchild = \"trunk\"\n{}",
                    root == 0 ? "free" : "revolute", root == 0 ? "" : "axis = [0, 0, 1]\n");
  }
  for (std::size_t l = 0; l < limbs; ++l) {
    std::mt19937 kinds(shape), numbers(static_cast<std::uint32_t>(seed * 100 + (draw() % 2 == 0 ? l : 0)));
    const double side = l % 2 == 0 ? 1 : -1;
    std::string parent = trunk;
    for (std::size_t k = 0; k < joints; ++k) {
      const std::string name = fmt::format("b{}_{}", l, k);
      text += body(numbers, name, side) + joint(kinds, name, parent, side);
      parent = name;
    }
  }
  support::Diagnostics diagnostics("limbs.toml", text);
  std::optional<model::Mechanism> mechanism = model::read_mechanism(diagnostics);
  if (!mechanism) throw std::runtime_error(diagnostics.format() + text);
  return *mechanism;
}

Derived in_lanes(Derived derived, const passes::LeastGain& least = {}) {
  const std::vector<passes::LikeLimbs> limbs = programs::like_limbs(derived.mechanism);
  for (ir::Program& program : derived.module.functions) program = passes::in_lanes(program, limbs, least);
  return derived;
}

/// Emission validates the programs and reads the text back; here what compilers make of it is compared.
void check(const std::string& compiler, const std::vector<std::string>& options, std::uint64_t first) {
  std::size_t with_lanes = 0;
  for (std::uint64_t seed = first; seed < kScenes; seed += 2) {
    const Derived derived = in_lanes(derive(random_limbs(seed)), {0, 0});
    for (const ir::Program& program : derived.module.functions) with_lanes += !program.lanes.empty();
    const EmittedModel model = emit_model(derived, "limbs");
    for (const bool single : {false, true}) {
      const CompiledBatch batch({model}, compiler, single ? "float" : "double", options);
      const Sample sample = random_sample(derived.mechanism, seed, single);
      const Evaluation e = batch.evaluate(0, sample);
      const auto expected = [&](const char* function) {
        const std::vector<float> floats =
            single ? interpreted<float>(derived.module, function, sample) : std::vector<float>();
        return single ? std::vector<double>(floats.begin(), floats.end())
                      : interpreted<double>(derived.module, function, sample);
      };
      EXPECT_EQ(e.M, expected("mass_matrix")) << seed;
      EXPECT_EQ(e.k, expected("k_bar")) << seed;
      EXPECT_EQ(e.q, expected("q_bar")) << seed;
      EXPECT_EQ(e.zdot, expected("forward_dynamics")) << seed;
      EXPECT_EQ(e.tau, expected("inverse_dynamics")) << seed;
      EXPECT_EQ(e.kinetic, expected("kinetic_energy")[0]) << seed;
      EXPECT_EQ(e.potential, expected("potential_energy")[0]) << seed;
      if (!single) {
        EXPECT_LE(Judge(derived, sample).backward_error(e.zdot), kBackward) << seed;
      }
    }
  }
  EXPECT_GE(with_lanes, kScenes - first);
}

std::vector<std::string> as_interpreted(const std::string& option) {
  std::vector<std::string> options = kAsInterpreted;
  options.push_back(option);
  return options;
}

TEST(Lanes, HaveTheBitsOfTheInterpreterUnderGcc) { check("g++", kAsInterpreted, 0); }
TEST(Lanes, HaveTheBitsOfTheInterpreterUnderClang) { check("clang++", kAsInterpreted, 1); }

/// Vectors of four doubles where the processor has them: no operation of its own comes in.
TEST(Lanes, HaveTheBitsOfTheInterpreterInWiderVectors) {
  if (!__builtin_cpu_supports("avx")) GTEST_SKIP() << "a processor without AVX";
  check("g++", as_interpreted("-mavx"), 1);
  check("clang++", as_interpreted("-mavx"), 0);
}

/// Of robots: operations are no more, and so many of them are saved.
TEST(Lanes, SaveOperationsOfRobots) {
  struct Robot {
    std::string name;
    std::map<std::string, std::size_t> saved;
  };
  const std::vector<Robot> robots = {
      {"biped", {{"forward_dynamics", 1523}, {"mass_matrix", 527}, {"inverse_dynamics", 829}}},
      {"hyq", {{"forward_dynamics", 1582}, {"mass_matrix", 501}, {"inverse_dynamics", 1023}}},
      {"talos_reduced", {{"forward_dynamics", 3551}, {"mass_matrix", 1552}, {"inverse_dynamics", 1831}}}};
  for (const Robot& robot : robots) {
    if (!has_robot(robot.name)) continue;
    model::ReadOptions options;
    options.damping = false;
    options.root = model::RootJoint::kFree;
    const model::Mechanism mechanism = read_model(urdf_path(robot.name), options);
    dynamics::DerivationOptions chosen;
    choose_articulation(mechanism, {}).set(chosen);
    const Derived plain = derive(mechanism, chosen), lanes = in_lanes(plain);
    for (std::size_t i = 0; i < plain.module.functions.size(); ++i) {
      const ir::Program &before = plain.module.functions[i], &after = lanes.module.functions[i];
      EXPECT_LE(ir::count_operations(after).arithmetic(), ir::count_operations(before).arithmetic());
      if (const auto it = robot.saved.find(after.name); it != robot.saved.end()) {
        EXPECT_EQ(passes::saved_by_lanes(after), it->second) << robot.name << " " << after.name;
      }
    }
  }
}

TEST(Lanes, AreOfTreesWithLikeLimbsOnly) {
  for (const char* model : {"ur5.toml", "four_bar.toml", "parallel_robot.toml"})
    EXPECT_TRUE(programs::like_limbs(read_model(model_path(model))).empty()) << model;
  const std::vector<passes::LikeLimbs> legs = programs::like_limbs(read_model(model_path("quadruped.toml")));
  ASSERT_EQ(legs.size(), 1u);
  ASSERT_EQ(legs[0].size(), 4u);
  for (const std::vector<passes::Leaf>& leg : legs[0])
    EXPECT_EQ(leg.size(), 12u);  // y, z, ż and u of three joints
}

}  // namespace
}  // namespace jourdain::tests
