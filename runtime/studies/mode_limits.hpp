// The largest stable step of each method at each time, from the modes of the linearisation.
//
// Frozen eigenvalues wander off to both sides of what they are in the mean as a scene moves: oscillations are
// judged with their mean damping ratio along the trajectory, none where that is less than a tenth of what they
// wander. A mode counts as *damped* or *growing* by its sign, as *undamped* without damping. In a scene that
// damps nothing (energy is conserved, or volumes in the phase space of coordinates and momenta do not shrink)
// every mode that rather oscillates is undamped. *Fast* modes, |µ| above three times the trajectory's own
// rate, are those that a method need not follow but has to survive: they decide; slow ones only where no fast
// one has a limit. Frozen coefficients predict a limit only while they hardly change: of modes above thirty
// times that rate, or where the limits at all points agree, and at steps of which four or more make the time.
// Of growing modes nothing is predicted. Elsewhere the smallest of the points' limits is no more than an
// estimate, and runs alone say what is stable. A method that lets every undamped mode grow has no stable step
// ("none: undamped mode") unless a damped mode asks for a step so short that undamped ones grow less than
// e-fold over the trajectory.
#pragma once

#include <complex>
#include <optional>
#include <string_view>
#include <vector>

#include "studies/amplification.hpp"
#include "studies/local_dynamics.hpp"

namespace jourdain::studies {

/// Growing: also the decaying half of a pair where nothing damps.
enum class ModeKind { kDamped, kUndamped, kGrowing };

/// A step length at which runs begin to diverge, found by bisection to 1 %.
struct ObservedLimit {
  double h = 0;      ///< s; shortest tried that diverged
  double start = 0;  ///< s; runs begin at the reference's state then, velocities displaced along the mode
  long steps = 0;    ///< of a run near h
};

/// Of one method over the whole trajectory.
struct MethodLimit {
  std::size_t method = 0;
  double h = 0;               ///< s; smallest of the points' limits, 0 and infinity as there
  double time = 0;            ///< s; where that is
  std::complex<double> mode;  ///< that decides, 1/s; the fastest where the whole system decides
  ModeKind kind = ModeKind::kDamped;
  bool fast = false;                      ///< see above
  bool predicts = false;                  ///< frozen coefficients hold, see above; else h is an estimate
  bool implicit = false;                  ///< the method is linearly implicit and L-stable: h is infinite
  std::optional<ObservedLimit> observed;  ///< none where runs show no limit near a predicted one
  std::optional<double>
      stable_until;  ///< nothing predicted: longest h tried (s), at which the run held, as at shorter ones
};

/// What is known of it, s: predicted, or observed where nothing is; 0: none is stable, infinity: nothing is known.
double largest_stable_step(const MethodLimit& limit);

/// Is `h` (s) beyond a limit that is predicted? Never where no step is stable: errors show what undamped modes grow by.
bool is_beyond(const MethodLimit& limit, double h);

ModeKind kind_of(std::complex<double> mu, const Scene& scene);

/// Limits of one method at each of `locals` where they predict anything, and the smallest one that decides;
/// method 0 in all of them.
struct LimitsAlong {
  std::vector<double> limits;  ///< s; 0: none is stable, infinity: no limit is known
  MethodLimit smallest;
};
LimitsAlong limits_along(std::string_view method, const std::vector<Local>& locals, const Scene& scene);

/// Whether a damped mode far faster than the trajectory holds the step far below the trajectory's own time.
bool is_stiff(const MethodLimit& limit, double rate);

}  // namespace jourdain::studies
