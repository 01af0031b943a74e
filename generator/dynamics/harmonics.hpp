// Expanded equations for people to read: trigonometric polynomials with products turned into sums, which is a unique
// form. For mechanisms of a few coordinates only; nothing emitted passes through here.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "dynamics/equations.hpp"

namespace jourdain::dynamics {

/// Σ (c_k cos(k·y) + s_k sin(k·y)) with integer vectors k whose first non-zero entry is positive. Coefficients are
/// polynomials in parameters, velocities, inputs and the coordinates of prismatic joints.
class Harmonics {
 public:
  struct Coefficients {
    Ex cosine = 0, sine = 0;
  };

  Harmonics() = default;
  explicit Harmonics(const Ex& constant) { add({}, constant, 0); }
  static Harmonics cosine(std::vector<int> k);
  static Harmonics sine(std::vector<int> k);

  Harmonics operator+(const Harmonics& other) const;
  Harmonics operator*(const Harmonics& other) const;

  /// Expanded coefficients; terms that vanish are dropped.
  const std::map<std::vector<int>, Coefficients>& terms() const { return terms_; }

 private:
  /// Adds c cos(k·y) + s sin(k·y) for any k.
  void add(std::vector<int> k, const Ex& c, const Ex& s);

  std::map<std::vector<int>, Coefficients> terms_;
};

/// `value` with all statements put in. `y[i]` are the symbols of the coordinates. Throws InternalError where
/// `value` is no trigonometric polynomial (a quotient, say).
Harmonics expand(const Equations& equations, const Ex& value);

/// "m2*l1*l2*cos(y1) + …" with terms and factors in an order that depends on the names alone; LaTeX if asked for.
std::string to_text(const Harmonics& harmonics, bool latex);

/// "2 \\cdot 10^{-7}" of 2e-07.
std::string latex_number(double value);

/// What `negative` is where `decides` is negative, and `otherwise` elsewhere.
std::string latex_cases(const std::string& decides, const std::string& negative,
                        const std::string& otherwise);

/// "y_{1}" from "y1", "\\mathrm{mass}_{2}" from "mass2".
std::string latex_name(const std::string& name);

}  // namespace jourdain::dynamics
