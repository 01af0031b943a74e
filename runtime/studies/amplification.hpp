// What a method does with one mode of a linear system in one step: the theory that predicted step limits rest on.
#pragma once

#include <Eigen/Dense>

#include <complex>
#include <string_view>
#include <vector>

namespace jourdain::studies {

/// How a method treats x' = µ x. One-step methods: x_{n+1} = R(hµ) x_n with R a quotient of polynomials,
/// coefficients in ascending powers. Adams–Bashforth methods: x_{n+1} = x_n + hµ Σ weights[j] x_{n−j}. Semi-implicit
/// Euler moves positions with the new velocities: what it does depends on the whole linear system, not on one mode.
struct StabilityFunction {
  enum class Kind { kOneStep, kMultistep, kPartitioned };
  std::string_view method;  ///< name of the stepper, without "_step"
  Kind kind = Kind::kOneStep;
  std::vector<double> numerator, denominator = {1};
  std::vector<double> weights = {};
};

/// Null for methods that are not on the list: none of these is known to have a limit.
const StabilityFunction* stability_function(std::string_view method);

/// |R(x)|, or the largest root of the multistep recursion, at x = hµ. Not for partitioned methods.
double amplification(const StabilityFunction& function, std::complex<double> x);

/// Matrix of one step of length h (s) on x' = A x, A 2nz × 2nz with positions first. One-step methods with a
/// polynomial, and partitioned ones.
Eigen::MatrixXd step_matrix(const StabilityFunction& function, const Eigen::MatrixXd& A, double h);

/// What a mode may do in a step before it counts as unstable: |R(hµ)| ≤ exp(`growth` h) (1 + tolerance).
struct Allowance {
  double growth = 0;  ///< 1/s
};

/// Smallest h (s) at which the mode µ (1/s) grows faster than allowed; 0 where every h does, infinity where none does.
double step_limit(const StabilityFunction& function, std::complex<double> mu, Allowance allowed);

/// The same of the whole linear system x' = A x, for partitioned methods.
double step_limit(const StabilityFunction& function, const Eigen::MatrixXd& A, double fastest,
                  Allowance allowed);

/// Whether some piece of the imaginary axis from 0 on is stable.
bool keeps_oscillations(const StabilityFunction& function);

/// Boundary of the region |R(x)| ≤ 1 in the x = hµ plane, one closed curve. Empty for partitioned methods and
/// regions that are not bounded.
std::vector<std::complex<double>> region_boundary(const StabilityFunction& function);

}  // namespace jourdain::studies
