// Which of two solutions is meant, and what must be positive for it to exist.
#pragma once

#include <optional>
#include <vector>

#include "loops/closed_form/near_states.hpp"

namespace jourdain::loops {

/// What must be positive wherever the solution is used.
struct Condition {
  Scalar value;
  /// sin² of the angle from a dead position, where two solutions meet; otherwise the square of a divisor.
  bool is_margin = true;
};

/// Roots of equations in values of a program; of two solutions those that pass through the initial state are taken.
class Roots {
 public:
  /// sin² at the initial state below which it does not say which solution is meant.
  static constexpr double kDeadPosition = 1e-10;

  Roots(ir::Builder& builder, const Samples& samples) : builder_(builder), samples_(samples) {}

  Scalar number(double value) const { return {&builder_, builder_.literal(value)}; }
  double at_start(Scalar value) const { return initial(value, samples_); }
  const Samples& samples() const { return samples_; }

  void require(Scalar value, bool is_margin) { conditions_.push_back({value, is_margin}); }
  const std::vector<Condition>& conditions() const { return conditions_; }

  /// The solution e of n · e = γ with |e| = 1 that is nearer to the initial angle; nothing at a dead position.
  std::optional<Vector2> direction(Vector2 n, Scalar gamma, double angle);

  /// centre ± √discriminant / divisor, nearer to `start`; the margin is the discriminant over `size`.
  std::optional<Scalar> slide(Scalar centre, Scalar discriminant, Scalar divisor, double start, Scalar size);

  /// √value, negative where `side` is at the initial state; the margin is the value over `size`.
  std::optional<Scalar> signed_root(Scalar value, Scalar side, Scalar size);

 private:
  ir::Builder& builder_;
  const Samples& samples_;
  std::vector<Condition> conditions_;
};

}  // namespace jourdain::loops
