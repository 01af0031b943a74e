// Directions that are right angles but for the digits they were written with.
#pragma once

#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Multiples of a quarter turn that four decimals hold (1.5708, 3.1416, 4.7124, 6.2832) are off by 1.5e-5 rad at most.
inline constexpr double kDefaultSnap = 2e-5;
/// Beyond that an angle is another one.
inline constexpr double kMaximumSnap = 0.01;

/// Of the mechanism's size: lengths below are rounding.
inline constexpr double kLengthRounding = 1e-15;

/// Each constant angle of a rotation within `tolerance` (rad) of a multiple of a quarter turn becomes that
/// multiple, each axis within it of a coordinate axis or plane lies on that; `mechanism.snapped` keeps what
/// stood there. One note says how many there are. Without a note, lengths of at most kLengthRounding times the radius
/// of gyration of all bodies become 0 (places of joints and frames, centres of mass), and products of inertia of at
/// most kLengthRounding times the least moment of their body.
void snap_directions(Mechanism& mechanism, double tolerance, support::Diagnostics& diagnostics);

/// The mechanism with the directions that its description gives; no angle is read as a quarter turn.
Mechanism with_directions_as_read(Mechanism mechanism);

}  // namespace jourdain::model
