// Everything that a report says about one model, method by method and step by step.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "model/mechanism.hpp"
#include "studies/advice.hpp"
#include "studies/alternatives.hpp"
#include "studies/error_sources.hpp"
#include "studies/extremes.hpp"
#include "studies/first_kind.hpp"
#include "studies/loop_residuals.hpp"
#include "studies/sensitivity.hpp"
#include "studies/stability.hpp"
#include "studies/touches.hpp"
#include "studies/work_precision.hpp"

namespace jourdain::studies {

struct StudyOptions {
  double duration = 2;          ///< s; rounded up to whole longest steps, four at least
  double longest_step = 0.016;  ///< s; also the interval at which errors are taken
  int halvings = 8;             ///< of the longest step down to the shortest
  ReferenceKind reference = ReferenceKind::kAutomatic;
  Question question;
  bool conserves_energy = false;
  bool hold_inputs = false;  ///< steps hold the inputs of their begin, instead of sampling them at the stages
  bool forms = true;         ///< compare with equations of the first kind
  std::vector<TouchFacts> touches = {};    ///< of the outputs that come last
  std::optional<double> penetration = {};  ///< m or rad: depth that is wanted of them
  double most_open = INFINITY;  ///< m, rad: by which constraints that follow from the others may be open
  double seconds = 8;           ///< of work for each costly part, nominal: counted, see work.hpp
};

/// How a method's error comes about, over the steps where the parts could be computed.
struct SourceSummary {
  std::size_t method = 0;
  std::optional<double> truncation_slope, propagation_slope, rounding_slope;  ///< of log(part) over log(h)
  std::optional<double>
      rounding_step;  ///< below this h (s) rounding is larger than what was propagated; none
                      ///< where that is far from the steps tried
  bool rounding_step_extrapolated = false;
  std::optional<double> linear_until;  ///< longest h (s) at which the parts predict the error within 10 %
};

/// Rounding alone, at steps too short for the other parts.
struct RoundingPoint {
  std::size_t method = 0;
  double h = 0;         ///< s
  ErrorNorms rounding;  ///< at the end
};

struct Study {
  StudyOptions options;
  bool has_kinks = false;  ///< of applied forces or of inputs
  double longer = 0;       ///< s: what the options' duration was rounded up by
  double judged = 0;       ///< s: duration, or less where the reference solutions part
  Divergence divergence;
  std::vector<double> steps;  ///< s, descending
  ReferenceSolution reference;
  WorkPrecision work;
  std::vector<ErrorSources> sources;     ///< method by method; empty without 50 digits
  std::vector<RoundingPoint> roundings;  ///< method by method, steps shorter than those of `sources`
  std::vector<SourceSummary> summaries;
  std::vector<FormCurve> forms;
  Stability stability;
  std::vector<ExtremeSweep> extremes;  ///< empty without 50 digits
  std::optional<Advice> advice;
  Alternatives alternatives;   ///< to the recommended step
  std::vector<LoopRun> loops;  ///< empty without loops
  std::optional<Touches> touches;
  std::optional<Untrusted> untrusted;  ///< at the shortest step; then there is no advice
};

/// `long_flow` may be null: no 50 digits then; `free` too: no emitted code of the first kind. Inputs and
/// starts of the flows are the same. `tangent` is that of the emitted State, of the independent coordinates;
/// `parameters` in the mechanism's order.
Study run_study(const model::Mechanism& mechanism, const model::Tangent& tangent,
                const std::vector<double>& parameters, const Flow<double>& flow,
                const Flow<LongReal>* long_flow, const EmittedFreeBodies* free, const StudyOptions& options,
                const Progress& progress);

}  // namespace jourdain::studies
