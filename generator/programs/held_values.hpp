// Values that change as what determines them does, not by the steps that they are computed in: points that are looked
// for, multipliers.
#pragma once

#include <vector>

#include "ir/jacobian.hpp"
#include "ir/symmetric_factors.hpp"
#include "loops/rows/search_programs.hpp"

namespace jourdain::programs {

/// Values of one builder, with their seeds.
struct HeldValues {
  ir::Column values;
  std::vector<ir::Seed> seeds;

  /// `changes` by number of a candidate and column. Each value is held once, and leaves are not: they have their own
  /// seeds.
  void add(const ir::Builder& builder, const ir::Column& candidates, const ir::JacobianEntries& changes);

  /// ∂values/∂columns, with seeds of leaves.
  ir::JacobianEntries differentiated(ir::Builder& builder, const ir::Column& values,
                                     std::vector<ir::Seed> leaves,
                                     const ir::Surroundings& surroundings) const;
};

HeldValues held_points(ir::Builder& builder, const loops::SearchPrograms& searches,
                       const std::vector<ir::Seed>& leaves, const ir::Surroundings& surroundings);

/// Entries as outputs, in their order.
ir::Program jacobian_program(ir::Builder& builder, const ir::JacobianEntries& entries);

}  // namespace jourdain::programs
