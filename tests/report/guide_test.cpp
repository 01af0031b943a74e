// The lines that show methods' orders in plots of error over run time.
#include "report/guide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace jourdain::tests {
namespace {

using report::order_guide;
using report::Series;

/// Errors (10 x)^−4 that level out at `floor`; beyond `until` in x they fall off with a slope of their own.
Series fourth_order(double floor, double until) {
  Series series;
  for (double x = 1e-3; x < 2; x *= 2) {
    const double usual = std::pow(10 * x, -4);
    series.x.push_back(x);
    series.y.push_back(std::max(floor, x < until ? usual * std::pow(x / until, 2) : usual));
  }
  return series;
}

TEST(OrderGuide, LiesNearThePointsThatItCovers) {
  const Series series = fourth_order(1e-9, 0.02);
  const Series guide = order_guide(series, 4, 1e-9);
  ASSERT_GE(guide.x.size(), 3u);
  for (std::size_t i = 0; i < guide.x.size(); ++i) {
    const auto at =
        static_cast<std::size_t>(std::find(series.x.begin(), series.x.end(), guide.x[i]) - series.x.begin());
    ASSERT_LT(at, series.x.size());
    EXPECT_LT(std::fabs(std::log10(guide.y[i] / series.y[at])), std::log10(2)) << guide.x[i];
  }
  EXPECT_GE(guide.x.back(), 0.01);  // not over the errors of long steps, which fall in another way
}

TEST(OrderGuide, StartsAtAMeasuredPointAboveRounding) {
  const Series series = fourth_order(1e-3, 0);
  const Series guide = order_guide(series, 4, 1e-3);
  ASSERT_FALSE(guide.x.empty());
  EXPECT_DOUBLE_EQ(guide.y.front(), std::pow(10 * guide.x.front(), -4));
  EXPECT_GT(guide.y.front(), 1e-2);
}

TEST(OrderGuide, IsNotDrawnWhereErrorsDoNotFollowTheOrder) {
  EXPECT_TRUE(order_guide(fourth_order(1e-9, 0), 1, 1e-9).x.empty());
  EXPECT_TRUE(order_guide(Series{}, 4, 1e-9).x.empty());
}

}  // namespace
}  // namespace jourdain::tests
