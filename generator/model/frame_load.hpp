// [[force]] on a frame
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"
#include "model/indices.hpp"
#include "model/touch.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

enum class LoadAxes { kFrame, kWorld };

/// A force at the origin of a frame and a free moment on its body. Components are expressions of time, coordinates,
/// velocities, inputs and frames.
struct Load {
  std::string name;
  FrameIndex frame;
  LoadAxes axes = LoadAxes::kFrame;
  Vector3 force;   ///< N
  Vector3 moment;  ///< N m
  std::optional<Touch> touch = {};
  support::SourceRange where = {};

  static constexpr std::string_view kKind = "force";
  static std::optional<ScalarCoordinate> pushed() { return {}; }
  std::vector<FrameIndex> ends() const { return {frame}; }
  std::vector<Expression*> expressions() {
    std::vector<Expression*> all = {&force[0], &force[1], &force[2], &moment[0], &moment[1], &moment[2]};
    if (touch) all.insert(all.end(), {&touch->depth, &touch->stiffness});
    return all;
  }
  static bool conserves_energy() { return false; }
  static std::string assumption() { return ""; }
};

}  // namespace jourdain::model
