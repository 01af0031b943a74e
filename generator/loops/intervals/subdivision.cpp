#include "loops/intervals/subdivision.hpp"

#include <algorithm>

namespace jourdain::loops {

void Subdivision::halve(std::size_t index, std::size_t side) {
  Part half = {parts_[index].P, parts_[index].halvings};
  ++half.halvings[side];
  const Interval whole = half.P[side];
  parts_[index].side = side;
  for (std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    half.P[side] = k == 0 ? Interval{whole.low, whole.middle()} : Interval{whole.middle(), whole.high};
    parts_[index].halves[k] = parts_.size();
    parts_.push_back(half);
  }
}

std::size_t Subdivision::at(const Eigen::VectorXd& p, std::size_t index) const {
  while (const auto side = parts_[index].side) {
    const double border = parts_[index].P[*side].middle();
    index = parts_[index].halves[p[static_cast<Eigen::Index>(*side)] <= border ? 0 : 1];
  }
  return index;
}

std::vector<std::size_t> Subdivision::touching(const Intervals& P) const {
  std::vector<std::size_t> open = {0}, found;
  while (!open.empty()) {
    const std::size_t index = open.back();
    open.pop_back();
    const Part& part = parts_[index];
    bool touches = true;
    for (std::size_t k = 0; k < P.size(); ++k)
      touches = touches && P[k].low <= part.P[k].high && part.P[k].low <= P[k].high;
    if (!touches) continue;
    if (part.side)
      open.insert(open.end(), part.halves.begin(), part.halves.end());
    else
      found.push_back(index);
  }
  return found;
}

Intervals intersection(const Intervals& a, const Intervals& b) {
  Intervals result;
  for (std::size_t k = 0; k < a.size(); ++k)
    result.push_back({std::max(a[k].low, b[k].low), std::min(a[k].high, b[k].high)});
  return result;
}

Eigen::VectorXd middle(const Intervals& P) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(P.size()));
  for (std::size_t k = 0; k < P.size(); ++k) result[static_cast<Eigen::Index>(k)] = P[k].middle();
  return result;
}

}  // namespace jourdain::loops
