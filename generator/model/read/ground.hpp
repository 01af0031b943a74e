// What wheels, balls and points stand on: a plane, or a surface at a height over it.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// x, y, z as arguments 0, 1, 2.
Scope scope_of_places();

/// The key 'approaches', a whole number from `least` to 20; nothing where it is missing, or after a diagnostic.
std::optional<int> read_approaches(const TomlTable& table, int least);

/// The plane n·(p − o) = 0, in the inertial frame; with `height` h the surface n·(p − o) = h(x, y, z, t) of those p
/// that lie over the point (x, y, z) of the plane, which moves with ∂h/∂t along n.
class Ground {
 public:
  /// A plane that touches the surface; expressions of what a point's coordinates are made of, in the inertial frame.
  struct Plane {
    Vector3 normal;
    Expression behind;  ///< how far the point lies behind it, m
    Vector3 velocity;
  };
  /// From the centre of a round thing to where it touches a plane that has this normal.
  using Reach = std::function<Vector3(const Vector3& normal)>;

  /// Of the keys 'normal', 'point', 'height' and 'approaches'; the plane z = 0 after a diagnostic.
  explicit Ground(const TomlTable& table, std::string hint_for_normal = "");

  bool is_plane() const { return height_.is_zero(); }

  DrawnGround drawn(FrameIndex touching) const { return {touching, n_, o_, written_}; }

  /// The plane where something round with this centre touches. What is over x = (a·p, b·p) touches at x + reach(m(x')),
  /// with the normal m at x' = x + reach(m(x″)) and so on, `approaches` times, at first below the centre: each time the
  /// distance from the point that is meant is multiplied by radius times curvature.
  Plane touched(const Vector3& centre, const Reach& reach) const;

  /// Two directions along a plane, at right angles.
  std::array<Vector3, 2> along(const Plane& plane) const;

 private:
  Vector3 normal_at(const std::array<Expression, 2>& place) const;

  std::array<double, 3> n_;
  Vector3 o_, a_, b_;   ///< a point of the plane, and directions along it
  Expression written_;  ///< h of x, y, z
  // Of the two coordinates along the plane:
  Expression height_, slope_a_, slope_b_, rise_;  ///< h, ∂h/∂a, ∂h/∂b, ∂h/∂t
  int approaches_ = 4;
};

}  // namespace jourdain::model
