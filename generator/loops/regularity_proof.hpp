// Proof that dependent coordinates follow from independent ones wherever those may be.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "loops/branch.hpp"
#include "loops/plan.hpp"
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
  int iterations = 2;          ///< of Newton, by block
  std::size_t effort = 20000;  ///< boxes
  Evaluator evaluate = ir::interpret_interval;
};

/// What is proven for all independent coordinates within their ranges (an angle without one: any, however many turns), at all times, for all
/// parameters within their ranges: the branch of the initial state exists, no other one meets it, and what is solved for the dependent
/// coordinates is regular on it.
struct RegularityProof {
  /// Of every block: the least |det| over the product of the largest norms of its rows, columns divided by their norms at the start.
  /// 1 is orthogonal, 0 singular.
  double margin = 1;
  std::string region;                    ///< "crank in [0.5, 2.9], any rocker"; empty where nothing varies
  std::vector<std::string> at_defaults;  ///< parameters at whose given values it holds only
  std::size_t boxes = 0;                 ///< that the region was taken apart into

  /// From dependents that are off by `radius` or less, each, the Newton iterations as emitted (block after block, `iterations`
  /// of each) end within `ends_within` of the branch, in exact arithmetic. rad; slides in units of `length`.
  double radius = 0;
  double ends_within = 0;
  double length = 1;  ///< m
  /// The same where |g| / row_scale is at most this and the dependents are within `radius`.
  double residual = 0;
  std::vector<double> row_scale;  ///< by row of g, norms at the start; 0 of rows that are in no block
};

/// Otherwise why it is not proven, a phrase for the user that says where. The same on every machine: effort is counted in boxes.
std::variant<RegularityProof, std::string> prove_regular(const RegularityRequest& request);

/// The request for a plan whose independent velocities and blocks are chosen, from the plan's initial state, parameters in their ranges.
RegularityRequest regularity_request(const model::Mechanism& mechanism, const ConstraintPrograms& constraints,
                                     const LoopPlan& plan);

}  // namespace jourdain::loops
