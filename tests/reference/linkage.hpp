// Mechanisms with loops, put together in code a part at a time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "model/mechanism.hpp"

namespace jourdain::tests {

using OptionalBody = std::optional<std::size_t>;  ///< none: the world

/// Adds parts to a mechanism; what is added last is also at the back of the mechanism's list.
struct Linkage {
  model::Mechanism mechanism;

  /// Principal moments of inertia about the centre of mass, along the body's axes.
  std::size_t add_body(const model::Expression& mass, const model::Vector3& center,
                       const std::array<model::Expression, 3>& moments);
  /// A body whose motion in the plane is what matters: centre (x, y), the same moment about all axes.
  std::size_t add_plate(const model::Expression& mass, const model::Expression& x, const model::Expression& y,
                        const model::Expression& moment);
  /// Along or about `axis` at `origin` of the parent, without rotation.
  model::Joint& add_joint(model::JointType type, OptionalBody parent, std::size_t child,
                          const model::Vector3& origin = {}, const std::array<double, 3>& axis = {0, 0, 1});
  model::FrameIndex add_frame(OptionalBody body, const model::Vector3& position = {},
                              const model::Vector3& rpy = {});
  /// Between two frames, axes along z.
  model::Loop& add_loop(model::LoopType type, model::FrameIndex from = {}, model::FrameIndex to = {});
};

/// A four-bar linkage in the xy plane: crank on the world at the origin, coupler on the crank, rocker on the world at
/// (ground, 0); bars along x at coordinate zero, angles absolute for crank and rocker, relative for the coupler.
struct FourBar {
  double crank = 0.3, coupler = 0.9, rocker = 0.7, ground = 0.8;  ///< m
  std::array<double, 3> masses{1.2, 2.5, 1.7};                    ///< kg
  std::array<double, 3> centers{0.1, 0.5, 0.3};                   ///< of mass, along the bars, m
  std::array<double, 3> moments{0.02, 0.15, 0.09};                ///< kg m²
};

/// The linkage under gravity along −y, its coupler's end joined to the rocker's end by `closing`; an actuator
/// on the crank. With `base`, all stands on a body that turns about z at the origin.
Linkage four_bar(const FourBar& bars, model::LoopType closing, bool base = false);

}  // namespace jourdain::tests
