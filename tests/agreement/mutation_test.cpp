// Planted errors: the compiler refuses to emit each of them.
#include <gtest/gtest.h>

#include <cmath>

#include "agreement/judge.hpp"
#include "agreement/shared_data.hpp"
#include "compile/compile.hpp"
#include "programs/functions.hpp"

namespace jourdain::tests {
namespace {

bool refuses(const Derived& derived) {
  CompiledModel compiled;
  compiled.facts = programs::scene_facts(derived.mechanism);
  compiled.functions = programs::with_needed(programs::default_functions(), compiled.facts);
  compiled.module = derived.module;
  validate_and_emit(derived.mechanism, derived.equations, {}, compiled);
  EXPECT_EQ(compiled.files.empty(), !compiled.verdict.accepted());
  return !compiled.verdict.accepted();
}

ir::Program& forward_dynamics(Derived& derived) {
  for (ir::Program& program : derived.module.functions)
    if (program.name == "forward_dynamics") return program;
  throw std::runtime_error("no forward_dynamics");
}

TEST(Mutation, NothingPlantedIsAccepted) {
  for (const char* model : {"double_pendulum.toml", "panda.toml"})
    EXPECT_FALSE(refuses(derive(read_model(model_path(model)))));
}

TEST(Mutation, ASignFlippedInKBarIsRefused) {
  const Derived correct = derive(read_model(model_path("panda.toml")));
  for (std::size_t i = 0; i < correct.equations.k_bar.size(); ++i) {
    Derived mutant = correct;
    if (mutant.equations.k_bar[i].is_zero()) continue;
    mutant.equations.k_bar[i] = -mutant.equations.k_bar[i];
    EXPECT_TRUE(refuses(mutant)) << i;
  }
}

TEST(Mutation, ADroppedOffDiagonalInertiaIsRefused) {
  const model::Mechanism original = read_model(model_path("panda.toml"));
  model::Mechanism changed = original;
  for (model::Body& body : changed.bodies)
    if (body.name == "link6") body.inertia.xz = 0;
  Derived mutant = derive(changed);
  mutant.mechanism = original;
  EXPECT_TRUE(refuses(mutant));
}

TEST(Mutation, SwappedOperandsOfEverySubtractionAndDivisionAreRefused) {
  for (const char* model : {"double_pendulum.toml", "cart_pole.toml", "chain4.toml"}) {
    const Derived correct = derive(read_model(model_path(model)));
    Derived mutant = correct;
    const std::size_t count = forward_dynamics(mutant).nodes.size();
    for (std::size_t i = 0; i < count; ++i) {
      mutant.module = correct.module;
      ir::Node& node = forward_dynamics(mutant).nodes[i];
      if (node.op != ir::Op::kSubtract && node.op != ir::Op::kDivide) continue;
      std::swap(node.a, node.b);
      EXPECT_TRUE(refuses(mutant)) << model << " value " << i;
    }
  }
}

// Quaternions, prescribed motion, springs, loads and outputs.
TEST(Mutation, SwappedOperandsAreRefusedInEveryFunctionOfOtherScenes) {
  for (const char* model : {"crane.toml", "quadrotor.toml", "hoop_bead.toml", "flyball_governor.toml"}) {
    const Derived correct = derive(read_model(model_path(model)));
    Derived mutant = correct;
    for (std::size_t f = 0; f < correct.module.functions.size(); ++f)
      for (std::size_t i = 0; i < correct.module.functions[f].nodes.size(); ++i) {
        ir::Node& node = mutant.module.functions[f].nodes[i];
        if (node.op != ir::Op::kSubtract && node.op != ir::Op::kDivide) continue;
        // A spring's energy is even in its stretch and in the components of its length.
        if (mutant.module.functions[f].name == "potential_energy") continue;
        std::swap(node.a, node.b);
        EXPECT_TRUE(refuses(mutant)) << model << " " << mutant.module.functions[f].name << " value " << i
                                     << "\n"
                                     << print(mutant.module.functions[f]);
        std::swap(node.a, node.b);
      }
  }
}

TEST(Mutation, AChangedLiteralIsRefused) {
  const Derived correct = derive(read_model(model_path("ur5.toml")));
  Derived mutant = correct;
  const std::size_t count = forward_dynamics(mutant).nodes.size();
  for (std::size_t i = 0; i < count; ++i)
    for (const double factor : {1 + 1e-6, double(NAN)}) {
      mutant.module = correct.module;
      ir::Node& node = forward_dynamics(mutant).nodes[i];
      if (node.op != ir::Op::kLiteral || node.literal == 0) continue;
      node.literal *= factor;
      EXPECT_TRUE(refuses(mutant)) << "value " << i << " = " << node.literal;
    }
}

TEST(Mutation, ASumTurnedIntoADifferenceIsRefused) {
  const Derived correct = derive(read_model(model_path("double_pendulum.toml")));
  for (std::size_t f = 0; f < correct.module.functions.size(); ++f)
    for (std::size_t i = 0; i < correct.module.functions[f].nodes.size(); ++i) {
      Derived mutant = correct;
      ir::Node& node = mutant.module.functions[f].nodes[i];
      if (node.op != ir::Op::kAdd) continue;
      // M and the kinetic energy are even in y1: y0 - y1 for y0 + y1 is no error there.
      const bool even = correct.module.functions[f].name == "mass_matrix" ||
                        correct.module.functions[f].name == "kinetic_energy";
      if (even && correct.module.functions[f].labels[i] == "angle1") continue;
      node.op = ir::Op::kSubtract;
      EXPECT_TRUE(refuses(mutant)) << mutant.module.functions[f].name << " value " << i;
    }
}

}  // namespace
}  // namespace jourdain::tests
