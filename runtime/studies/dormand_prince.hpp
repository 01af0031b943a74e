// The pair of orders 5 and 4 of Dormand and Prince, A family of embedded Runge-Kutta formulae, J. Comp. Appl.
// Math. 6 (1980), with the starting step and the step control of Hairer, Nørsett and Wanner, Solving Ordinary
// Differential Equations I, II.4.
#pragma once

#include <array>

#include "studies/adaptive_integrator.hpp"

namespace jourdain::studies {

/// Advances with order 5. The last evaluation of a step is the first of the next one: six calls of f for each attempt.
class DormandPrince : public AdaptiveIntegrator {
 public:
  /// `rates` must outlive this. Relative tolerance `tolerance` of each entry, absolute a tenth of it.
  DormandPrince(CountedRates& rates, const Point<double>& start, double end, double tolerance);

  bool step() override;
  double time() const override { return t_; }
  /// Of order 4 within the step (the same book, II.6).
  void interpolate(double t, double* x) override;
  void restart(const Point<double>& point) override;

 private:
  using Vector = std::vector<double>;
  static constexpr std::size_t kStages = 7;

  double starting_step();
  /// Stages of a step of length h, its end in `next_`; the estimated error over the tolerance, as a root mean square.
  double attempt(double h);
  double scaled_norm(const Vector& v, const Vector& a, const Vector& b) const;
  void accept(double h);

  CountedRates& rates_;
  double end_, tolerance_;
  double t_ = 0, h_ = 0;            ///< reached; the next step to try
  double before_ = 0, length_ = 0;  ///< begin and length of the last step
  Vector x_, next_, earlier_, work_;
  std::array<Vector, kStages> k_, last_;  ///< stages of the attempt; those of the last step
};

}  // namespace jourdain::studies
