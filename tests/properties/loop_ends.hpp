// Closes random loops of a mechanism where it stands: the second end of a loop joint is put where the first
// one needs it.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "model/mechanism.hpp"
#include "properties/random.hpp"
#include "reference/rotation.hpp"

namespace jourdain::tests {

/// A small function of time that is zero together with its rate at t = 0: A (1 − cos(ω t)).
model::Expression departure(Random& random);

/// Adds loop joints whose constraints hold at the initial positions at t = 0, to rounding of the model's numbers.
class LoopEnds {
 public:
  /// `tilt`: the mechanism moves in the xy plane turned by these angles (roll, pitch, yaw), and all bodies' z axes are
  /// normal to it; none: it moves in space.
  LoopEnds(model::Mechanism& mechanism, const std::optional<std::array<double, 3>>& tilt, Random& random)
      : mechanism_(mechanism), tilt_(tilt), random_(random) {}

  /// Closes a loop between two bodies, or a body and the world.
  void close(model::LoopType type);

 private:
  using Vector = reference::Vector3<long double>;
  using Matrix = reference::Matrix3<long double>;
  struct Pose {
    Matrix R;
    Vector p;
  };

  Pose pose(const model::Frame& frame) const;
  Pose pose_of_body(std::optional<model::BodyIndex> body) const;
  model::Frame random_frame(std::optional<model::BodyIndex> body);
  model::FrameIndex add(const model::Frame& frame);
  std::array<double, 3> direction(bool in_plane);
  void choose_axes(model::Loop& loop, const Pose& carrier);
  Vector offset(model::Loop& loop, const Pose& from, const Pose& carrier);
  Vector standing(model::Loop& loop, const Pose& from, const Matrix& R);
  Matrix turned(const model::Loop& loop, const Matrix& R_WF);
  std::pair<model::Expression, long double> quantity();
  void add_residual(model::Loop& loop);

  model::Mechanism& mechanism_;
  std::optional<std::array<double, 3>> tilt_;
  Random& random_;
};

}  // namespace jourdain::tests
