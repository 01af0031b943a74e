// Integrators that choose their own steps, called with emitted code as a user would call them.
#pragma once

#include <memory>
#include <vector>

#include "studies/flow.hpp"

namespace jourdain::studies {

/// f(t, x) of a flow by the table's function, without copies between; inputs are sampled. Counts its calls.
class CountedRates {
 public:
  explicit CountedRates(const Flow<double>& flow) : flow_(flow), u_(flow.inputs().at(0.0)) {}

  /// `x` and `f` have size() entries.
  void operator()(double t, const double* x, double* f) {
    ++calls_;
    if (!u_.empty()) u_ = flow_.inputs().at(t);
    const std::size_t velocities = flow_.position_count();
    flow_.table().rates(&t, x, x + velocities, u_.data(), f, f + velocities);
  }

  const Flow<double>& flow() const { return flow_; }
  std::size_t size() const { return flow_.size(); }
  long calls() const { return calls_; }

 private:
  const Flow<double>& flow_;
  std::vector<double> u_;
  long calls_ = 0;
};

/// From a start to an end, which no step goes beyond.
class AdaptiveIntegrator {
 public:
  virtual ~AdaptiveIntegrator() = default;
  /// One step that it accepts, with as many attempts as that takes; false where it gives up.
  virtual bool step() = 0;
  /// That it has reached, s.
  virtual double time() const = 0;
  /// x(t) within the last step.
  virtual void interpolate(double t, double* x) = 0;
  /// Goes on from another point, without memory of what was before.
  virtual void restart(const Point<double>& point) = 0;
};

/// What a run took; counts are exact and repeat.
struct AdaptiveRun {
  std::vector<Point<double>> points;  ///< as far as it came
  long steps = 0;                     ///< accepted
  long calls = 0;                     ///< of f, with those of rejected attempts, Jacobians and the start
  long worst_calls = 0;               ///< of one step
  bool finished = false;
};

/// Solution at `times` (s, ascending). Where loops are open by more than `tolerance` at one of them they are
/// closed, and the integrator starts anew. Gives up beyond `call_limit` calls of f.
AdaptiveRun follow(AdaptiveIntegrator& integrator, const CountedRates& rates,
                   const std::vector<double>& times, double tolerance, long call_limit);

}  // namespace jourdain::studies
