#include "programs/closed_system.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "lowering/cheapest_elimination.hpp"
#include "programs/tree_functions.hpp"

namespace jourdain::programs {

namespace {

dynamics::DerivationOptions for_residual(dynamics::DerivationOptions options) {
  options.articulated.clear();
  options.for_derivatives = true;
  return options;
}

}  // namespace

ClosedSystem::ClosedSystem(const model::Mechanism& mechanism, const dynamics::DerivationOptions& options,
                           const loops::LoopPlan& plan)
    : equations_(dynamics::derive_equations(mechanism, for_residual(options))),
      system_{constraints_, plan, mechanism, model::lay_out_coordinates(mechanism), {}, {}} {
  system_.tangent = model::tangent_of(mechanism, system_.layout);
  system_.tree = [this](const std::string& function) { return tree(function); };
  choose(loops::constraint_programs(mechanism, equations_));
}

/// Those with which accelerations take the fewest operations.
void ClosedSystem::choose(const std::vector<loops::ConstraintPrograms>& list) {
  std::size_t best = 0, fewest = 0;
  for (std::size_t k = 0; k < list.size() && list.size() > 1; ++k) {
    constraints_ = list[k];
    const std::size_t operations = lowering::remaining_operations(loop_program(system_, "forward_dynamics"));
    if (k == 0 || operations < fewest) {
      best = k;
      fewest = operations;
    }
  }
  constraints_ = list[best];
}

const ir::Program& ClosedSystem::tree(const std::string& function) {
  const auto known = lowered_.find(function);
  if (known != lowered_.end()) return known->second;
  return lowered_[function] = lower_function(equations_, function);
}

namespace {

/// Position of each velocity of the tree among the independent ones.
std::vector<std::optional<std::size_t>> places(const loops::LoopPlan& plan) {
  std::vector<std::optional<std::size_t>> list(plan.z.size());
  for (std::size_t j = 0; j < plan.independent.size(); ++j) list[plan.independent[j]] = j;
  return list;
}

}  // namespace

model::Tangent independent_tangent(const loops::LoopPlan& plan, const model::Tangent& tree) {
  const auto place = places(plan);
  model::Tangent tangent;
  for (const model::Tangent::Scalar& s : tree.scalars)
    if (place[s.velocity]) tangent.scalars.push_back({s.position, *place[s.velocity]});
  for (const model::Tangent::Scalar& s : tree.quaternions)
    if (place[s.velocity]) tangent.quaternions.push_back({s.position, *place[s.velocity]});
  return tangent;
}

std::vector<std::size_t> dependent_positions(const loops::LoopPlan& plan, const model::Tangent& tree) {
  std::vector<std::size_t> entries;
  if (!plan.is_reduced()) return entries;
  const auto place = places(plan);
  for (const model::Tangent::Scalar& s : tree.scalars)
    if (!place[s.velocity]) entries.push_back(s.position);
  for (const model::Tangent::Scalar& s : tree.quaternions)
    for (std::size_t k = 0; !place[s.velocity] && k < 4; ++k) entries.push_back(s.position + k);
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace jourdain::programs
