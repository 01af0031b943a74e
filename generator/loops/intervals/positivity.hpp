// Proof by interval arithmetic that values of a program are positive over a box of positions.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "ir/builder.hpp"
#include "ir/program_intervals.hpp"
#include "loops/intervals/variable.hpp"

namespace jourdain::loops {

struct Bound {
  ir::Signed value;
  double least = 0;  ///< the value must be greater
};

/// The leaves that vary, each over a finite interval, and the intervals of all leaves.
struct Region {
  std::vector<Variable> entries;
  ir::LeafValues<support::Interval> leaves;
};

/// Where a proof ended without success.
struct Counterexample {
  std::size_t bound = 0;
  std::vector<double> position;  ///< of the entries that vary
  bool violated =
      false;  ///< the value is too small there; otherwise it is not shown to be large enough nearby
};

struct Effort {
  std::size_t boxes = 200000;
  int halvings = 22;     ///< of one side
  bool is_sharp = true;  ///< otherwise a bound that is kept is enough
};

/// A lower bound of each value over the region, half of its least value or better as long as effort is left.
/// The region is halved until on each part an enclosure of the values decides: the natural one, or f(m) + Σ
/// ∂f/∂y (y − m) about its middle (mean-value form), whichever is narrower; the natural one alone where
/// values may jump.
std::variant<std::vector<double>, Counterexample> prove_bounds(const ir::Builder& builder,
                                                               const std::vector<Bound>& bounds,
                                                               const Region& region, Effort effort = {});

}  // namespace jourdain::loops
