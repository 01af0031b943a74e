// Which velocities are independent where some rows bind velocities alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loops/plan/partition.hpp"
#include "loops/rows/constraints.hpp"

namespace jourdain::loops {

/// By entry of `rows`: has the row a position form?
std::vector<bool> bind_positions(const ConstraintPrograms& constraints, const std::vector<std::size_t>& rows);

/// As choose_partition, in two steps: what rows of positions determine, then, of the other velocities, what the other
/// rows do.
std::optional<Partition> choose_with_velocities(const std::vector<Matrix>& jacobians,
                                                const std::vector<Matrix>& structure,
                                                const std::vector<bool>& bind_positions, const Groups& groups,
                                                const std::vector<bool>& preferred);

/// Why the dependent velocities of a partition of these rows, whose blocks count them from 0, may not be left out of
/// the state; empty where they may.
std::string why_not_reduced(const ConstraintPrograms& constraints, const std::vector<std::size_t>& rows,
                            const std::optional<Partition>& partition, const model::Mechanism& mechanism);

}  // namespace jourdain::loops
