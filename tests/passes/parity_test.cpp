// Equations between signs against trying all of them.
#include "passes/parity.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace jourdain::passes {
namespace {

constexpr std::size_t kUnknowns = 6;

struct Equation {
  std::vector<std::size_t> unknowns;
  bool sum = false;
};

bool holds(const Equation& equation, const std::vector<bool>& values) {
  bool sum = false;
  for (const std::size_t unknown : equation.unknowns) sum = sum != values[unknown];
  return sum == equation.sum;
}

/// All values for which the equations hold.
std::vector<std::vector<bool>> solutions(const std::vector<Equation>& equations) {
  std::vector<std::vector<bool>> list;
  for (unsigned bits = 0; bits < 1U << kUnknowns; ++bits) {
    std::vector<bool> values;
    for (std::size_t i = 0; i < kUnknowns; ++i) values.push_back((bits >> i & 1) != 0);
    bool all = true;
    for (const Equation& equation : equations) all = all && holds(equation, values);
    if (all) list.push_back(values);
  }
  return list;
}

TEST(Parity, TakesWhatHasASolutionAndRefusesTheRest) {
  std::mt19937 random(3);
  std::size_t refused = 0;
  for (int system = 0; system < 300; ++system) {
    Parity parity;
    std::vector<Equation> accepted;
    for (int e = 0; e < 10; ++e) {
      Equation equation;
      for (std::size_t k = random() % 4; k-- > 0;) equation.unknowns.push_back(random() % kUnknowns);
      equation.sum = random() % 2 == 1;
      std::vector<Equation> with = accepted;
      with.push_back(equation);
      const bool taken = parity.add(equation.unknowns, equation.sum);
      EXPECT_EQ(taken, !solutions(with).empty());
      refused += !taken;
      if (taken) accepted = with;
    }
    const std::vector<bool> found = parity.solution(kUnknowns);
    for (const Equation& equation : accepted) EXPECT_TRUE(holds(equation, found));
  }
  EXPECT_GT(refused, 300u);
}

TEST(Parity, ForgetsTheLastOnes) {
  Parity parity;
  ASSERT_TRUE(parity.add({0, 1}, true));
  const std::size_t before = parity.size();
  ASSERT_TRUE(parity.add({1, 2}, true));
  ASSERT_TRUE(parity.add({0}, true));
  EXPECT_FALSE(parity.add({2}, false));
  parity.forget(before);
  EXPECT_TRUE(parity.add({2}, false));
  EXPECT_TRUE(parity.add({0}, false));
  EXPECT_FALSE(parity.add({1}, false));
}

}  // namespace
}  // namespace jourdain::passes
