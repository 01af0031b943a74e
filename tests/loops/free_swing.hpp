// Judges free motion of compiled mechanisms with loops by what any user can see: where the bodies are, the
// energy, how far loops open. Nothing here knows how loops are closed.
#pragma once

#include <optional>
#include <string>

#include "loops/descriptor_swing.hpp"
#include "properties/random_linkages.hpp"

namespace jourdain::tests {

enum class Outcome {
  kRight,
  kFlagged,  ///< a guard stopped it; right until then
  kRefused,  ///< diagnostics instead of code, or a note that nothing can move
  kWrong,
  kLeftOut  ///< the reference does not agree with itself
};
inline constexpr std::size_t kOutcomes = 5;

struct Judgement {
  Outcome outcome = Outcome::kLeftOut;
  model::LoopTreatment treatment = model::LoopTreatment::kMultipliers;  ///< of what was compiled
  std::string why;             ///< diagnostics, what is wrong, what the guard saw
  double until = 0;            ///< judged until then, s
  double drift = 0;            ///< of the energy at the finer step, share of the largest kinetic energy
  double step = 0;             ///< the finer one of the two steps that decided, s
  std::size_t operations = 0;  ///< of a step
  std::size_t freedom = 0;     ///< degrees of freedom that the compiler counts
};

/// Compiles `linkage` and follows its motion at step lengths h and h/2 beside `known`, the motion of `linkage.ideal`.
/// `treatment`: asked for; none: the compiler chooses.
///
/// Wrong: bodies further off than ten times the error that the two steps extrapolate to, plus floors of
/// rounding, of the reference's doubt and of the perturbation; energy whose drift does not fall eight times at
/// half the step; open loops; no numbers. From h = 1 ms on; what is wrong there is tried again at shorter
/// steps, down to 1/16 ms, and wrong only if it stays so.
Judgement judge(const RandomLinkage& linkage, const KnownMotion& known, const Looks& looks,
                std::optional<model::LoopTreatment> treatment = {});

}  // namespace jourdain::tests
