#include "compile/link_by_link.hpp"

#include "compile/program_cost.hpp"
#include "dynamics/link_equations.hpp"
#include "dynamics/link_forces.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain {

namespace {

using ir::FunctionId;

/// The functions that may be derived in several ways, with each way that a scene has.
class Recursions {
 public:
  Recursions(const model::Mechanism& mechanism, const dynamics::DerivationOptions& derivation)
      : mechanism_(mechanism), composites_(derivation) {
    kinematics::Statements statements;
    const dynamics::Scene scene(mechanism, derivation.link_tree, statements);
    by_links_ = dynamics::has_forces_by_links(scene);
    from_links_ = scene.layout.velocity_count() <= kMostLinkEquations && dynamics::has_link_equations(scene);
    composites_.forces_only = true;
  }

  void choose(dynamics::DerivationOptions& derivation) const {
    if (!by_links_ && !from_links_) return;
    const dynamics::Equations composites = dynamics::derive_equations(mechanism_, composites_);
    if (by_links_) {
      dynamics::DerivationOptions options = composites_;
      options.k_bar_by_links = options.tau_by_links = true;
      const dynamics::Equations links = dynamics::derive_equations(mechanism_, options);
      const auto fewer = [&](FunctionId function) {
        return cost(links, function).arithmetic < cost(composites, function).arithmetic;
      };
      derivation.k_bar_by_links = fewer(FunctionId::kKBar);
      derivation.tau_by_links = fewer(FunctionId::kInverseDynamics);
    }
    if (from_links_) choose_from_links(derivation);
  }

 private:
  void choose_from_links(dynamics::DerivationOptions& derivation) const {
    dynamics::DerivationOptions options = derivation;
    options.forces_only = true;
    const dynamics::Equations others = dynamics::derive_equations(mechanism_, options);
    options.from_links = {true, true, true, true, true};
    const dynamics::Equations links = dynamics::derive_equations(mechanism_, options);
    const auto saves = [&](FunctionId function) {
      return cost(links, function).saves_on(cost(others, function));
    };
    derivation.from_links = {saves(FunctionId::kMassMatrix), saves(FunctionId::kKBar),
                             saves(FunctionId::kQBar), saves(FunctionId::kInverseDynamics),
                             saves(FunctionId::kKineticEnergy)};
  }

  static ProgramCost cost(const dynamics::Equations& equations, FunctionId function) {
    return cost_behind_passes(programs::lower_function(equations, function));
  }

  const model::Mechanism& mechanism_;
  dynamics::DerivationOptions composites_;
  bool by_links_ = false, from_links_ = false;
};

}  // namespace

void choose_recursions(const model::Mechanism& mechanism, dynamics::DerivationOptions& derivation) {
  Recursions(mechanism, derivation).choose(derivation);
}

}  // namespace jourdain
