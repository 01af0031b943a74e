#include "loops/plan/velocity_partition.hpp"

#include <algorithm>

#include "loops/rows/regular_rows.hpp"
#include "model/coordinates.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

std::vector<Matrix> rows_of(const std::vector<Matrix>& jacobians, const std::vector<std::size_t>& rows) {
  std::vector<Matrix> parts;
  for (const Matrix& G : jacobians) parts.emplace_back(G(rows, Eigen::all));
  return parts;
}

/// Those of the entries listed, in their order.
template <class Entry>
std::vector<Entry> entries_of(const std::vector<Entry>& all, const std::vector<std::size_t>& list) {
  std::vector<Entry> entries;
  for (const std::size_t k : list) entries.push_back(all[k]);
  return entries;
}

/// Groups of the velocities `free`, by their places there.
Groups groups_within(const Groups& groups, const std::vector<std::size_t>& free) {
  Groups within;
  for (const std::vector<std::size_t>& group : groups) {
    std::vector<std::size_t> places;
    for (const std::size_t k : group)
      if (const auto place = std::find(free.begin(), free.end(), k); place != free.end())
        places.push_back(static_cast<std::size_t>(place - free.begin()));
    if (!places.empty()) within.push_back(places);
  }
  return within;
}

bool takes_part_of_rotation(const Block& block, const model::Tangent& tangent) {
  return std::any_of(tangent.quaternions.begin(), tangent.quaternions.end(), [&](const auto& rotation) {
    return std::any_of(block.dependents.begin(), block.dependents.end(),
                       [&](std::size_t k) { return k >= rotation.velocity && k < rotation.velocity + 3; });
  });
}

}  // namespace

std::vector<bool> bind_positions(const ConstraintPrograms& constraints,
                                 const std::vector<std::size_t>& rows) {
  std::vector<bool> list;
  for (const std::size_t row : rows)
    list.push_back(
        std::none_of(constraints.velocities.outputs.begin(), constraints.velocities.outputs.end(),
                     [row](const ir::Output& output) { return support::subscript(output.row) == row; }));
  return list;
}

std::optional<Partition> choose_with_velocities(const std::vector<Matrix>& jacobians,
                                                const std::vector<Matrix>& structure,
                                                const std::vector<bool>& bind_positions, const Groups& groups,
                                                const std::vector<bool>& preferred) {
  std::vector<std::size_t> of_positions, of_velocities;
  for (std::size_t r = 0; r < bind_positions.size(); ++r)
    (bind_positions[r] ? of_positions : of_velocities).push_back(r);
  const auto n = static_cast<std::size_t>(jacobians.front().cols());
  std::vector<std::size_t> closed;
  if (!of_positions.empty()) {
    const auto positions = choose_partition(rows_of(jacobians, of_positions),
                                            rows_of(structure, of_positions), groups, preferred);
    if (!positions) return {};
    closed = all_but(positions->independent, n);
  }
  const std::vector<std::size_t> free = all_but(closed, n);
  std::vector<Matrix> rest;
  for (const Matrix& G : jacobians) {
    rest.emplace_back(G(of_velocities, free));
    if (closed.empty()) continue;
    const Matrix follow = Matrix(G(of_positions, closed)).fullPivLu().solve(Matrix(G(of_positions, free)));
    rest.back() -= G(of_velocities, closed) * follow;
  }
  const auto chosen = choose_partition(rest, rest, groups_within(groups, free), entries_of(preferred, free));
  if (!chosen) return {};
  return given_partition(jacobians, structure, entries_of(free, chosen->independent));
}

std::string why_not_reduced(const ConstraintPrograms& constraints, const std::vector<std::size_t>& rows,
                            const std::optional<Partition>& partition, const model::Mechanism& mechanism) {
  if (!constraints.searches.is_empty()) return "points on the ground are looked for";
  if (!partition || partition->blocks.empty() || !(partition->conditioning > 0))
    return "no choice of them is regular at the configurations seen";
  if (partition->independent.empty()) return "there is no freedom";
  const std::vector<bool> of_positions = bind_positions(constraints, rows);
  const model::Tangent tangent = model::lay_out_coordinates(mechanism).tangent;
  for (const Block& block : partition->blocks) {
    const auto count = std::count_if(block.rows.begin(), block.rows.end(),
                                     [&](std::size_t row) { return of_positions[row]; });
    if (count != 0 && count != static_cast<std::ptrdiff_t>(block.rows.size()))
      return "positions and velocities would depend on each other";
    if (count == 0 && takes_part_of_rotation(block, tangent))
      return "the angular velocity of a rotation in space would follow from others";
  }
  return "";
}

}  // namespace jourdain::loops
