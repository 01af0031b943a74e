// Which body, joint, frame or scalar coordinate of a mechanism is meant.
#pragma once

#include <cstddef>

#include "support/index.hpp"

namespace jourdain::model {

using BodyIndex = support::Index<struct BodyTag>;
using JointIndex = support::Index<struct JointTag>;
using FrameIndex = support::Index<struct FrameTag>;

/// A scalar coordinate of a joint, prescribed ones too.
struct ScalarCoordinate {
  JointIndex joint;
  std::size_t coordinate = 0;
};

}  // namespace jourdain::model
