// What the equations are functions of, in symbols and in programs alike.
#pragma once

#include <cstddef>
#include <cstdint>

namespace jourdain::support {

/// Where a leaf's value comes from. kConstant: a value of the model that depends on parameters only, computed once; no
/// symbol stands for one. kMultiplier: of a loop's row; none is left in an emitted function. kStepLength: in what is
/// sampled at the start of a step. kHeld: a number whose changes are given apart while rows of loops are
/// differentiated; none is left in an emitted function.
enum class LeafKind : std::uint8_t {
  kParameter,
  kConstant,
  kPosition,
  kVelocity,
  kAcceleration,
  kMultiplier,
  kInput,
  kTime,
  kStepLength,
  kHeld
};
inline constexpr std::size_t kLeafKinds = 10;

}  // namespace jourdain::support
