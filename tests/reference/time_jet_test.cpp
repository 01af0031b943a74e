#include "reference/time_jet.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace jourdain::reference::descriptor {
namespace {

using Long = long double;
using Jet = TimeJet<Long>;

constexpr double kDifferences = 1e-11;  // central differences of order 4, step 1e-3, rounding over its square

/// Value and two derivatives of `f` at 0.4 by differences.
template <class F>
Jet by_differences(F f) {
  const Long h = 1e-3L, t = 0.4L;
  const Long value = f(t), near = f(t + h) + f(t - h), far = f(t + 2 * h) + f(t - 2 * h);
  return {value, (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h),
          (16 * near - far - 30 * value) / (12 * h * h)};
}

template <class F>
void expect_derivatives(F f) {
  const Jet jet = f(Jet(0.4L, 1, 0)), expected = by_differences(f);
  EXPECT_EQ(jet.value, expected.value);
  EXPECT_NEAR(double(jet.rate), double(expected.rate), kDifferences);
  EXPECT_NEAR(double(jet.acceleration), double(expected.acceleration), kDifferences);
}

TEST(TimeJet, ComposesEveryOperationWithItsTwoDerivatives) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  expect_derivatives([](const auto& t) { return t + t * t - 2.0L; });
  expect_derivatives([](const auto& t) { return (1.0L - t) / (t * t + 2.0L); });
  expect_derivatives([](const auto& t) { return sin(t * t); });
  expect_derivatives([](const auto& t) { return cos(t * t + t); });
  expect_derivatives([](const auto& t) { return sqrt(t * t * t + 1.0L); });
  expect_derivatives([](const auto& t) { return atan2(t * t, t - 3.0L); });
  expect_derivatives([](const auto& t) { return -t * t * t; });
}

TEST(TimeJet, WorksInFixedSizeProducts) {
  using V = Eigen::Matrix<Jet, 3, 1>;
  const V a(Jet(1, 2, 0), Jet(0), Jet(0, 0, 3)), b(Jet(2), Jet(0, 1, 0), Jet(1));
  const Jet dot = a.dot(b);
  EXPECT_EQ(dot.value, 2);
  EXPECT_EQ(dot.rate, 4);
  EXPECT_EQ(dot.acceleration, 3);
  EXPECT_EQ(a.cross(b).z().rate, 1);
  EXPECT_EQ(a.cross(b).z().acceleration, 4);
}

}  // namespace
}  // namespace jourdain::reference::descriptor
