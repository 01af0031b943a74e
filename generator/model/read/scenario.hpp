// What drives a model in a simulation or a study: inputs as functions of time, or a motion to be followed.
#pragma once

#include <optional>
#include <vector>

#include "model/coordinates.hpp"
#include "model/mechanism.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// Expressions of t (s) and of the mechanism's parameters.
struct Scenario {
  std::vector<Expression>
      inputs;  ///< by input, N m, N, or as the description says; where nothing is followed
  std::vector<Expression>
      follow;  ///< by entry of y and z: the motion (rad, m) that inputs from inverse dynamics give
};

/// Reads a TOML text with one of
///
///   [input]                  # zero where left out
///   motor = "2*sin(3*t)"
///
///   [follow]                 # every coordinate; each needs an actuator
///   hinge = "0.5 - 0.5*cos(pi*t)"
///
/// Nothing after diagnostics.
std::optional<Scenario> read_scenario(support::Diagnostics& diagnostics, const Mechanism& mechanism);

}  // namespace jourdain::model
