// Poses as numbers: where SDF frames are, which are given relative to any other.
#pragma once

#include <array>

#include "model/matrix3.hpp"
#include "model/mechanism.hpp"

namespace jourdain::model {

/// Of a frame B in a frame A: x_A = rotation x_B + position.
struct SdfPose {
  Matrix3 rotation = kIdentity3;
  Numbers3 position{};  ///< m

  bool is_identity() const { return rotation == kIdentity3 && position == Numbers3{}; }
};

/// X_AC of X_AB and X_BC.
SdfPose operator*(const SdfPose& a, const SdfPose& b);

/// X_AB of X_WA and X_WB; coordinates that are rounding beside theirs are zero.
SdfPose relative(const SdfPose& a, const SdfPose& b);

/// Rᵀ v.
Numbers3 turned_back(const Matrix3& R, const Numbers3& v);

/// As a mechanism has it; `where` is of what gives its angles.
Placement placement_of(const SdfPose& pose, double tolerance, SourceRange where);

}  // namespace jourdain::model
