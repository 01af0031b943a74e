#include "loops/closed_form/roots.hpp"

#include <cmath>

namespace jourdain::loops {

std::optional<Vector2> Roots::direction(Vector2 n, Scalar gamma, double angle) {
  const Scalar size = dot(n, n);
  const Vector2 start = {number(std::cos(angle)), number(std::sin(angle))};
  const double side = at_start(cross(n, start)), scale = at_start(size);
  if (!(side * side > kDeadPosition * scale)) return std::nullopt;
  const Scalar root = square_root(size - gamma * gamma);
  require(difference({number(1), gamma * gamma / size}), true);
  require(size, false);  // where γ is 0 the margin is 1 without it
  return sum({gamma * n, (side > 0 ? root : -root) * quarter(n)}) / size;
}

std::optional<Scalar> Roots::slide(Scalar centre, Scalar discriminant, Scalar divisor, double start,
                                   Scalar size) {
  const Scalar margin = discriminant / size;
  if (!(at_start(margin) > kDeadPosition)) return std::nullopt;
  require(margin, true);
  const Scalar offset = square_root(discriminant) / divisor;
  const bool is_above = at_start((number(start) - centre) * divisor) > 0;
  return is_above ? centre + offset : centre - offset;
}

std::optional<Scalar> Roots::signed_root(Scalar value, Scalar side, Scalar size) {
  const Scalar margin = value / size;
  if (!(at_start(margin) > kDeadPosition)) return std::nullopt;
  require(margin, true);
  const Scalar root = square_root(value);
  return at_start(side) > 0 ? root : -root;
}

}  // namespace jourdain::loops
