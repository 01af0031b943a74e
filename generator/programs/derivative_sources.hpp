// What functions that hold derivatives are made from.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "dynamics/equations.hpp"
#include "ir/jacobian.hpp"
#include "loops/rows/search_programs.hpp"
#include "model/mechanism.hpp"
#include "programs/scene_facts.hpp"

namespace jourdain::programs {

/// M ż + Gᵀ λ = k̄ − q̄, G ż + γ = 0 with multipliers λ of some rows.
struct ConstrainedMotion {
  ir::Program motion;     ///< ("zdot", k), ("lambda", i)
  ir::Program equations;  ///< ("r", k), ("c", i): what is zero then, with ż and λ as leaves
  ir::Program
      change;  ///< ("zdot", k), ("lambda", i): their changes by those of r (leaves ż) and c (leaves λ)
};

/// What is differentiated: the equations M ż = k̄ − q̄ as programs over their own coordinates.
struct DerivativeSources {
  ir::Program residual;                ///< r = M ż − k̄ + q̄, with ż as leaves
  ir::Program load;                    ///< of q̄ all but gravity; kApplied
  ir::Program zdot;                    ///< M⁻¹ (k̄ − q̄)
  ir::Program outputs;                 ///< numbers of all outputs, with ż as leaves
  std::vector<ir::Program> mass_rows;  ///< the entries of one row of M each
  ir::Program carried_rates;           ///< velocities of the coordinates that are carried along
  SceneFacts facts;
  /// How position leaves depend on the displacements and, beyond that, on time: the column after the last
  /// velocity, input.
  std::function<std::vector<ir::Seed>(ir::Builder&, std::size_t time_column)> position_seeds;
  loops::SearchPrograms searches;                ///< points in them that are looked for
  std::optional<ConstrainedMotion> constrained;  ///< with multipliers
};

/// Those of a tree.
DerivativeSources tree_sources(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options);

}  // namespace jourdain::programs
