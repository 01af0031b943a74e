#include "passes/limb_sums.hpp"

#include <map>
#include <utility>

#include "passes/association.hpp"
#include "passes/rewrite.hpp"
#include "passes/sampled_rounding.hpp"

namespace jourdain::passes {

using ir::Op;
using ir::Program;
using ir::Signed;
using ir::ValueId;

namespace {

struct ByLimb {
  Association association;
  std::vector<std::size_t> parts;  ///< places of what limbs have added up
};

ByLimb by_limb(const Group& group, const SumOverLimbs& sum, const std::vector<LikeGroups>& groups) {
  ByLimb result;
  std::multimap<ValueId, std::size_t> left;  // terms that are not added up yet
  for (const Term& term : group.terms) {
    left.emplace(term.value, result.association.terms.size());
    result.association.terms.push_back({term.value, term.negative});
  }
  const auto join = [&](std::optional<std::size_t>& whole, std::size_t place) {
    whole = whole ? result.association.join(*whole, place) : place;
  };
  for (const std::vector<std::size_t>& together : sum.together)
    for (std::size_t l = 0; l < groups[together[0]].lanes.size(); ++l) {
      std::optional<std::size_t> part;
      for (const std::size_t p : together) join(part, left.extract(groups[p].lanes[l].root).mapped());
      result.parts.push_back(*part);
    }
  std::optional<std::size_t> whole;
  for (const std::size_t part : result.parts) join(whole, part);
  for (const auto& [term, place] : left) join(whole, place);
  return result;
}

/// Values within the groups of these roots.
std::vector<bool> within(const Program& program, const Groups& groups,
                         const std::map<ValueId, ByLimb>& roots) {
  std::vector<bool> marked(program.nodes.size());
  for (std::size_t i = program.nodes.size(); i-- > 0;) {
    if (!marked[i] && roots.count(ValueId(i)) == 0) continue;
    for (const ValueId operand : {program.nodes[i].a, program.nodes[i].b})
      if (groups.is_within(operand)) marked[operand.value] = true;
  }
  return marked;
}

}  // namespace

Reordered limb_by_limb(const Program& program, const std::vector<LikeLimbs>& limbs) {
  const Groups groups(program);
  const LikeValues like = like_values(program, groups, limbs);
  const SampledRounding rounding(program);
  std::map<ValueId, ByLimb> sums;
  for (const SumOverLimbs& sum : like.sums) {
    ByLimb way = by_limb(*groups.at(sum.root), sum, like.groups);
    if (rounding.admits(sum.root, Op::kAdd, way.association)) sums.emplace(sum.root, std::move(way));
  }
  if (sums.empty()) return {program, {}};
  Copy copy(program);
  std::vector<ValueId> apart;
  const auto rewritten = [&](ValueId value) -> std::optional<Signed> {
    const auto it = sums.find(value);
    if (it == sums.end()) return {};
    const std::vector<Signed> places = places_in(copy, Op::kAdd, it->second.association);
    for (const std::size_t part : it->second.parts) apart.push_back(places[part].value);
    return places.back();
  };
  Program result = copy.run(rewritten, within(program, groups, sums));
  std::vector<bool> is_apart(result.nodes.size());
  for (const ValueId value : apart) is_apart[value.value] = true;
  return order_terms(Reordered{std::move(result), std::move(is_apart)});
}

}  // namespace jourdain::passes
