// Packs of the runtime lane by lane: sines, choices, signs.
#include "jourdain/pack.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "embed/emitted_sines.hpp"
#include "jourdain/draws.hpp"

namespace jourdain::tests {
namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Angles of all sizes, near multiples of a quarter turn, and what is none.
std::vector<double> angles() {
  std::vector<double> list = {0.0,  -0.0,  1e-310, 0x1p30, -0x1p30, std::nextafter(0x1p30, 1e300),
                              1e18, -1e300};
  for (std::uint64_t i = 0; i < 200000; ++i) {
    list.push_back(std::ldexp(2 * uniform(1, 0, i) - 1, static_cast<int>(i % 70) - 38));
    list.push_back(std::floor(1e6 * uniform(2, 0, i)) * 1.5707963267948966 * (1 + 1e-15 * uniform(3, 0, i)));
  }
  while (list.size() % 8 != 0) list.push_back(1.0);
  return list;
}

template <std::size_t lanes>
void expect_emitted_sines(const std::vector<double>& list) {
  int wrong = 0;
  for (std::size_t i = 0; i < list.size(); i += lanes) {
    Pack<double, lanes> x, s, c;
    for (std::size_t k = 0; k < lanes; ++k) x.set(k, list[i + k]);
    sine_cosine(x, s, c);
    for (std::size_t k = 0; k < lanes; ++k) {
      wrong += !same_bits(s[k], emitted_sine(x[k])) || !same_bits(c[k], emitted_cosine(x[k]));
      wrong += !same_bits(sin(x)[k], s[k]) || !same_bits(cos(x)[k], c[k]);
    }
  }
  EXPECT_EQ(wrong, 0) << lanes;
}

TEST(Packs, HaveTheEmittedSinesOfDoubles) {
  const std::vector<double> list = angles();
  expect_emitted_sines<2>(list);
  expect_emitted_sines<4>(list);
  expect_emitted_sines<8>(list);
}

TEST(Packs, HaveNoSineOfWhatIsNoNumber) {
  Pack<double, 4> x(1.0), s, c;
  x.set(1, std::numeric_limits<double>::quiet_NaN());
  x.set(2, -std::numeric_limits<double>::infinity());
  sine_cosine(x, s, c);
  EXPECT_TRUE(same_bits(s[0], emitted_sine(1.0)));
  EXPECT_TRUE(std::isnan(s[1]) && std::isnan(c[1]) && std::isnan(s[2]) && std::isnan(c[2]));
  EXPECT_TRUE(same_bits(c[3], emitted_cosine(1.0)));
}

TEST(Packs, HaveSinesOfFloatsFromDoubles) {
  double worst = 0;
  const auto miss = [&worst](float found, double exact) {
    int exponent = 0;
    std::frexp(exact, &exponent);
    worst =
        std::fmax(worst, std::fabs(double(found) - exact) / std::ldexp(1.0, std::max(exponent, -125) - 24));
  };
  for (std::uint64_t i = 0; i < 100000; ++i) {
    Pack<float, 4> x, s, c;
    for (std::size_t k = 0; k < 4; ++k)
      x.set(k, std::ldexp(static_cast<float>(2 * uniform(4, i, k) - 1), static_cast<int>(i % 150) - 30));
    sine_cosine(x, s, c);
    for (std::size_t k = 0; k < 4; ++k) {
      miss(s[k], std::sin(double(x[k])));
      miss(c[k], std::cos(double(x[k])));
    }
  }
  EXPECT_LE(worst, 0.51);  // as the header says
  EXPECT_GE(worst, 0.4);
}

/// Of points in all directions and of all sizes, on the axes and the diagonals too.
template <class Real, std::size_t lanes>
void expect_arctangents_as_emitted() {
  const std::vector<Real> special = {Real(0), Real(-0.0), Real(1), Real(-1), Real(1e-30), Real(0.5463025)};
  for (std::uint64_t i = 0; i < 100000; ++i) {
    Pack<Real, lanes> y, x;
    for (std::size_t k = 0; k < lanes; ++k) {
      const auto drawn = [&](std::uint64_t which) {
        const double u = uniform(which, i, k);
        if (i % 4 == which) return special[static_cast<std::size_t>(u * 6)];
        return static_cast<Real>(std::ldexp(2 * u - 1, static_cast<int>((i + 7 * which * k) % 60) - 30));
      };
      y.set(k, drawn(0));
      x.set(k, drawn(1));
    }
    const Pack<Real, lanes> angle = atan2(y, x);
    for (std::size_t k = 0; k < lanes; ++k)
      ASSERT_TRUE(same_bits(angle[k], emitted_arctangent(y[k], x[k]))) << y[k] << " " << x[k];
  }
}

TEST(Packs, HaveTheBitsOfEmittedArctangents) {
  expect_arctangents_as_emitted<double, 2>();
  expect_arctangents_as_emitted<double, 8>();
  expect_arctangents_as_emitted<float, 4>();
  expect_arctangents_as_emitted<float, 16>();
}

/// Rounded down, up to the ends; of what is no number some entry.
template <class Real, std::size_t lanes>
void expect_entries() {
  const Real table[] = {Real(0.5), Real(-1), Real(2), Real(7)};
  const Real none = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
  const std::pair<Real, Real> expected[] = {
      {Real(-3), Real(0.5)}, {Real(-0.0), Real(0.5)}, {Real(0.99), Real(0.5)},
      {Real(1), Real(-1)},   {Real(2.5), Real(2)},    {Real(3), Real(7)},
      {Real(1e30), Real(7)}, {infinity, Real(7)},     {-infinity, Real(0.5)}};
  for (std::size_t first = 0; first < std::size(expected); ++first) {
    Pack<Real, lanes> places;
    for (std::size_t k = 0; k < lanes; ++k) places.set(k, expected[(first + k) % std::size(expected)].first);
    const Pack<Real, lanes> found = table_entry(table, 3, places);
    for (std::size_t k = 0; k < lanes; ++k)
      EXPECT_EQ(found[k], expected[(first + k) % std::size(expected)].second) << places[k];
  }
  const Real some = table_entry(table, 3, Pack<Real, lanes>(static_cast<double>(none)))[0];
  EXPECT_NE(std::find(std::begin(table), std::end(table), some), std::end(table));
}

TEST(Packs, TakeEntriesOfTables) {
  expect_entries<double, 2>();
  expect_entries<double, 8>();
  expect_entries<float, 4>();
  expect_entries<float, 16>();
}

template <class Real, std::size_t lanes>
void expect_lanes_as_scalars() {
  using Number = Pack<Real, lanes>;
  const Real infinity = std::numeric_limits<Real>::infinity(), none = std::numeric_limits<Real>::quiet_NaN();
  const std::vector<Real> list = {Real(0),    -Real(0), Real(1),   Real(-2.5),
                                  Real(1e30), infinity, -infinity, none};
  for (const Real a : list)
    for (const Real b : list) {
      Number x(0.5), y(0.5);
      x.set(1, a);
      y.set(1, b);
      const auto same = [](Real found, Real wanted) {
        return std::isnan(wanted) ? std::isnan(found)
                                  : found == wanted && std::signbit(found) == std::signbit(wanted);
      };
      EXPECT_TRUE(same((x + y)[1], a + b) && same((x - y)[1], a - b) && same((x * y)[1], a * b))
          << a << " " << b;
      EXPECT_TRUE(same((x / y)[1], a / b) && same((-x)[1], -a) && same(fabs(x)[1], std::fabs(a)))
          << a << " " << b;
      EXPECT_TRUE(same(sqrt(x)[1], std::sqrt(a)) && same(floor(x)[1], std::floor(a))) << a;
      EXPECT_TRUE(same(select(x < y, x, y)[1], a < b ? a : b)) << a << " " << b;
      EXPECT_TRUE(same(exp(x)[1], std::exp(a)) && same(atan2(x, y)[1], emitted_arctangent(a, b)))
          << a << " " << b;
      EXPECT_TRUE(same(pow(x, y)[1], std::pow(a, b)) && same(tanh(x)[1], std::tanh(a))) << a << " " << b;
      EXPECT_EQ((x + y)[0], Real(1));
      EXPECT_TRUE(same(Number(static_cast<double>(a))[lanes - 1], a)) << a;
    }
}

TEST(Packs, AreScalarsInEachLane) {
  expect_lanes_as_scalars<double, 2>();
  expect_lanes_as_scalars<double, 8>();
  expect_lanes_as_scalars<float, 4>();
  expect_lanes_as_scalars<float, 16>();
}

}  // namespace
}  // namespace jourdain::tests
