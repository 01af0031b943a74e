// [[state]] and [[memory]]
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/expression.hpp"
#include "model/indices.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::model {

/// A number that moves by a differential equation of first order beside the mechanism: a current, a pressure, what a
/// filter or a controller holds. Its rate is an expression of time, coordinates, velocities, inputs, frames and states.
/// In the equations of motion it is the velocity of a unit inertia that only its rate pushes and that has no position.
/// One that is sampled jumps where a step begins; between, it moves by its rate, which is zero of a memory.
struct StateVariable {
  std::string name;
  Expression rate;                         ///< per second
  Expression initial;                      ///< of parameters
  Expression nominal = 1.0;                ///< of parameters, positive: a size that it has
  std::string unit;                        ///< SI; empty: the description does not say
  std::optional<Expression> sampled = {};  ///< what it is in the step that begins; of h, too
  std::optional<Expression> period =
      {};  ///< of one that counts down to samples: between them, s; of parameters
  std::string description;
  support::SourceRange where = {};

  static constexpr std::string_view kKind = "state";
  static std::optional<ScalarCoordinate> pushed() { return {}; }
  static std::vector<FrameIndex> ends() { return {}; }
  std::vector<Expression*> expressions() {
    std::vector<Expression*> list = {&rate};
    for (std::optional<Expression>* expression : {&sampled, &period})
      if (*expression) list.push_back(&**expression);
    return list;
  }
  static bool conserves_energy() { return true; }
  static std::string assumption() { return ""; }
};

}  // namespace jourdain::model
