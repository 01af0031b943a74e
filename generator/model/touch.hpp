// What a one-sided element is pressed by.
#pragma once

#include "model/expression.hpp"

namespace jourdain::model {

/// A ground, a tyre or a stop pushes where `depth` is positive: by stiffness depth^exponent where nothing moves.
struct Touch {
  Expression depth;      ///< m; rad of a stop of an angle
  Expression stiffness;  ///< of parameters
  double exponent = 1;
};

}  // namespace jourdain::model
