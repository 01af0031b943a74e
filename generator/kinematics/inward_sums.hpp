// What links hand to their parents, as the inward recursions keep it: two sums per link, so that nothing is rotated
// within a run of parallel joints, and what the other children hand over is turned from L to W once.
#pragma once

#include <vector>

#include "kinematics/working_frames.hpp"

namespace jourdain::kinematics {

/// Of each link: the sum over its children in its run, in W, and that over all others, in L. Both are about its origin.
template <class Sum>
class InwardSums {
 public:
  explicit InwardSums(const WorkingFrames& frames)
      : frames_(frames), in_W_(frames.link_count()), in_L_(frames.link_count()) {}

  Sum& in_W(std::size_t link) { return in_W_[link]; }
  Sum& in_L(std::size_t link) { return in_L_[link]; }
  const Sum& in_W(std::size_t link) const { return in_W_[link]; }
  const Sum& in_L(std::size_t link) const { return in_L_[link]; }
  /// Its parent's sum that a child belongs to: in C of the child.
  Sum& joined_by(std::size_t child) {
    return (frames_.meets_in_W(child) ? in_W_ : in_L_)[frames_.parent(child)];
  }

 private:
  const WorkingFrames& frames_;
  std::vector<Sum> in_W_, in_L_;
};

}  // namespace jourdain::kinematics
