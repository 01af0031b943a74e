#include "loops/rows/search_programs.hpp"

#include <optional>

#include "ir/compose.hpp"
#include "passes/rewrite.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

using ir::JacobianEntries;
using ir::Signed;

ir::JacobianEntries changes_of_found(ir::Builder& builder, const SearchPrograms& searches,
                                     const std::vector<Signed>& found, const std::vector<ir::Seed>& seeds,
                                     const ir::Surroundings& surroundings) {
  if (searches.is_empty()) return {};
  // Where what is found is a leaf: as a value it may be one that misfits depend on otherwise, too.
  const std::vector<Signed> values = ir::insert(builder, searches.misfits);
  std::vector<Signed> misfits;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (searches.misfits.outputs[k].name == "misfit") misfits.push_back(values[k]);
  const JacobianEntries slopes = ir::differentiate(builder, misfits, seeds, {}, surroundings);
  JacobianEntries moves;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ir::Output& output = searches.misfits.outputs[k];
    if (output.name != "inverse") continue;
    const std::size_t row = support::subscript(output.row),
                      other = row / 2 * 2 + support::subscript(output.column);
    for (auto it = slopes.lower_bound({other, 0}); it != slopes.end() && it->first.first == other; ++it) {
      const Signed move = builder.multiply(values[k], it->second);
      const auto [known, is_new] = moves.try_emplace({row, it->first.second}, move);
      if (!is_new) known->second = builder.add(known->second, move);
    }
  }
  ir::Builder copy = builder;
  for (const auto& [at, move] : moves) copy.output("move", -1, -1, move);
  const std::vector<Signed> there = ir::insert(
      builder, passes::remove_dead_code(copy.finish("moves")), [&](ir::LeafKind kind, std::size_t k) {
        return kind == ir::LeafKind::kHeld ? std::optional(found[k]) : std::nullopt;
      });
  std::size_t k = 0;
  for (auto& [at, move] : moves) move = there[k++];
  return moves;
}

}  // namespace jourdain::loops
