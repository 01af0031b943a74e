// [[force]] on a joint
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

/// A generalized force on one scalar coordinate: an expression of time, coordinates, velocities, inputs and frames.
struct CoordinateForce {
  std::string name;
  JointIndex joint;
  std::size_t coordinate = 0;
  Expression force;  ///< N m or N; positive pushes forward
  std::optional<Touch> touch = {};
  support::SourceRange where = {};

  static constexpr std::string_view kKind = "force";
  std::optional<ScalarCoordinate> pushed() const { return {{joint, coordinate}}; }
  static std::vector<FrameIndex> ends() { return {}; }
  std::vector<Expression*> expressions() {
    std::vector<Expression*> all = {&force};
    if (touch) all.insert(all.end(), {&touch->depth, &touch->stiffness});
    return all;
  }
  static bool conserves_energy() { return false; }
  static std::string assumption() { return ""; }
};

}  // namespace jourdain::model
