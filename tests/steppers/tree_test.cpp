// The tree holds all that a language has to print: executed as it is, every stepper gives what its C++ gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "crane_all/crane_all_kernels.hpp"
#include "emit/tree_interpreter.hpp"
#include "flyball_governor_all/flyball_governor_all_kernels.hpp"
#include "hoop_bead_all/hoop_bead_all_kernels.hpp"
#include "quadrotor_all/quadrotor_all_kernels.hpp"
#include "readback/compiled_text.hpp"
#include "shaking_cart_all/shaking_cart_all_kernels.hpp"
#include "spring_four_bar_all/spring_four_bar_all_kernels.hpp"
#include "steppers/visit_steppers.hpp"

namespace jourdain::tests {
namespace {

/// Those of the model that the command emitted: which values are constants depends on them.
std::vector<std::string> emitted_functions(const std::string& model) {
  std::ifstream file(std::string(JOURDAIN_STEPPERS) + "/" + model + "/" + model + ".json");
  return nlohmann::json::parse(file)["functions"];
}

constexpr double kStep = 5e-4;  // s

/// Three steps, which fills every memory; inputs are held. To the bit, but where time drives, a sum of three numbers in
/// C++.
template <class State, class Input, class Step, class History>
void compare(const CompiledText& text, const std::string& name, State state, Input input, Step step,
             const History&) {
  History fresh{};
  const programs::SceneFacts& scene = text.compiled.facts;
  const emit::ModelCode code = emit::model_code(scene, text.compiled.functions, text.compiled.module);
  TreeInterpreter tree(code, scene);
  Value tree_state = tree.call("initial_state", {}), tree_input, tree_h, memory;
  tree_h.number = kStep;
  if constexpr (requires { input.u; }) {
    for (std::size_t k = 0; k < std::size(input.u); ++k)
      tree_input.members["u"].entries[long(k)].number = input.u[k] = 0.1 * double(k + 1);
  }
  const programs::Stepper& stepper = *programs::find_stepper(name);
  std::vector<Value*> arguments = {&tree_state, &tree_input, &tree_h};
  if (stepper.history > 0 || stepper.implicit) arguments.push_back(&memory);
  for (int k = 0; k < 3; ++k) {
    step(state, input, tree_h.number, fresh);
    tree.call(name + "_step", arguments);
  }
  const auto near = [&](const char* member, const auto& compiled) {
    for (std::size_t k = 0; k < std::size(compiled); ++k) {
      ASSERT_TRUE(std::isfinite(compiled[k])) << name;
      const double interpreted = tree_state.members[member].entries[long(k)].number;
      EXPECT_NEAR(interpreted, compiled[k], scene.time.dynamics ? 1e-15 : 0)
          << scene.positions.front() << " " << name << " " << member << k;
    }
  };
  near("y", state.y);
  near("z", state.z);
  if constexpr (requires { state.t; }) {
    EXPECT_NEAR(tree_state.members["t"].number, 3 * kStep, 1e-18) << name;
  }
}

#define JOURDAIN_COMPARE_TREES(model)                                                  \
  {                                                                                    \
    const CompiledText text = compiled_text(#model, emitted_functions(#model "_all")); \
    const auto visit = [&](const std::string& name, int, auto step, auto& history) {   \
      const auto start = ::model##_all::initial_state(::model##_all::Model<double>()); \
      compare(text, name, start, ::model##_all::Input<double>{}, step, history);       \
    };                                                                                 \
    JOURDAIN_VISIT_STEPPERS(model##_all, double, visit);                               \
  }

TEST(Tree, ExecutedGivesTheStepsOfItsText) {
  JOURDAIN_COMPARE_TREES(quadrotor)         // a free root, inputs
  JOURDAIN_COMPARE_TREES(crane)             // a ball, prescribed motion
  JOURDAIN_COMPARE_TREES(shaking_cart)      // angles that follow from time
  JOURDAIN_COMPARE_TREES(hoop_bead)         // a curve
  JOURDAIN_COMPARE_TREES(flyball_governor)  // loops in closed form
  JOURDAIN_COMPARE_TREES(spring_four_bar)   // loops by Newton's method
}

}  // namespace
}  // namespace jourdain::tests
