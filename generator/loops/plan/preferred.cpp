#include "loops/plan/preferred.hpp"

#include <algorithm>

#include "model/coordinates.hpp"
#include "support/matrix_index.hpp"

namespace jourdain::loops {

namespace {

using support::at;

/// Where coordinates follow others these are preferred, and what no loop holds.
void prefer_leaders(const model::Mechanism& mechanism, const std::vector<Matrix>& jacobians,
                    std::vector<bool>& list) {
  const std::vector<std::size_t> following = following_velocities(mechanism);
  if (following.empty()) return;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto is_still = [&](const Matrix& G) { return G.col(at(k)).isZero(0); };
    if (std::all_of(jacobians.begin(), jacobians.end(), is_still)) list[k] = true;
  }
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  for (const model::Loop& loop : mechanism.loops)
    for (const model::Expression::Node& node : loop.residual.nodes())
      if (loop.follower && node.op == model::Expression::Op::kVariable)
        if (const auto entry = layout.joints[node.variable.index].velocity[node.variable.component])
          list[*entry] = true;
  for (const std::size_t k : following) list[k] = false;
}

}  // namespace

std::vector<bool> preferred_velocities(const model::Mechanism& mechanism,
                                       const std::vector<Matrix>& jacobians) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<bool> list(layout.velocity_count(), false);
  for_each_force_element(mechanism, [&](const auto& element) {
    const std::optional<model::ScalarCoordinate> at = element.pushed();
    if (!at) return;
    if (const auto entry = layout.joints[at->joint.value].velocity[at->coordinate]) list[*entry] = true;
  });
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].velocity[c];
          entry && !mechanism.joints[j].coordinates[c].initial_velocity.is_zero())
        list[*entry] = true;
  prefer_leaders(mechanism, jacobians, list);
  return list;
}

std::vector<std::size_t> following_velocities(const model::Mechanism& mechanism) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<std::size_t> list;
  for (const model::Loop& loop : mechanism.loops)
    if (loop.follower)
      if (const auto entry = layout.joints[loop.follower->joint.value].velocity[loop.follower->coordinate])
        list.push_back(*entry);
  return list;
}

std::vector<std::size_t> named_independent(const model::Mechanism& mechanism) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<std::size_t> list;
  for (const auto& name : mechanism.loop_options.independent)
    list.push_back(*layout.joints[name.joint.value].velocity[name.coordinate]);
  return list;
}

std::vector<std::size_t> ranged_velocities(const model::Mechanism& mechanism) {
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  std::vector<std::size_t> list;
  for (std::size_t j = 0; j < mechanism.joints.size(); ++j)
    for (std::size_t c = 0; c < mechanism.joints[j].coordinates.size(); ++c)
      if (const auto entry = layout.joints[j].velocity[c]; entry && mechanism.joints[j].coordinates[c].range)
        list.push_back(*entry);
  std::sort(list.begin(), list.end());
  return list;
}

}  // namespace jourdain::loops
