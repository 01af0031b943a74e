// When a run is not to be believed any more, and why that may be.
#pragma once

#include <string>

#include "model/coordinates.hpp"
#include "studies/flow.hpp"

namespace jourdain::commands {

/// Bounds that no valid run reaches, taken from its start. A run leaves them where
/// - a number of the state, or the energy, is not finite;
/// - a velocity exceeds 1e12 times the largest one at the start (1 rad/s or m/s where that is less);
/// - the scene conserves energy and the total has changed by 1e6 times what there was at the start, kinetic
///   energy, |potential energy| and the kinetic energy of unit velocities together, and by a hundredth of what
///   there is now.
/// Positions have no bound: bodies may be thrown far away and turn as often as they like. A body that falls
/// keeps its energy.
class RunBounds {
 public:
  RunBounds(const studies::Flow<double>& flow, const studies::Point<double>& start, bool conserves_energy);

  /// How `point` is out of bounds, a clause; empty: it is not.
  std::string breach(const studies::Point<double>& point) const;

 private:
  struct Energies {
    double kinetic = 0, potential = 0;  ///< J
  };
  Energies energies(double t, const double* y, const double* z) const;
  std::string energy_breach(const studies::Point<double>& point) const;

  const jourdain_model_table& table_;
  bool conserves_energy_ = false;
  double fastest_ = 0;      ///< rad/s, m/s
  double energy_ = 0;       ///< J, total at the start
  double most_energy_ = 0;  ///< J, change of it
};

/// Where a run left its bounds.
struct Breach {
  studies::Point<double> last, end;  ///< one step apart; within and out of bounds
  std::string what;                  ///< as RunBounds::breach, LoopGuard::problem or StepGuard::problem says
  /// Bounds that the run leaves, loops that open, a motion that grows.
  enum class Of { kBounds, kLoops, kGrowth } of = Of::kBounds;
};

/// The error message: where and how, and why. Where bounds are left either rates are not finite at `last` or half a
/// step or one from there, so that the equations are singular, or the step is too long: for a mode of the linearisation
/// at the start or at `last` that `method` cannot follow, where there is one. Modes slower than 1/2 in a step are not
/// judged. `tangent` is displaced_tangent of the scene, `h` the step, s.
std::string breach_text(const studies::Flow<double>& flow, const model::Tangent& tangent,
                        const Breach& breach, const std::string& method, double h);

/// A clause on the modes at the start, or else at `point`, that `method` cannot follow in steps of `h`, s; empty where
/// there is none. As for breach_text.
std::string step_limit_text(const studies::Flow<double>& flow, const model::Tangent& tangent,
                            const studies::Point<double>& point, const std::string& method, double h);

}  // namespace jourdain::commands
