#include "studies/amplification.hpp"

#include <cmath>
#include <numbers>

#include "studies/spectra.hpp"
#include "support/check.hpp"

namespace jourdain::studies {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Kind = StabilityFunction::Kind;

constexpr double kRounding = 1e-9;  ///< relative, of |R|: below it nothing grows
constexpr double kDefective =
    1e-3;  ///< of spectral radii: multiple eigenvalues lose half their digits and more
constexpr double kShortest = 1e-3;   ///< |hµ| where the search for a limit begins
constexpr double kLongest = 1e2;     ///< |hµ| where it ends
constexpr double kFactor = 1.02;     ///< of the search
constexpr double kPrecision = 1e-6;  ///< relative, of limits
constexpr double kMatrixPrecision = 1e-4;
constexpr double kMatrixFactor = 1.1;  ///< of the search with eigenvalues of matrices, which cost more

/// One line per method. Coefficients of rk5 are those of the six stages of Dormand and Prince.
const std::vector<StabilityFunction>& functions() {
  static const std::vector<StabilityFunction> list = {
      {"euler", Kind::kOneStep, {1, 1}},
      {"semi_implicit_euler", Kind::kPartitioned, {}},
      {"heun", Kind::kOneStep, {1, 1, 1. / 2}},
      {"rk4", Kind::kOneStep, {1, 1, 1. / 2, 1. / 6, 1. / 24}},
      {"rk5", Kind::kOneStep, {1, 1, 1. / 2, 1. / 6, 1. / 24, 1. / 120, 1. / 600}},
      {"adams_bashforth2", Kind::kMultistep, {}, {1}, {3. / 2, -1. / 2}},
      {"adams_bashforth3", Kind::kMultistep, {}, {1}, {23. / 12, -16. / 12, 5. / 12}},
      {"linearly_implicit_euler", Kind::kOneStep, {1}, {1, -1}},
  };
  return list;
}

Complex polynomial(const std::vector<double>& coefficients, Complex x) {
  Complex value = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) value = value * x + coefficients[k];
  return value;
}

/// Largest root of ζ^s = ζ^(s−1) + x Σ weights[j] ζ^(s−1−j).
double largest_root(const std::vector<double>& weights, Complex x) {
  const auto s = static_cast<Eigen::Index>(weights.size());
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(s, s);
  for (Eigen::Index j = 0; j < s; ++j) companion(0, j) = x * weights[std::size_t(j)];
  companion(0, 0) += 1.0;
  for (Eigen::Index j = 1; j < s; ++j) companion(j, j - 1) = 1;
  return spectral_radius(companion);
}

/// First argument at which `unstable` holds, searched from `first` to `last` in ratios of `factor`, then by bisection.
/// 0 where it holds down to `first` / 10⁴; infinity where it is never found.
template <class Unstable>
double first_unstable(double first, double last, double factor, double precision, Unstable&& unstable) {
  double low = first, high = first;
  if (unstable(first)) {
    for (low = first / 10; unstable(low); low /= 10)
      if (low < first * 1e-4) return 0;
  } else {
    for (high = first * factor; !unstable(high); low = high, high *= factor)
      if (high > last) return INFINITY;
  }
  while (high > low * (1 + precision)) {
    const double middle = std::sqrt(low * high);
    (unstable(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

const StabilityFunction* stability_function(std::string_view method) {
  for (const StabilityFunction& function : functions())
    if (function.method == method) return &function;
  return nullptr;
}

double amplification(const StabilityFunction& function, Complex x) {
  JD_CHECK(function.kind != Kind::kPartitioned, "{} has no stability function", function.method);
  if (function.kind == Kind::kMultistep) return largest_root(function.weights, x);
  return std::abs(polynomial(function.numerator, x) / polynomial(function.denominator, x));
}

MatrixXd step_matrix(const StabilityFunction& function, const MatrixXd& A, double h) {
  const Eigen::Index n = A.rows(), half = n / 2;
  const MatrixXd identity = MatrixXd::Identity(n, n);
  if (function.kind == Kind::kPartitioned) {
    MatrixXd velocities = identity, positions = identity;
    velocities.bottomRows(half) += h * A.bottomRows(half);
    positions.topRows(half) += h * A.topRows(half);
    return positions * velocities;
  }
  MatrixXd value = MatrixXd::Zero(n, n);
  for (std::size_t k = function.numerator.size(); k-- > 0;)
    value = h * A * value + function.numerator[k] * identity;
  return value;
}

// A factor that is no number, as of modes beyond the range of doubles, is unstable.
double step_limit(const StabilityFunction& function, Complex mu, Allowance allowed) {
  const double speed = std::abs(mu);
  const auto unstable = [&](double r) {
    return !(amplification(function, r / speed * mu) <=
             std::exp(std::min(allowed.growth * r / speed, 600.0)) * (1 + kRounding * std::min(1.0, r)));
  };
  return first_unstable(kShortest, kLongest, kFactor, kPrecision, unstable) / speed;
}

double step_limit(const StabilityFunction& function, const MatrixXd& A, double fastest, Allowance allowed) {
  const auto unstable = [&](double r) {
    return !(spectral_radius(step_matrix(function, A, r / fastest)) <=
             std::exp(std::min(allowed.growth * r / fastest, 600.0)) * (1 + kDefective));
  };
  constexpr double kFirst = 0.05;  // h‖A‖ below which growth is a matter of accuracy
  if (unstable(kFirst)) return 0;
  return first_unstable(kFirst, kLongest, kMatrixFactor, kMatrixPrecision, unstable) / fastest;
}

bool keeps_oscillations(const StabilityFunction& function) {
  constexpr double kSome = 0.1;  // growth of higher order passes for none below that
  return function.kind == Kind::kPartitioned || step_limit(function, Complex(0, 1), {}) > kSome;
}

std::vector<Complex> region_boundary(const StabilityFunction& function) {
  std::vector<Complex> curve;
  if (function.kind == Kind::kPartitioned) return curve;
  const double reach = step_limit(function, -1.0, {});
  if (!std::isfinite(reach)) return curve;
  constexpr int kRays = 180;
  const Complex centre = -reach / 2;
  for (int k = 0; k <= kRays; ++k) {
    const Complex ray = std::polar(1.0, 2 * std::numbers::pi * k / kRays);
    const double length = first_unstable(kShortest, kLongest, kFactor, kPrecision, [&](double r) {
      return amplification(function, centre + r * ray) > 1 + kRounding;
    });
    curve.push_back(centre + length * ray);
  }
  return curve;
}

}  // namespace jourdain::studies
