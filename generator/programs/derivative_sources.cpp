#include "programs/derivative_sources.hpp"

#include "dynamics/outputs.hpp"
#include "lowering/displacements.hpp"
#include "lowering/lower.hpp"

namespace jourdain::programs {

namespace {

std::vector<lowering::Target> targets(const char* name, const std::vector<dynamics::Ex>& values) {
  std::vector<lowering::Target> list;
  for (std::size_t i = 0; i < values.size(); ++i) list.push_back({name, static_cast<int>(i), -1, values[i]});
  return list;
}

}  // namespace

DerivativeSources tree_sources(const model::Mechanism& mechanism,
                               const dynamics::DerivationOptions& options) {
  dynamics::DerivationOptions plain = options;
  plain.planar = false;
  plain.from_links = {};
  plain.articulated.clear();  // M is factorised for the derivatives anyway
  plain.for_derivatives = true;
  const dynamics::Equations equations = dynamics::derive_equations(mechanism, plain);
  const auto lowered = [&](const std::vector<dynamics::Ex>& values, const char* name, const char* program) {
    return lowering::lower(equations.statements, targets(name, values), program);
  };
  DerivativeSources sources;
  sources.residual = lowered(equations.residual, "r", "residual");
  sources.load = lowered(equations.load, "v", "values");
  sources.zdot = lowered(equations.zdot, "v", "values");
  sources.outputs = lowered(dynamics::output_entries(equations), "v", "values");
  for (const std::vector<dynamics::Ex>& row : equations.M)
    sources.mass_rows.push_back(lowered(row, "v", "values"));
  sources.facts = scene_facts(mechanism);
  sources.position_seeds = [tangent = sources.facts.tangent](ir::Builder& builder, std::size_t) {
    return lowering::displacement_seeds(builder, tangent);
  };
  return sources;
}

}  // namespace jourdain::programs
