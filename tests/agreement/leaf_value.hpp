// A sample as the values of the leaves of symbolic equations.
#pragma once

#include "agreement/judge.hpp"

namespace jourdain::tests {

inline double leaf_value(const Sample& sample, kinematics::LeafKind kind, std::size_t i) {
  switch (kind) {
    case kinematics::LeafKind::kConstant:
    case kinematics::LeafKind::kParameter:
      return sample.parameters[i];
    case kinematics::LeafKind::kPosition:
      return sample.y[i];
    case kinematics::LeafKind::kVelocity:
      return sample.z[i];
    case kinematics::LeafKind::kAcceleration:
      return sample.zdot[i];
    case kinematics::LeafKind::kMultiplier:
    case kinematics::LeafKind::kHeld:
      return 0;
    case kinematics::LeafKind::kInput:
      return sample.u[i];
    case kinematics::LeafKind::kTime:
      return sample.t;
    case kinematics::LeafKind::kStepLength:
      return sample.h;
  }
  return 0;
}

}  // namespace jourdain::tests
