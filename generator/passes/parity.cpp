#include "passes/parity.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace jourdain::passes {

void Parity::combine(Equation& equation, const Equation& other) {
  std::vector<std::size_t> sum;
  std::set_symmetric_difference(equation.unknowns.begin(), equation.unknowns.end(), other.unknowns.begin(),
                                other.unknowns.end(), std::back_inserter(sum));
  equation.unknowns = std::move(sum);
  equation.sum = equation.sum != other.sum;
}

bool Parity::add(const std::vector<std::size_t>& unknowns, bool sum) {
  Equation equation;
  equation.sum = sum;
  for (const std::size_t unknown : unknowns) combine(equation, {{unknown}, false});
  while (!equation.unknowns.empty()) {
    const std::size_t last = equation.unknowns.back();
    const auto known = by_last_.find(last);
    if (known == by_last_.end()) {
      by_last_.emplace(last, std::move(equation));
      added_.push_back(last);
      return true;
    }
    combine(equation, known->second);
  }
  return !equation.sum;
}

void Parity::forget(std::size_t size) {
  for (; added_.size() > size; added_.pop_back()) by_last_.erase(added_.back());
}

std::vector<bool> Parity::solution(std::size_t count) const {
  std::vector<bool> values(count, false);
  for (const auto& [last, equation] : by_last_) {
    bool value = equation.sum;
    for (const std::size_t unknown : equation.unknowns) value = value != (unknown != last && values[unknown]);
    values[last] = value;
  }
  return values;
}

}  // namespace jourdain::passes
