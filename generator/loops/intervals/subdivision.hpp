// A box of free variables taken apart, with the branch over each part as far as it is proven.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "loops/intervals/branch.hpp"

namespace jourdain::loops {

/// A box, or one that was halved.
struct Part {
  Intervals P;
  std::vector<int> halvings = {};  ///< by side
  std::optional<Branch> branch = {};
  std::optional<std::size_t> side = {};  ///< halved across it
  std::array<std::size_t, 2> halves{};
};

/// A tree of halved boxes; part 0 is the whole.
class Subdivision {
 public:
  explicit Subdivision(const Intervals& whole) {
    parts_.push_back({whole, std::vector<int>(whole.size(), 0)});
  }

  Part& operator[](std::size_t index) { return parts_[index]; }
  const Part& operator[](std::size_t index) const { return parts_[index]; }

  void halve(std::size_t index, std::size_t side);

  /// The part at `p` of what part `index` was taken apart into, the lower one of two.
  std::size_t at(const Eigen::VectorXd& p, std::size_t index = 0) const;
  /// Parts that are not taken apart and share a point with P, their borders included.
  std::vector<std::size_t> touching(const Intervals& P) const;

 private:
  std::vector<Part> parts_;
};

Intervals intersection(const Intervals& a, const Intervals& b);
Eigen::VectorXd middle(const Intervals& P);

}  // namespace jourdain::loops
