// Couplers: linear relations between coordinates, as gears, differentials and followers keep them.
#pragma once

#include <span>
#include <string>

#include "model/mechanism.hpp"

namespace jourdain::model {

/// One scalar coordinate of a joint, times a factor.
struct CouplerTerm {
  JointIndex joint;
  std::size_t coordinate = 0;
  Expression factor;  ///< of parameters
};

/// The loop that keeps Σ factor · coordinate = offset: a residual, whose multiplier is the generalized force by which
/// the coupler acts on each coordinate, −factor · λ.
Loop coupler(std::string name, std::span<const CouplerTerm> terms, const Expression& offset,
             SourceRange where = {});

}  // namespace jourdain::model
