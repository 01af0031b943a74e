// Models emitted with --packs, for packs that take no double and for packs that bring sine and cosine at once.
#include <gtest/gtest.h>

#include <cmath>
#include <experimental/simd>

#include "embed/emitted_sines.hpp"

// A vector of the compiler's: it has no namespace, so that its functions have to be known before the kernels are.
typedef double Vector __attribute__((vector_size(16)));
inline Vector sin(Vector x) {
  return Vector{jourdain::tests::emitted_sine(x[0]), jourdain::tests::emitted_sine(x[1])};
}
inline Vector cos(Vector x) {
  return Vector{jourdain::tests::emitted_cosine(x[0]), jourdain::tests::emitted_cosine(x[1])};
}
inline Vector sqrt(Vector x) { return Vector{std::sqrt(x[0]), std::sqrt(x[1])}; }
inline Vector exp(Vector x) { return Vector{std::exp(x[0]), std::exp(x[1])}; }
inline Vector tanh(Vector x) { return Vector{std::tanh(x[0]), std::tanh(x[1])}; }
inline Vector atan2(Vector y, Vector x) {
  return Vector{jourdain::tests::emitted_arctangent(y[0], x[0]),
                jourdain::tests::emitted_arctangent(y[1], x[1])};
}

#include "cart_stops_packs/cart_stops_packs_kernels.hpp"
#include "crane_packs/crane_packs_kernels.hpp"
#include "embed/pack.hpp"
#include "four_bar_packs/four_bar_packs_kernels.hpp"
#include "panda_packs/panda_packs_kernels.hpp"
#include "quadrotor_packs/quadrotor_packs_kernels.hpp"
#include "quadruped_packs/quadruped_packs_kernels.hpp"

namespace own {

int literals = 0, pairs = 0;

/// Two floats; nothing converts to it.
struct Pair {
  float low, high;

  friend Pair operator+(Pair a, Pair b) { return {a.low + b.low, a.high + b.high}; }
  friend Pair operator-(Pair a, Pair b) { return {a.low - b.low, a.high - b.high}; }
  friend Pair operator*(Pair a, Pair b) { return {a.low * b.low, a.high * b.high}; }
  friend Pair operator/(Pair a, Pair b) { return {a.low / b.low, a.high / b.high}; }
  friend Pair operator-(Pair a) { return {-a.low, -a.high}; }
  friend Pair sin(Pair a) {
    return {jourdain::tests::emitted_sine(a.low), jourdain::tests::emitted_sine(a.high)};
  }
  friend Pair cos(Pair a) {
    return {jourdain::tests::emitted_cosine(a.low), jourdain::tests::emitted_cosine(a.high)};
  }
  friend Pair sqrt(Pair a) { return {std::sqrt(a.low), std::sqrt(a.high)}; }
};

Pair from_literal(const Pair*, double x) {
  ++literals;
  return {static_cast<float>(x), static_cast<float>(x)};
}

void sine_cosine(const Pair& x, Pair& s, Pair& c) {
  ++pairs;
  s = sin(x);
  c = cos(x);
}

}  // namespace own

namespace jourdain::tests {
namespace {

namespace simd = std::experimental;

double lane(const Pack& x, std::size_t k) { return x.v[k]; }
double lane(const Vector& x, std::size_t k) { return x[k]; }
double lane(const own::Pair& x, std::size_t k) { return static_cast<double>(k == 0 ? x.low : x.high); }
template <class T, class Abi>
double lane(const simd::simd<T, Abi>& x, std::size_t k) {
  return static_cast<double>(x[k]);
}

void set_lane(Pack& x, std::size_t k, double value) { x.v[k] = value; }
void set_lane(Vector& x, std::size_t k, double value) { x[k] = value; }
void set_lane(own::Pair& x, std::size_t k, double value) {
  (k == 0 ? x.low : x.high) = static_cast<float>(value);
}
template <class T, class Abi>
void set_lane(simd::simd<T, Abi>& x, std::size_t k, double value) {
  x[k] = static_cast<T>(value);
}

/// Lanes of a trajectory that start apart from each other, against scalars that start there. `number` makes a Real.
template <class Model, class Scalars, class Number>
void compare(const char* name, std::size_t lanes, double tolerance, Number number) {
  using Real = typename Model::Scalar;
  using Scalar = typename Scalars::Scalar;
  const Model model;
  const Scalars scalars;
  const auto start = [](std::size_t k) { return 0.125 * static_cast<double>(k + 1); };
  auto state = initial_state(model);
  for (std::size_t k = 0; k < lanes; ++k) set_lane(state.z[0], k, start(k));
  typename Model::Input input;
  if constexpr (Model::input_count > 0)
    for (Real& u : input.u) u = number(0.5);
  for (int i = 0; i < 20; ++i) rk4_step(model, state, input, number(1e-4));
  for (std::size_t k = 0; k < lanes; ++k) {
    auto one = initial_state(scalars);
    one.z[0] = static_cast<Scalar>(start(k));
    typename Scalars::Input held;
    if constexpr (Model::input_count > 0)
      for (Scalar& u : held.u) u = static_cast<Scalar>(0.5);
    for (int i = 0; i < 20; ++i) rk4_step(scalars, one, held, static_cast<Scalar>(1e-4));
    for (int i = 0; i < Model::position_count; ++i) {
      const double wanted = static_cast<double>(one.y[i]), found = lane(state.y[i], k);
      EXPECT_LE(std::fabs(found - wanted), tolerance * (1 + std::fabs(wanted))) << name << " lane " << k;
    }
    EXPECT_NE(static_cast<double>(one.z[0]), start(k)) << name;
  }
}

#define JOURDAIN_COMPARE_LANES(name, Real, Scalar, lanes, tolerance)       \
  compare<name::Model<Real>, name::Model<Scalar>>(#name, lanes, tolerance, \
                                                  [](double x) { return name::detail::number<Real>(x); })
#define JOURDAIN_COMPARE_MODELS(Real, Scalar, lanes, tolerance)            \
  JOURDAIN_COMPARE_LANES(panda_packs, Real, Scalar, lanes, tolerance);     \
  JOURDAIN_COMPARE_LANES(crane_packs, Real, Scalar, lanes, tolerance);     \
  JOURDAIN_COMPARE_LANES(quadrotor_packs, Real, Scalar, lanes, tolerance); \
  JOURDAIN_COMPARE_LANES(quadruped_packs, Real, Scalar, lanes, tolerance); \
  JOURDAIN_COMPARE_LANES(four_bar_packs, Real, Scalar, lanes, tolerance)

// Packs that call the emitted scalar functions give the scalar bits; libstdc++'s have sines of their own.
constexpr double kNone = 0, kOwnSines = 1e-13, kOwnSinesOfFloats = 2e-5;

TEST(Packs, OfDoublesGiveTheBitsOfDouble) { JOURDAIN_COMPARE_MODELS(Pack, double, 4, kNone); }

TEST(Packs, OfTheCompilersVectorsGiveTheBitsOfDouble) { JOURDAIN_COMPARE_MODELS(Vector, double, 2, kNone); }

TEST(Packs, OfTheStandardLibraryTakeDoubles) {
  using Doubles = simd::fixed_size_simd<double, 4>;
  JOURDAIN_COMPARE_MODELS(Doubles, double, 4, kOwnSines);
}

TEST(Packs, OfTheStandardLibraryTakeFloats) {
  using Floats = simd::fixed_size_simd<float, 4>;
  JOURDAIN_COMPARE_MODELS(Floats, float, 4, kOwnSinesOfFloats);
}

/// Some lanes are at a stop and others are not; with the scalar functions' bits where those are the lanes' own.
template <class Real>
void compare_at_stops(std::size_t lanes, double tolerance) {
  namespace cart = cart_stops_packs;
  const cart::Model<Real> model;
  const cart::Model<double> scalars;
  auto state = initial_state(model);
  const auto place = [](std::size_t k) { return 0.3995 + 0.0005 * static_cast<double>(k); };
  const auto speed = [](std::size_t k) { return 1.0 - 0.7 * static_cast<double>(k); };
  for (std::size_t k = 0; k < lanes; ++k) {
    set_lane(state.y[0], k, place(k));
    set_lane(state.z[0], k, speed(k));
  }
  const typename cart::Model<Real>::Input none{{cart::detail::number<Real>(0.0)}};
  for (int i = 0; i < 20; ++i) rk4_step(model, state, none, cart::detail::number<Real>(1e-4));
  for (std::size_t k = 0; k < lanes; ++k) {
    auto one = initial_state(scalars);
    one.y[0] = place(k);
    one.z[0] = speed(k);
    for (int i = 0; i < 20; ++i) rk4_step(scalars, one, {}, 1e-4);
    EXPECT_NEAR(lane(state.y[0], k), one.y[0], tolerance) << k;
    EXPECT_NEAR(lane(state.z[0], k), one.z[0], 100 * tolerance) << k;
  }
}

TEST(Packs, ChooseInEachLane) {
  compare_at_stops<Pack>(4, kNone);
  compare_at_stops<Vector>(2, kNone);
  compare_at_stops<simd::fixed_size_simd<double, 4>>(4, kOwnSines);
}

TEST(Packs, BringTheirOwnLiteralsAndPairsOfSineAndCosine) {
  own::literals = own::pairs = 0;
  JOURDAIN_COMPARE_LANES(panda_packs, own::Pair, float, 2, kNone);
  EXPECT_GT(own::literals, 0);
  EXPECT_GE(own::pairs, 20 * 4 * 6);  // six joints turn what the seventh does not feel
}

}  // namespace
}  // namespace jourdain::tests
