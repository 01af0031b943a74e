// The solution that all errors of a study are measured against, with its own error.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::studies {

enum class ReferenceKind { kAutomatic, kExtrapolation, kCvode };

/// Reports what is being done and how much of it is, from 0 to 1.
using Progress = std::function<void(const std::string& what, double done)>;

/// What became of the solution in 50 digits. Contradicted: CVODE's is another one.
enum class InFiftyDigits { kNotTried, kTooCostly, kContradicted, kSolved };

/// States at start.t + k `interval`. Shorter than asked for where solutions with two tolerances part by more
/// than kParted.
struct ReferenceSolution {
  std::string method;                  ///< in words
  double interval = 0;                 ///< s
  std::vector<Point<double>> points;   ///< rounded to double
  std::vector<Point<LongReal>> exact;  ///< in 50 digits; empty with CVODE
  InFiftyDigits digits = InFiftyDigits::kNotTried;
  Residuals open;  ///< of the loops, largest at the points
  double error =
      0;  ///< largest difference of an entry to the solution with the other, looser tolerance, over 1 + |x|
  double position_error = 0;  ///< the same of positions alone, rad or m
};

/// Difference of two solutions, over 1 + |x|, beyond which neither is a reference.
inline constexpr double kParted = 1e-6;

/// By extrapolation on `long_flow` where there is one, its cost allows and CVODE on `flow` agrees; otherwise by CVODE.
/// `interval` times `count` is the duration (s); the times between are kept as well, by extrapolation in intervals of
/// `interval` / 2^k, as fine as `seconds` of work allow, by CVODE of an eighth. Where CVODE does not
/// agree with what was asked for by `kind`, the error says how far apart they are. Throws EnvironmentError where no
/// method gets through.
ReferenceSolution solve_reference(const Flow<double>& flow, const Flow<LongReal>* long_flow,
                                  ReferenceKind kind, double interval, long count, int halvings,
                                  double seconds, const Progress& progress);

/// Of a solution at a method's steps.
inline constexpr long kMostPoints = 400000;

/// The same solution at `steps` points for each `sampling` (s), a multiple of the reference's interval, by CVODE.
/// `position_error` is what it differs from `reference` by where both have points. Nothing where CVODE gives up, or
/// where these are more than kMostPoints.
std::optional<ReferenceSolution> reference_at_steps(const Flow<double>& flow,
                                                    const ReferenceSolution& reference, double sampling,
                                                    long steps);

}  // namespace jourdain::studies
