// How far accelerations computed in double and in float are from the exact ones, in units of their unit roundoff.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "extremes/extreme_scenes.hpp"

namespace jourdain::tests {

/// Of M at one state, in 60 digits, by Frobenius norms.
struct Conditioning {
  double condition = 1;  ///< ‖M‖‖M⁻¹‖, units taken as they are
  double scaled = 1;     ///< the same of M scaled to a unit diagonal
  double moments = 1;    ///< largest by smallest diagonal entry of angular coordinates
};

/// M may be taken as regular in a precision with unit roundoff u where the scaled condition is below
/// kRegular/u: Cholesky's method is sure to end there (Demmel 1989), and the pivots of LᵀDL are its.
inline constexpr double kRegular = 0x1p-6;

/// Of ż computed in one precision by the optimised program, at a state that is exact in that precision. Errors
/// in units of u = 2⁻⁵³ or 2⁻²⁴; exact values are those of the symbolic equations in 60 digits.
struct Accuracy {
  double backward = 0;  ///< largest over the rows of |M ż − k̄ + q̄| / (Σ|M||ż| + Σ|k̄ terms| + Σ|q̄ terms|)
  double forward = 0;  ///< ‖ż − ż_exact‖ / ‖ż_exact‖
  double loss = 1;     ///< multiple of the usual rounding that the family's loss explains
  Conditioning conditioning;
  bool regular = true;      ///< there is a solution in this precision
  bool left_range = false;  ///< some intermediate overflowed or underflowed
};

struct Measurement {
  int exponent = 0;  ///< the swept value is 2^exponent
  std::uint64_t seed = 0;
  Accuracy in_double, in_float;
};

/// Of the accelerations of `derived` at `sample` rounded to Real: double or float.
template <class Real>
Accuracy accuracy(const Derived& derived, const Sample& sample, Loss loss);

/// Measures a family value by value. A scene that does not depend on the value is derived once.
class Sweep {
 public:
  explicit Sweep(const Family& family) : family_(family) {}

  /// At random states of the seeds 0 … seeds − 1.
  std::vector<Measurement> at(int exponent, std::uint64_t seeds);

  /// What the compiler's own validation says against the scene last derived; empty: accepted.
  std::vector<std::string> refusals() const;

 private:
  void prepare(int exponent);

  const Family& family_;
  std::optional<Derived> derived_;
};

/// A mechanism as the compiler derives it, with the algorithm chosen by counting.
Derived derive_extreme(const model::Mechanism& mechanism);

}  // namespace jourdain::tests
