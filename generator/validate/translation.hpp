// Validation before anything is written: programs are compared with the symbolic equations, and those with the numeric
// reference, in 77 digits; what programs lose in double is measured apart. Nothing is emitted unless all agree.
#pragma once

#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "ir/module.hpp"
#include "model/mechanism.hpp"
#include "validate/agreement.hpp"
#include "validate/kinks.hpp"

namespace jourdain::validate {

struct Verdict {
  std::size_t states = 0;  ///< compared
  double backward_error =
      0;  ///< of M ż = k̄ − q̄, program in double, relative to the sum of absolute terms; worst
  double entry_error =
      0;  ///< of all numbers that programs compute, in double, relative to their scales; worst
  double condition =
      0;  ///< of M as emitted, with loops where they are closed; 2-norm, SI units as they are; worst
  std::vector<Compared> compared;     ///< what with what, in the order of comparison
  std::vector<std::string> failures;  ///< sentences; empty: accepted
  std::size_t overflows = 0;          ///< of the failures: numbers that double has no room for
  std::string advice;                 ///< where the only failure is the description's; empty: it is not
  Kinks kinks;

  bool accepted() const { return failures.empty(); }
};

/// "4.1e+01", or that it is too large to be told.
std::string condition_text(const Verdict& verdict);

/// "1e-40", and what closed forms agree to.
std::string algebra_text(const Verdict& verdict);

/// Refuses what no state was left for; `states` and `kinks` are known.
void judge_kinks(Verdict& verdict);

/// Takes over what was compared.
void conclude(const Agreement& agreement, Verdict& verdict);

/// Compares at `states` seeded random states; the first is the initial state, and tunable parameters are varied by up
/// to a tenth from the second on. Fewer states where each takes long, more where that shows another side of a kink.
/// Derivatives are compared along a random direction at each state. Where derivatives of the residual hold
/// those of applied forces alone, `load` are the equations without gravity, whose q̄ they belong to.
Verdict validate_translation(const model::Mechanism& mechanism, const dynamics::Equations& equations,
                             const ir::Module& module, std::size_t states = 8,
                             const dynamics::Equations* load = nullptr);

}  // namespace jourdain::validate
