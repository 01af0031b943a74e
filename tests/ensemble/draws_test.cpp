// Random numbers by index: their moments, their independence, and the same ones for ever.
#include "jourdain/draws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace jourdain::tests {
namespace {

TEST(Draws, AreUniform) {
  std::vector<double> list;
  for (std::uint64_t i = 0; i < 100000; ++i) list.push_back(uniform(7, i / 100, i % 100));
  std::sort(list.begin(), list.end());
  double apart = 0;  // of Kolmogorov and Smirnov; 1.95 in 1000 draws of 100000 exceeds 1.95 / sqrt(100000)
  for (std::size_t i = 0; i < list.size(); ++i)
    apart = std::fmax(apart,
                      std::fabs(list[i] - (static_cast<double>(i) + 0.5) / static_cast<double>(list.size())));
  EXPECT_LT(apart, 1.95 / std::sqrt(static_cast<double>(list.size())));
  EXPECT_GT(list.front(), 0);
  EXPECT_LT(list.back(), 1);
}

TEST(Draws, AreNormal) {
  double moments[4] = {}, across = 0, along = 0;
  constexpr std::uint64_t count = 200000;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double x = normal(3, i, 0);
    for (int k = 0; k < 4; ++k) moments[k] += std::pow(x, k + 1) / count;
    across += x * normal(3, i + 1, 0) / count;
    along += x * normal(3, i, 1) / count;
  }
  // Five deviations of the means.
  const double deviation = 5 / std::sqrt(static_cast<double>(count));
  EXPECT_NEAR(moments[0], 0, deviation);
  EXPECT_NEAR(moments[1], 1, std::sqrt(2.0) * deviation);
  EXPECT_NEAR(moments[2], 0, std::sqrt(15.0) * deviation);
  EXPECT_NEAR(moments[3], 3, std::sqrt(96.0) * deviation);
  EXPECT_NEAR(across, 0, deviation);
  EXPECT_NEAR(along, 0, deviation);
}

TEST(Draws, StayWhatTheyAre) {
  EXPECT_EQ(detail::mixed(0x9e3779b97f4a7c15u),
            0xe220a8397b1dcdafu);  // the first number of SplitMix64 from 0
  EXPECT_NE(uniform(1, 0, 1), uniform(1, 1, 0));
  EXPECT_NE(uniform(0, 0, 0), uniform(1, 0, 0));
}

}  // namespace
}  // namespace jourdain::tests
