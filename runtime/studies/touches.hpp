// How deep one-sided elements are pressed, and what keeps them within a wanted depth.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/work_precision.hpp"

namespace jourdain::studies {

/// An element that pushes by stiffness d^exponent at a depth d; the emitted outputs end with the depths.
struct TouchFacts {
  std::string name;
  std::string unit;  ///< of the depth: m, rad
  double stiffness = 0;
  double exponent = 1;
};

struct TouchRun {
  double deepest = 0;  ///< 0: never touched
  double start = 0;    ///< depth of the start
  double at = 0;       ///< s: when
  double share = 0;    ///< of the steps that end touching
};

/// Along the most accurate run of the study, at the end of each step.
struct Touches {
  std::size_t method = 0;
  double h = 0;                ///< s
  ErrorNorms error;            ///< of that run, largest along the way
  std::vector<TouchRun> runs;  ///< by element
};

/// Nothing where there is no element, or no run of the study is finite.
std::optional<Touches> study_touches(const Flow<double>& flow, const std::vector<TouchFacts>& elements,
                                     const WorkPrecision& work, double duration);

/// What keeps an element within a depth, with a fifth of it in reserve, estimated: that of an impact falls with
/// k^(-1/(e + 1)), and what touches moves as fast as a mass on its slope k e d^(e - 1).
struct Stiffening {
  double stiffness = 0;   ///< k (deepest/(0.8 wanted))^(e + 1)
  double step_share = 1;  ///< steps by that much shorter: 0.8 wanted/deepest
};
Stiffening stiffening(const TouchFacts& element, double deepest, double wanted);

}  // namespace jourdain::studies
