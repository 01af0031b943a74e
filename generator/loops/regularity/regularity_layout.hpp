// What a proof of regularity is about: which coordinates follow from which others, and by which equations.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "loops/regularity/block_bounds.hpp"
#include "loops/regularity/regularity_proof.hpp"

namespace jourdain::loops {

/// What the branch is followed over.
struct FreeVariable {
  Variable leaf;
  std::string name;
  double start = 0;
  Interval side;
  bool is_circle = false;
  bool is_parameter = false;
};

struct RegularityLayout {
  NewtonProblem problem;
  ir::Program g;                      ///< rows of the blocks, in their order, without time
  std::vector<std::size_t> unknowns;  ///< entries of y; the four of a quaternion
  std::vector<std::size_t> quaternions;
  std::vector<FreeVariable> free;
  std::vector<std::string> at_defaults;
  ProvenBox box;
  std::optional<BranchEquations> equations;
  Eigen::VectorXd start;  ///< of the unknowns
};

/// Otherwise what cannot be handled, a phrase.
std::variant<RegularityLayout, std::string> lay_out(const RegularityRequest& request);

}  // namespace jourdain::loops
