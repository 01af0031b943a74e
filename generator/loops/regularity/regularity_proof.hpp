// Proof that dependent coordinates follow from independent ones wherever those may be.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "loops/intervals/branch.hpp"
#include "loops/record/loop_plan.hpp"
#include "loops/rows/constraints.hpp"
#include "model/coordinates.hpp"

namespace jourdain::loops {

using Range = std::optional<std::array<double, 2>>;

struct RegularityRequest {
  ir::Program g;                   ///< outputs ("g", row), every row; leaves: positions, time and parameters
  std::vector<Block> blocks;       ///< rows of g and dependent velocities, in the order of solution
  model::Tangent tangent;          ///< of all coordinates
  std::vector<double> initial_y;   ///< where g = 0 at t = 0 with `parameters`: on the branch
  std::vector<bool> angular;       ///< by entry of y
  std::vector<Range> range;        ///< by entry of y
  std::vector<std::string> names;  ///< by entry of y
  std::vector<double> parameters;
  std::vector<Range> parameter_range;  ///< none: proven at the value in `parameters` only
  std::vector<std::string> parameter_names;
  int iterations = 2;         ///< of Newton, by block
  std::size_t effort = 3000;  ///< boxes
  Evaluator evaluate = ir::interpret_interval;
};

/// The proof; otherwise why it is not proven, a phrase for the user that says where. The same on every
/// machine: effort is counted in boxes.
std::variant<RegularityProof, std::string> prove_regular(const RegularityRequest& request);

/// The request for a plan whose independent velocities and blocks are chosen, from the plan's initial state,
/// parameters in their ranges.
RegularityRequest regularity_request(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                     const LoopPlan& plan);

}  // namespace jourdain::loops
