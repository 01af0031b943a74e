// What links hand to their parents, as the inward recursions keep it: two sums per link, so that nothing is rotated
// within a run of parallel joints, and what the other children hand over is turned from L to W once.
#pragma once

#include <vector>

#include "kinematics/working_frames.hpp"

namespace jourdain::kinematics {

/// Of each link: the sum over its children in its run, in W, and that over all others, in L. Both are about its origin.
template <class Sum>
struct InwardSums {
  std::vector<Sum> in_W, in_L;

  explicit InwardSums(const WorkingFrames& frames) : in_W(frames.link_count()), in_L(frames.link_count()) {}

  /// The sum of its parent that a child joins: in C of the child.
  Sum& joined_by(std::size_t child, const WorkingFrames& frames) {
    return (frames.meets_in_W(child) ? in_W : in_L)[frames.parent(child)];
  }
};

}  // namespace jourdain::kinematics
