// Tables of systems with known solutions, in double and in 50 digits, written by hand.
#pragma once

#include "jourdain/long_real.hpp"
#include "jourdain/model_table.h"
#include "studies/flow.hpp"

namespace jourdain::tests {

/// The oscillator y'' = −y from y = 1 at rest, so that y = cos t, with explicit Euler ("first") and the classical
/// Runge-Kutta method ("fourth"). It has one input, which pushes.
const jourdain_model_table& oscillator(double);
const jourdain_model_table& oscillator(const LongReal&);

/// y'' = 25 y from y = 1e-3 at rest: separations grow as cosh 5t.
const jourdain_model_table& unstable(double);

/// Without force.
class NoForce : public studies::Inputs {
 public:
  std::vector<double> at(double) const override { return {0}; }
  std::vector<LongReal> at(const LongReal&) const override { return {LongReal(0.0)}; }
};

}  // namespace jourdain::tests
