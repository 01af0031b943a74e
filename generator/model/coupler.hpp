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

/// Of a coordinate that follows another.
struct Follower {
  ScalarCoordinate coordinate, leader;
  Expression ratio = 1.0, offset = 0.0;  ///< coordinate = ratio · leader + offset
};

/// The loop that keeps Σ factor · coordinate = offset: a residual, whose multiplier is the generalized force by which
/// the coupler acts on each coordinate, −factor · λ.
Loop coupler(std::string name, std::span<const CouplerTerm> terms, const Expression& offset,
             SourceRange where = {});

/// The same of two coordinates, of which the first is left to follow where there is a choice.
Loop coupler(std::string name, const Follower& follower, SourceRange where = {});

/// Lets each follower start where what it follows takes it, unless the description gives its start or the other's
/// motion is prescribed.
void start_followers(Mechanism& mechanism);

}  // namespace jourdain::model
