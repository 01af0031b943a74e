// Which step lengths a method survives on a trajectory: predicted from the eigenvalues of the linearisation
// along it, and observed by runs that diverge or do not.
#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "model/coordinates.hpp"
#include "studies/flow.hpp"
#include "studies/mode_limits.hpp"
#include "studies/reference_solution.hpp"
#include "studies/work.hpp"

namespace jourdain::studies {

/// At one time of the trajectory.
struct StabilityPoint {
  double time = 0;                                ///< s
  std::vector<std::complex<double>> eigenvalues;  ///< 1/s
  std::vector<double> limits;  ///< s, by method; 0: none is stable, infinity: no limit is known
  double fastest = 0;          ///< largest |µ|, 1/s
  double stiffness = 0;        ///< largest −Re µ over the trajectory's own rate
};

struct CoordinateShare {
  std::string name;
  double share = 0;  ///< of 1
};

struct Stability {
  double rate = 0;                      ///< 1/s; the trajectory's own
  bool damps = false;                   ///< volumes in phase space shrink
  std::vector<StabilityPoint> points;   ///< in time; empty: not studied
  std::vector<MethodLimit> limits;      ///< by method
  std::complex<double> fastest;         ///< mode of the largest |µ| of all points, 1/s
  double fastest_time = 0;              ///< s
  std::vector<CoordinateShare> owners;  ///< of that mode, largest share first, down to a hundredth
  double stiffness = 0;                 ///< largest of the points'
  double transient_growth = 1;  ///< largest ‖R(hA)^k‖ over k at 0.9 of the limit, in balanced coordinates
  std::string transient_method;  ///< whose R that is; empty: not looked at
};

/// The longest limit of all methods that have one, where a damped fast mode decides on it and the motion
/// itself would allow far longer steps. Null where the scene is not stiff.
const MethodLimit* stiff_limit(const Stability& stability);

/// Along `reference`; `tangent` is that of the independent coordinates and says which entries of y are
/// quaternions. `seconds` of nominal work at most, see work.hpp.
Stability study_stability(const Flow<double>& flow, const ReferenceSolution& reference,
                          const model::Tangent& tangent, bool conserves_energy, double seconds,
                          const Progress& progress);

/// Runs that look for a limit.
struct LimitRuns {
  const Point<double>& start;
  const Eigen::VectorXd& direction;  ///< in which the start's velocities are displaced
  const Eigen::VectorXd& largest;    ///< velocities of the reference
  double predicted = 0;              ///< s
  double growth = 1;                 ///< of a difference per step, 2 % beyond the predicted limit
  ModeKind kind = ModeKind::kDamped;
  bool stiff = false;  ///< 2000 steps are short beside the motion
};

/// Bisects around the predicted limit. What diverges depends on the mode:
/// - undamped: a velocity is not finite or ten times the largest of the reference (entries count with a
///   hundredth of the largest at least), within 2000 steps at least;
/// - damped, `stiff`: a velocity is that largest one off a run with an eighth of the step, within 2000 steps
///   at least. Such runs often settle on a false oscillation before they get to ten times;
/// - damped: displaced and undisplaced run are a hundred times as far apart as those with an eighth of the
///   step have been, within 500 steps at least, or ten times the largest velocity: both may settle on the same
///   false oscillation. Neither resonance nor trajectories that part by themselves count.
/// Runs are long enough for a difference to grow e⁴⁰-fold 2 % beyond the limit, where a million steps and the
/// time do for that. None where runs diverge or hold at every h tried, from 0.28 to 3.6 times the predicted
/// one, or the budget is spent.
std::optional<ObservedLimit> observe_limit(const Flow<double>& flow, const jourdain_method& method,
                                           const LimitRuns& runs, Budget& budget);

/// Of a method for which linear theory gives no limit: runs from the start over `duration` (s), with steps
/// from an eighth of it down. One fails where a velocity is not finite or ten times the `largest` of the
/// reference. Either the longest h that held when no run failed, or the shortest that failed, to 1 %.
struct NonlinearLimit {
  std::optional<ObservedLimit> fails;
  std::optional<double> holds;  ///< s
};
NonlinearLimit observe_nonlinear_limit(const Flow<double>& flow, const jourdain_method& method,
                                       const Eigen::VectorXd& largest, double duration, Budget& budget);

}  // namespace jourdain::studies
