// Mass and inertia of homogeneous shapes.
#pragma once

#include <cstddef>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// Lengths in m; kBox uses `size`, the others `radius`, `length` and `axis` as far as they have them.
struct Shape {
  enum class Kind { kBox, kCylinder, kSphere, kRod };
  Kind kind = Kind::kBox;
  Vector3 size = {};
  Expression radius = {};
  Expression length = {};
  std::size_t axis = 2;  ///< 0, 1, 2: the length lies along x, y, z
};

/// m³; zero for a rod, which is thin.
Expression volume(const Shape& shape);

/// Inertia of `mass` (kg) spread evenly over the shape, about its centre in its axes. A rod has none about
/// its axis.
Inertia shape_inertia(const Shape& shape, const Expression& mass);

}  // namespace jourdain::model
