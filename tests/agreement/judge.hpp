// One state of a mechanism, its exact equations of motion there, and how far computed values are from them.
#pragma once

#include <string>
#include <vector>

#include "dynamics/equations.hpp"
#include "dynamics/high_precision.hpp"
#include "ir/module.hpp"
#include "reference/minimal.hpp"

namespace jourdain::tests {

/// Values of everything that an emitted function reads.
struct Sample {
  double t = 0;
  std::vector<double> parameters, y, z, u, zdot;
  double h = 0;  ///< of a step that begins, s
};

/// Seeded: state and inputs as in random_tree.hpp, parameters within a tenth of their defaults, accelerations
/// in ±5. With `single`, every number is one of float.
Sample random_sample(const model::Mechanism& mechanism, std::uint64_t seed, bool single = false);

/// Outputs of the function `name`, computed by the interpreter.
template <class Real>
std::vector<Real> interpreted(const ir::Module& module, const std::string& name, const Sample& sample);

/// A mechanism with all that the compiler makes of it before emission.
struct Derived {
  model::Mechanism mechanism;
  dynamics::Equations equations;
  ir::Module module;  ///< all functions, optimised
};

Derived derive(model::Mechanism mechanism, const dynamics::DerivationOptions& options = {});

/// The equations at one sample: in 60 digits from the symbolic statements, term sums from the numeric reference.
class Judge {
 public:
  Judge(const Derived& derived, const Sample& sample);

  /// Largest over the rows of |M ż − k̄ + q̄| / (Σ|M||ż| + Σ|k̄ terms| + Σ|q̄ terms|), M, k̄, q̄ in 60 digits.
  double backward_error(const std::vector<double>& zdot) const;

  /// ‖ż − ż_exact‖ / ‖ż_exact‖.
  double forward_error(const std::vector<double>& zdot) const;

  /// Largest difference of an entry from the exact one, in units of its term sum. M: upper triangle by rows.
  double mass_matrix_error(const std::vector<double>& M) const;
  double k_bar_error(const std::vector<double>& k) const;
  double q_bar_error(const std::vector<double>& q) const;
  double torque_error(const std::vector<double>& tau) const;

  /// In 60 digits.
  support::ScaledReal exact(const kinematics::Ex& expression) const { return exact_.value(expression); }

  double condition() const { return condition_; }
  const reference::Terms<long double>& terms() const { return terms_; }

 private:
  std::vector<double> values(const std::vector<kinematics::Ex>& expressions) const;

  const dynamics::Equations& equations_;
  dynamics::HighPrecision exact_;
  reference::Terms<long double> terms_;
  reference::VectorX<long double> torque_scale_;
  double condition_;
};

}  // namespace jourdain::tests
