#include "compile/link_by_link.hpp"

#include "dynamics/link_forces.hpp"
#include "passes/pipeline.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain {

namespace {

/// Programs with more nodes are not taken through all passes.
constexpr std::size_t kLarge = 3000;

bool may_go_by_links(const model::Mechanism& mechanism, const dynamics::DerivationOptions& derivation) {
  kinematics::Statements statements;
  return dynamics::has_forces_by_links(dynamics::Scene(mechanism, derivation.link_tree, statements));
}

std::size_t count(const dynamics::Equations& equations, ir::FunctionId function) {
  ir::Module module{{}, {programs::lower_function(equations, function)}};
  module = module.functions[0].nodes.size() > kLarge ? passes::optimise_once(std::move(module))
                                                     : passes::optimise(std::move(module)).module;
  return ir::count_operations(module.functions[0]).arithmetic();
}

}  // namespace

void choose_recursions(const model::Mechanism& mechanism, dynamics::DerivationOptions& derivation) {
  if (!may_go_by_links(mechanism, derivation)) return;
  dynamics::DerivationOptions composites = derivation;
  composites.forces_only = true;
  dynamics::DerivationOptions links = composites;
  links.k_bar_by_links = links.tau_by_links = true;
  const dynamics::Equations by_composites = dynamics::derive_equations(mechanism, composites),
                            by_links = dynamics::derive_equations(mechanism, links);
  const auto fewer = [&](ir::FunctionId function) {
    return count(by_links, function) < count(by_composites, function);
  };
  derivation.k_bar_by_links = fewer(ir::FunctionId::kKBar);
  derivation.tau_by_links = fewer(ir::FunctionId::kInverseDynamics);
}

}  // namespace jourdain
