// Generalized coordinates against equations of the first kind: the same scene in descriptor form (absolute coordinates,
// multipliers), plain and projected onto its constraints after each step, beside the numeric reference in minimal
// coordinates. These three are plain numeric code with the same classical Runge-Kutta method, so that their
// times compare. Where the scene was compiled as free bodies as well, emitted code in both coordinates is
// compared in the same way.
#pragma once

#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "studies/flow.hpp"
#include "studies/free_bodies.hpp"
#include "studies/reference_solution.hpp"

namespace jourdain::studies {

struct FormPoint {
  double h = 0;               ///< s
  double position_error = 0;  ///< largest of the bodies' centres of mass along the way, m
  double angle_error = 0;     ///< largest of the bodies' orientations along the way, rad
  double drift = 0;           ///< largest |g| of the position constraints along the way, m or rad
  double rate_drift = 0;      ///< largest |G x + g_t|
  double step_time = 0;       ///< s, mean
  bool finite = true;
};

struct FormCurve {
  std::string form;  ///< "minimal coordinates", "descriptor form", …
  int states = 0;    ///< numbers that are integrated
  int unknowns = 0;  ///< of the linear system at each evaluation
  std::vector<FormPoint> points;
};

/// The result of `as_free_bodies`, compiled, with the inputs and parameters of the flow that it is compared with.
struct EmittedFreeBodies {
  const model::Mechanism& mechanism;
  Flow<double> flow;
};

/// Curves over `steps` (s, descending, divisors of `sampling`), each as far as `seconds` of work allow.
/// `parameters` in the mechanism's order; `reference` is of `flow`. `free` may be null. With loops there are
/// no plain minimal coordinates to compare with.
std::vector<FormCurve> study_forms(const model::Mechanism& mechanism, const std::vector<double>& parameters,
                                   const Flow<double>& flow, const EmittedFreeBodies* free,
                                   const std::vector<double>& steps, double sampling,
                                   const ReferenceSolution& reference, double seconds,
                                   const Progress& progress);

}  // namespace jourdain::studies
