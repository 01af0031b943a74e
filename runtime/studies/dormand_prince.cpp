#include "studies/dormand_prince.hpp"

#include <algorithm>
#include <cmath>

namespace jourdain::studies {

namespace {

constexpr double kNodes[] = {0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
/// The last row has the weights of order 5.
constexpr double kStage[7][6] = {{},
                                 {1.0 / 5},
                                 {3.0 / 40, 9.0 / 40},
                                 {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                 {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                 {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                 {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
/// Weights of order 5 less those of order 4.
constexpr double kError[] = {71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                             -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
/// Of the term that the interpolation has beside the Hermite polynomial.
constexpr double kDense[] = {-12715105075.0 / 11282082432,  0,
                             87487479700.0 / 32700410799,   -10690763975.0 / 1880347072,
                             701980252875.0 / 199316789632, -1453857185.0 / 822651844,
                             69997945.0 / 29380423};

constexpr double kSafety = 0.9, kLeastFactor = 0.2, kGreatestFactor = 5;
constexpr double kStretch = 1.01;  ///< of the last step
constexpr double kExponent = 0.2;  ///< 1 over the order
constexpr int kMostAttempts = 50;
constexpr double kShortestStep = 16 * 0x1p-52;  ///< step over |t|

/// Σ weights[s] k[s][i] over the first `count` stages.
template <class Stages>
double combined(const double* weights, const Stages& k, std::size_t count, std::size_t i) {
  double sum = 0;
  for (std::size_t s = 0; s < count; ++s) sum += weights[s] * k[s][i];
  return sum;
}

}  // namespace

DormandPrince::DormandPrince(CountedRates& rates, const Point<double>& start, double end, double tolerance)
    : rates_(rates),
      end_(end),
      tolerance_(tolerance),
      next_(rates.size()),
      earlier_(rates.size()),
      work_(rates.size()) {
  for (std::size_t s = 0; s < kStages; ++s) k_[s] = last_[s] = Vector(rates.size());
  restart(start);
}

void DormandPrince::restart(const Point<double>& point) {
  t_ = point.t;
  x_ = point.x;
  h_ = 0;
}

double DormandPrince::scaled_norm(const Vector& v, const Vector& a, const Vector& b) const {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double size = std::max(std::fabs(a[i]), std::fabs(b[i]));
    const double ratio = v[i] / (tolerance_ * (0.1 + size));
    sum += ratio * ratio;
  }
  return std::sqrt(sum / static_cast<double>(v.size()));
}

double DormandPrince::starting_step() {
  rates_(t_, x_.data(), k_[0].data());
  const double d0 = scaled_norm(x_, x_, x_), d1 = scaled_norm(k_[0], x_, x_);
  const double h0 = std::min(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1, end_ - t_);
  for (std::size_t i = 0; i < x_.size(); ++i) next_[i] = x_[i] + h0 * k_[0][i];
  rates_(t_ + h0, next_.data(), k_[1].data());
  for (std::size_t i = 0; i < x_.size(); ++i) work_[i] = (k_[1][i] - k_[0][i]) / h0;
  const double largest = std::max(d1, scaled_norm(work_, x_, x_));
  const double h1 = largest <= 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / largest, kExponent);
  return std::min(100 * h0, h1);
}

double DormandPrince::attempt(double h) {
  const std::size_t size = x_.size();
  for (std::size_t s = 1; s < kStages; ++s) {
    for (std::size_t i = 0; i < size; ++i) next_[i] = x_[i] + h * combined(kStage[s], k_, s, i);
    rates_(t_ + kNodes[s] * h, next_.data(), k_[s].data());
  }
  for (std::size_t i = 0; i < size; ++i) work_[i] = h * combined(kError, k_, kStages, i);
  return scaled_norm(work_, x_, next_);
}

void DormandPrince::accept(double h) {
  before_ = t_;
  length_ = h;
  t_ = h == end_ - t_ ? end_ : t_ + h;
  earlier_.swap(x_);
  x_.swap(next_);
  last_.swap(k_);
  k_[0] = last_[kStages - 1];
}

bool DormandPrince::step() {
  if (h_ == 0) h_ = starting_step();
  double greatest = kGreatestFactor;
  for (int i = 0; i < kMostAttempts; ++i) {
    const double h = kStretch * h_ < end_ - t_ ? h_ : end_ - t_;  // no tiny step is left at the end
    if (!(h > kShortestStep * std::fabs(t_))) return false;
    const double error = attempt(h);
    const double factor = std::isfinite(error) ? kSafety * std::pow(error, -kExponent) : kLeastFactor;
    h_ = h * std::clamp(factor, kLeastFactor, greatest);
    if (error <= 1) {
      accept(h);
      return true;
    }
    greatest = 1;
  }
  return false;
}

void DormandPrince::interpolate(double t, double* x) {
  const double a = (t - before_) / length_, b = 1 - a;
  for (std::size_t i = 0; i < x_.size(); ++i) {
    const double way = x_[i] - earlier_[i], bend = length_ * last_[0][i] - way;
    const double skew = way - length_ * last_[kStages - 1][i] - bend;
    const double rest = length_ * combined(kDense, last_, kStages, i);
    x[i] = earlier_[i] + a * (way + b * (bend + a * (skew + b * rest)));
  }
}

}  // namespace jourdain::studies
