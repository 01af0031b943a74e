// Translation validation: what is about to be written is compared with the symbolic statements in 60 digits, and those
// with the numeric reference. Nothing is emitted unless all agree.
#pragma once

#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "ir/module.hpp"
#include "model/mechanism.hpp"

namespace jourdain::validate {

/// Largest error that passes, relative to the sum of the absolute values of an entry's terms (design section 3).
inline constexpr double kTolerance = 1e-12;

/// Largest relative change of the accelerations that snapping rotations may cause: kSnapTolerance, amplified by moderate
/// condition numbers.
inline constexpr double kSnapEffect = 1e-5;

struct Verdict {
  std::size_t states = 0;      ///< seeded random states compared
  double backward_error = 0;   ///< of M ż = k̄ − q̄, program in double, relative to its term sum; worst
  double entry_error = 0;      ///< of an entry of M, k̄, q̄ and other outputs, program in double; worst
  double reference_error = 0;  ///< between symbolic statements and numeric reference; worst
  double condition =
      0;  ///< of M as emitted, with loops where they are closed; 2-norm, SI units as they are; worst
  double snap_effect = 0;             ///< change of ż by snapping, norm over norm; worst
  std::vector<std::string> failures;  ///< sentences; empty: accepted

  bool accepted() const { return failures.empty(); }
};

/// Compares at `states` seeded random states; the first is the initial state, and tunable parameters are varied by up
/// to a tenth from the second on.
/// Derivatives are compared along a random direction at each state. Where derivatives of the residual hold
/// those of applied forces alone, `load` are the equations without gravity, whose q̄ they belong to.
Verdict validate_translation(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                             const ir::Module& module, std::size_t states = 8,
                             const dynamics::Equations* load = nullptr);

}  // namespace jourdain::validate
