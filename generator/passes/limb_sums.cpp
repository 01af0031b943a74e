#include "passes/limb_sums.hpp"

#include <map>
#include <utility>

#include "passes/rewrite.hpp"

namespace jourdain::passes {

using ir::Program;
using ir::Signed;
using ir::ValueId;

Reordered limb_by_limb(const Program& program, const std::vector<LikeLimbs>& limbs) {
  const Groups groups(program);
  const LikeValues like = like_values(program, groups, limbs);
  if (like.sums.empty()) return {program, {}};
  std::map<ValueId, const SumOverLimbs*> sums;
  std::vector<bool> within(program.nodes.size());
  for (const SumOverLimbs& sum : like.sums) {
    sums[sum.root] = &sum;
    within[sum.root.value] = true;
  }
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    if (!within[i]) continue;
    for (const ValueId operand : {program.nodes[i].a, program.nodes[i].b})
      if (groups.is_within(operand)) within[operand.value] = true;
    if (sums.count(ValueId(i)) > 0) within[i] = false;
  }
  Copy copy(program);
  std::vector<ValueId> apart;
  const auto rewritten = [&](ValueId value) -> std::optional<Signed> {
    const auto it = sums.find(value);
    if (it == sums.end()) return {};
    std::multimap<ValueId, Signed> left;  // terms that are not added up yet
    for (const Term& term : groups.at(value)->terms)
      left.emplace(term.value, term.negative ? -copy[term.value] : copy[term.value]);
    std::vector<Signed> parts;
    for (const std::vector<std::size_t>& together : it->second->together)
      for (std::size_t l = 0; l < like.groups[together[0]].lanes.size(); ++l) {
        std::optional<Signed> part;
        for (const std::size_t group : together) {
          const Signed term = left.extract(like.groups[group].lanes[l].root).mapped();
          part = part ? copy.builder().add(*part, term) : term;
        }
        apart.push_back(part->value);
        parts.push_back(*part);
      }
    Signed sum = parts[0];
    for (std::size_t i = 1; i < parts.size(); ++i) sum = copy.builder().add(sum, parts[i]);
    for (const auto& [term, copied] : left) sum = copy.builder().add(sum, copied);
    return sum;
  };
  Program result = copy.run(rewritten, within);
  std::vector<bool> is_apart(result.nodes.size());
  for (const ValueId value : apart) is_apart[value.value] = true;
  return order_terms(Reordered{std::move(result), std::move(is_apart)});
}

}  // namespace jourdain::passes
