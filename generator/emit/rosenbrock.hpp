// Coefficients of linearly implicit methods.
#pragma once

#include <string>
#include <vector>

namespace jourdain::emit {

/// Coefficients of u-form: with γ the diagonal of Γ, A = α Γ⁻¹, C = 1/γ − Γ⁻¹, m = Γ⁻ᵀ b (Hairer, Wanner:
/// Solving Ordinary Differential Equations II, section IV.7).
struct Rosenbrock {
  std::string name;
  double gamma = 0;
  std::vector<std::vector<double>> A, C;  ///< strictly lower triangles, by stage
  std::vector<double> m;
  std::vector<double> nodes;   ///< time of each stage, of h
  std::vector<double> shares;  ///< of h ∂/∂t, by stage
};

/// Nothing where the stepper is no Rosenbrock method.
const Rosenbrock* find_rosenbrock(const std::string& name);

/// Whether the step ends at its last stage plus the last increments.
bool ends_at_last_stage(const Rosenbrock& method);

}  // namespace jourdain::emit
