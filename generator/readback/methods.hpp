// Time stepping methods by their published coefficients, stated here independently of what writes them.
#pragma once

#include <string>
#include <vector>

namespace jourdain::readback {

struct Fraction {
  long numerator = 0, denominator = 1;
};

/// Explicit Runge-Kutta: k_i = f(t + c_i h, x + h Σ a_ij k_j), x + h Σ b_i k_i.
struct Tableau {
  std::vector<std::vector<Fraction>> a;  ///< strictly lower, by row
  std::vector<Fraction> b, c;
};

/// Nothing where the method is no explicit Runge-Kutta method: "rk4".
const Tableau* find_tableau(const std::string& method);

/// Weights of rates of this and earlier steps, newest first: x + h Σ w_k f_k.
std::vector<Fraction> adams_bashforth(int steps);

/// A Rosenbrock method: with u = Γ k, x + Σ m_j u_j; stages at x + Σ A_ij u_j; Γ⁻¹ = (1 − S)/γ. The
/// coefficients are the doubles nearest to those of the published method in this form.
struct RosenbrockTable {
  double gamma = 0;
  std::vector<std::vector<double>> A, S;  ///< strictly lower, by stage
  std::vector<double> m;
  std::vector<double> nodes;   ///< time of each stage, of h
  std::vector<double> shares;  ///< Σ_j Γ_ij: of h ∂/∂t, by stage
};

/// Nothing where the method is no Rosenbrock method.
const RosenbrockTable* find_rosenbrock_table(const std::string& method);

/// Of "rk4_step"; linearly implicit methods may lose some where derivatives leave terms out. 0: no step of
/// that name, or not without all derivatives.
int order_of(const std::string& step, bool all_derivatives);

}  // namespace jourdain::readback
