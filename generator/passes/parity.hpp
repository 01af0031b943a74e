// Equations between signs, solved as they come.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace jourdain::passes {

/// Unknowns are bits (1: negative); an equation is a sum of some modulo 2.
class Parity {
 public:
  /// Adds the equation that the sum of `unknowns` is `sum`; false, and nothing is added, where it contradicts those
  /// before. An unknown that is listed twice drops out.
  bool add(const std::vector<std::size_t>& unknowns, bool sum);

  /// What was added since `size()` was that is forgotten.
  std::size_t size() const { return added_.size(); }
  void forget(std::size_t size);

  /// Of unknowns 0 … count − 1; those that no equation decides are 0.
  std::vector<bool> solution(std::size_t count) const;

 private:
  struct Equation {
    std::vector<std::size_t> unknowns;  ///< in their order; the last one is no other equation's last
    bool sum = false;
  };
  static void combine(Equation& equation, const Equation& other);

  std::map<std::size_t, Equation> by_last_;
  std::vector<std::size_t> added_;
};

}  // namespace jourdain::passes
