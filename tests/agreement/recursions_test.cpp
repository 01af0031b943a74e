#include <gtest/gtest.h>

#include "agreement/shared_data.hpp"
#include "compile/link_by_link.hpp"
#include "passes/pipeline.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain {
namespace {

std::size_t operations(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
                       ir::FunctionId function) {
  const dynamics::Equations equations = dynamics::derive_equations(mechanism, options);
  const ir::Module module = passes::optimise({{}, {programs::lower_function(equations, function)}}).module;
  return ir::count_operations(module.functions[0]).arithmetic();
}

TEST(Recursions, TakeNeverMoreOperationsThanCompositeBodies) {
  for (const char* name : {"puma560", "ur5", "chain4", "double_pendulum", "elastic_arm", "spring_pendulum"}) {
    const model::Mechanism mechanism = tests::read_model(tests::model_path(name + std::string(".toml")));
    dynamics::DerivationOptions chosen;
    choose_recursions(mechanism, chosen);
    for (const ir::FunctionId function :
         {ir::FunctionId::kMassMatrix, ir::FunctionId::kKBar, ir::FunctionId::kQBar,
          ir::FunctionId::kInverseDynamics, ir::FunctionId::kKineticEnergy})
      EXPECT_LE(operations(mechanism, chosen, function), operations(mechanism, {}, function)) << name;
  }
}

TEST(Recursions, OfAGeneralArmGoByLinksOfAFreeBodyDoNot) {
  dynamics::DerivationOptions arm, free;
  choose_recursions(tests::read_model(tests::model_path("puma560.toml")), arm);
  EXPECT_TRUE(arm.tau_by_links);
  choose_recursions(tests::read_model(tests::model_path("quadrotor.toml")), free);
  EXPECT_FALSE(free.tau_by_links);
  EXPECT_FALSE(free.k_bar_by_links);
}

}  // namespace
}  // namespace jourdain
