// Mass and inertia of homogeneous shapes.
#pragma once

#include "model/mechanism.hpp"

namespace jourdain::model {

/// m³; zero for a rod, which is thin.
Expression volume(const Shape& shape);

/// Inertia of `mass` (kg) spread evenly over the shape, about its centre in its axes. A rod has none about
/// its axis.
Inertia shape_inertia(const Shape& shape, const Expression& mass);

}  // namespace jourdain::model
