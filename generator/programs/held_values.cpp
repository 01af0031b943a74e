#include "programs/held_values.hpp"

#include <algorithm>

#include "ir/compose.hpp"
#include "passes/rewrite.hpp"

namespace jourdain::programs {

using ir::Builder;
using ir::Column;
using ir::JacobianEntries;
using ir::Seed;
using ir::Signed;

void HeldValues::add(const Builder& builder, const Column& candidates, const JacobianEntries& changes) {
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const ir::ValueId id = candidates[k].value;
    const bool is_known =
        std::any_of(values.begin(), values.end(), [id](Signed held) { return held.value == id; });
    if (is_known || ir::operand_count(builder.program()[id].op) == 0) continue;
    values.push_back(candidates[k]);
    for (auto it = changes.lower_bound({k, 0}); it != changes.end() && it->first.first == k; ++it)
      seeds.push_back({candidates[k], it->first.second, it->second});
  }
}

JacobianEntries HeldValues::differentiated(Builder& builder, const Column& of, std::vector<Seed> leaves,
                                           const ir::Surroundings& surroundings) const {
  leaves.insert(leaves.end(), seeds.begin(), seeds.end());
  return ir::differentiate(builder, of, leaves, values, surroundings);
}

HeldValues held_points(Builder& builder, const loops::SearchPrograms& searches,
                       const std::vector<Seed>& leaves, const ir::Surroundings& surroundings) {
  const Column found = ir::insert(builder, searches.found);
  HeldValues held;
  held.add(builder, found, loops::changes_of_found(builder, searches, found, leaves, surroundings));
  return held;
}

ir::Program jacobian_program(Builder& builder, const JacobianEntries& entries) {
  for (const auto& [at, value] : entries)
    builder.output("J", static_cast<int>(at.first), static_cast<int>(at.second), value);
  return passes::remove_dead_code(builder.finish("jacobian"));
}

}  // namespace jourdain::programs
