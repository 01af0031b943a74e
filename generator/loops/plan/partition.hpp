// Which velocities are independent, and in what order the others follow from them.
#pragma once

#include <optional>
#include <vector>

#include "loops/record/loop_plan.hpp"
#include "loops/rows/configuration.hpp"

namespace jourdain::loops {

struct Partition {
  std::vector<std::size_t> independent;
  std::vector<Block> blocks;
  double conditioning = 0;  ///< as in LoopPlan
};

/// Velocities that are chosen together: one of a scalar coordinate, three of a quaternion.
using Groups = std::vector<std::vector<std::size_t>>;
Groups velocity_groups(const model::Mechanism& mechanism);

/// `structure` are Jacobians that vanish only where a row has no such part: what blocks are made by.
///
/// The partition whose dependent block is conditioned best where it is worst, over Jacobians with only regular
/// rows. Where several are nearly as good the one with `preferred` velocities. Nothing where the groups do not fit.
std::optional<Partition> choose_partition(const std::vector<Matrix>& jacobians,
                                          const std::vector<Matrix>& structure, const Groups& groups,
                                          const std::vector<bool>& preferred);

/// The partition with these velocities independent; nothing where their number is not that of the degrees of freedom.
std::optional<Partition> given_partition(const std::vector<Matrix>& jacobians,
                                         const std::vector<Matrix>& structure,
                                         const std::vector<std::size_t>& independent);

/// Whether the dependent velocities do not follow from the others where G is that, but for rounding.
bool is_dead(const Matrix& G, const std::vector<Block>& blocks);

/// These rows of G at configurations that are open, with parameters off their default values.
std::vector<Matrix> open_rows(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                              const std::vector<Configuration>& configurations,
                              const std::vector<std::size_t>& rows);

/// Block triangular form of the dependent columns: the smallest square blocks in an order in which each needs
/// earlier ones only.
std::vector<Block> triangular_blocks(const std::vector<Matrix>& jacobians,
                                     const std::vector<std::size_t>& dependents);

}  // namespace jourdain::loops
