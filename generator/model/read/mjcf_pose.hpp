// Places and directions as MJCF spells them.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "model/matrix3.hpp"
#include "model/mechanism.hpp"

namespace jourdain::model {

/// Where a frame stands in another: origin (m) and orientation, columns are the frame's axes.
struct Pose {
  Numbers3 origin{};
  Matrix3 R = kIdentity3;
};

/// `inner`, given in `outer`, seen from where `outer` is given.
Pose composed(const Pose& outer, const Pose& inner);
/// The frame that `pose` is given in, seen from the frame at `pose`.
Pose inverse(const Pose& pose);
/// A point given in the frame at `pose`.
Numbers3 point_at(const Pose& pose, const Numbers3& point);
Numbers3 times(const Numbers3& v, double factor);

/// By `angle`, rad, about an axis of any length; nothing where that is zero or not finite.
std::optional<Matrix3> rotation_about(const Numbers3& axis, double angle);
/// x lies along `x`, y in the plane of `x` and `y`; nothing where these are parallel.
std::optional<Matrix3> rotation_from_axes(const Numbers3& x, const Numbers3& y);
/// The smallest that turns z into the direction of `z`; half a turn about x where that is -z. Nothing for zero.
std::optional<Matrix3> rotation_to(const Numbers3& z);
/// Three angles (rad) about the axes that `sequence` names: lower case of the frame turned so far, upper case of the
/// frame that it started from.
Matrix3 rotation_from_euler(const Numbers3& angles, const std::string& sequence);

/// As the model has it. Angles that reach a quarter turn of pitch are found as exactly as any.
Placement placement_of(const Pose& pose, SourceRange where);

}  // namespace jourdain::model
