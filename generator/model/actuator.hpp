// [[actuator]]
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"
#include "model/indices.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// A generalized force on one scalar coordinate, given at run time: gear_ratio times the input. The rotor adds
/// gear_ratio² rotor_inertia to the mass matrix (its gyroscopic coupling is neglected).
struct Actuator {
  std::string name;  ///< of the input
  JointIndex joint;
  std::size_t coordinate = 0;  ///< of the joint
  Expression gear_ratio = 1.0;
  Expression rotor_inertia;  ///< kg m² (kg along a prismatic coordinate), before the gear
  support::SourceRange where = {};
  bool implied = false;  ///< made by the reader: the description says nothing of inputs

  static constexpr std::string_view kKind = "actuator";
  std::optional<ScalarCoordinate> pushed() const { return {{joint, coordinate}}; }
  static std::vector<FrameIndex> ends() { return {}; }
  std::vector<Expression*> expressions() { return {&gear_ratio, &rotor_inertia}; }
  static bool conserves_energy() { return true; }
  static std::string assumption() { return ""; }
};

}  // namespace jourdain::model
