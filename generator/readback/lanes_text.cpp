#include "readback/lanes_text.hpp"

namespace jourdain::readback {

const char* lanes_text() {
  return R"(#ifdef __GNUC__
#define JOURDAIN_LANE JOURDAIN_FUNCTION __attribute__((always_inline))
#else
#define JOURDAIN_LANE JOURDAIN_FUNCTION
#endif
template <int N, class Real>
struct Several;
template <class Real>
struct Several<2, Real> {
  Real a, b;

  JOURDAIN_LANE const Real& operator[](int lane) const noexcept { return lane == 0 ? a : b; }
  JOURDAIN_LANE friend Several operator+(const Several& x, const Several& y) noexcept { return {x.a + y.a, x.b + y.b}; }
  JOURDAIN_LANE friend Several operator+(const Several& x, const Real& y) noexcept { return {x.a + y, x.b + y}; }
  JOURDAIN_LANE friend Several operator+(const Real& x, const Several& y) noexcept { return {x + y.a, x + y.b}; }
  JOURDAIN_LANE friend Several operator-(const Several& x, const Several& y) noexcept { return {x.a - y.a, x.b - y.b}; }
  JOURDAIN_LANE friend Several operator-(const Several& x, const Real& y) noexcept { return {x.a - y, x.b - y}; }
  JOURDAIN_LANE friend Several operator-(const Real& x, const Several& y) noexcept { return {x - y.a, x - y.b}; }
  JOURDAIN_LANE friend Several operator*(const Several& x, const Several& y) noexcept { return {x.a * y.a, x.b * y.b}; }
  JOURDAIN_LANE friend Several operator*(const Several& x, const Real& y) noexcept { return {x.a * y, x.b * y}; }
  JOURDAIN_LANE friend Several operator*(const Real& x, const Several& y) noexcept { return {x * y.a, x * y.b}; }
  JOURDAIN_LANE friend Several operator/(const Several& x, const Several& y) noexcept { return {x.a / y.a, x.b / y.b}; }
  JOURDAIN_LANE friend Several operator/(const Several& x, const Real& y) noexcept { return {x.a / y, x.b / y}; }
  JOURDAIN_LANE friend Several operator/(const Real& x, const Several& y) noexcept { return {x / y.a, x / y.b}; }
};
template <class Real>
struct Several<4, Real> {
  Real a, b, c, d;

  JOURDAIN_LANE const Real& operator[](int lane) const noexcept { return lane == 0 ? a : lane == 1 ? b : lane == 2 ? c : d; }
  JOURDAIN_LANE friend Several operator+(const Several& x, const Several& y) noexcept { return {x.a + y.a, x.b + y.b, x.c + y.c, x.d + y.d}; }
  JOURDAIN_LANE friend Several operator+(const Several& x, const Real& y) noexcept { return {x.a + y, x.b + y, x.c + y, x.d + y}; }
  JOURDAIN_LANE friend Several operator+(const Real& x, const Several& y) noexcept { return {x + y.a, x + y.b, x + y.c, x + y.d}; }
  JOURDAIN_LANE friend Several operator-(const Several& x, const Several& y) noexcept { return {x.a - y.a, x.b - y.b, x.c - y.c, x.d - y.d}; }
  JOURDAIN_LANE friend Several operator-(const Several& x, const Real& y) noexcept { return {x.a - y, x.b - y, x.c - y, x.d - y}; }
  JOURDAIN_LANE friend Several operator-(const Real& x, const Several& y) noexcept { return {x - y.a, x - y.b, x - y.c, x - y.d}; }
  JOURDAIN_LANE friend Several operator*(const Several& x, const Several& y) noexcept { return {x.a * y.a, x.b * y.b, x.c * y.c, x.d * y.d}; }
  JOURDAIN_LANE friend Several operator*(const Several& x, const Real& y) noexcept { return {x.a * y, x.b * y, x.c * y, x.d * y}; }
  JOURDAIN_LANE friend Several operator*(const Real& x, const Several& y) noexcept { return {x * y.a, x * y.b, x * y.c, x * y.d}; }
  JOURDAIN_LANE friend Several operator/(const Several& x, const Several& y) noexcept { return {x.a / y.a, x.b / y.b, x.c / y.c, x.d / y.d}; }
  JOURDAIN_LANE friend Several operator/(const Several& x, const Real& y) noexcept { return {x.a / y, x.b / y, x.c / y, x.d / y}; }
  JOURDAIN_LANE friend Several operator/(const Real& x, const Several& y) noexcept { return {x / y.a, x / y.b, x / y.c, x / y.d}; }
};
template <int N, class Real>
struct LanesOf {
  typedef Several<N, Real> Type;
};
#if defined(__GNUC__) && !defined(__INTEL_COMPILER) && !defined(__CUDA__) && !defined(__CUDACC__) && (defined(__SSE2__) || defined(__aarch64__))
template <>
struct LanesOf<2, double> {
  typedef double Type __attribute__((vector_size(16)));
};
#if defined(__AVX__)
template <>
struct LanesOf<4, double> {
  typedef double Type __attribute__((vector_size(32)));
};
#else
struct TwoPairs {
  typedef LanesOf<2, double>::Type Pair;
  Pair low, high;

  TwoPairs() = default;
  TwoPairs(const Pair& first, const Pair& second) noexcept : low(first), high(second) {}
  TwoPairs(double a, double b, double c, double d) noexcept : low(Pair{a, b}), high(Pair{c, d}) {}
  double operator[](int lane) const noexcept { return lane < 2 ? low[lane] : high[lane - 2]; }
  friend TwoPairs operator+(const TwoPairs& a, const TwoPairs& b) noexcept { return {a.low + b.low, a.high + b.high}; }
  friend TwoPairs operator+(const TwoPairs& a, double b) noexcept { return {a.low + b, a.high + b}; }
  friend TwoPairs operator+(double a, const TwoPairs& b) noexcept { return {a + b.low, a + b.high}; }
  friend TwoPairs operator-(const TwoPairs& a, const TwoPairs& b) noexcept { return {a.low - b.low, a.high - b.high}; }
  friend TwoPairs operator-(const TwoPairs& a, double b) noexcept { return {a.low - b, a.high - b}; }
  friend TwoPairs operator-(double a, const TwoPairs& b) noexcept { return {a - b.low, a - b.high}; }
  friend TwoPairs operator*(const TwoPairs& a, const TwoPairs& b) noexcept { return {a.low * b.low, a.high * b.high}; }
  friend TwoPairs operator*(const TwoPairs& a, double b) noexcept { return {a.low * b, a.high * b}; }
  friend TwoPairs operator*(double a, const TwoPairs& b) noexcept { return {a * b.low, a * b.high}; }
  friend TwoPairs operator/(const TwoPairs& a, const TwoPairs& b) noexcept { return {a.low / b.low, a.high / b.high}; }
  friend TwoPairs operator/(const TwoPairs& a, double b) noexcept { return {a.low / b, a.high / b}; }
  friend TwoPairs operator/(double a, const TwoPairs& b) noexcept { return {a / b.low, a / b.high}; }
};
template <>
struct LanesOf<4, double> {
  typedef TwoPairs Type;
};
#endif
struct PairTwice {
  typedef float Vector __attribute__((vector_size(16)));
  Vector numbers;

  PairTwice() = default;
  PairTwice(const Vector& all) noexcept : numbers(all) {}
  PairTwice(float a, float b) noexcept : numbers(Vector{a, b, a, b}) {}
  float operator[](int lane) const noexcept { return numbers[lane]; }
  friend PairTwice operator+(const PairTwice& a, const PairTwice& b) noexcept { return a.numbers + b.numbers; }
  friend PairTwice operator+(const PairTwice& a, float b) noexcept { return a.numbers + b; }
  friend PairTwice operator+(float a, const PairTwice& b) noexcept { return a + b.numbers; }
  friend PairTwice operator-(const PairTwice& a, const PairTwice& b) noexcept { return a.numbers - b.numbers; }
  friend PairTwice operator-(const PairTwice& a, float b) noexcept { return a.numbers - b; }
  friend PairTwice operator-(float a, const PairTwice& b) noexcept { return a - b.numbers; }
  friend PairTwice operator*(const PairTwice& a, const PairTwice& b) noexcept { return a.numbers * b.numbers; }
  friend PairTwice operator*(const PairTwice& a, float b) noexcept { return a.numbers * b; }
  friend PairTwice operator*(float a, const PairTwice& b) noexcept { return a * b.numbers; }
  friend PairTwice operator/(const PairTwice& a, const PairTwice& b) noexcept { return a.numbers / b.numbers; }
  friend PairTwice operator/(const PairTwice& a, float b) noexcept { return a.numbers / b; }
  friend PairTwice operator/(float a, const PairTwice& b) noexcept { return a / b.numbers; }
};
template <>
struct LanesOf<2, float> {
  typedef PairTwice Type;
};
template <>
struct LanesOf<4, float> {
  typedef float Type __attribute__((vector_size(16)));
};
#endif
#undef JOURDAIN_LANE
template <int N, class Real>
using Lanes = typename LanesOf<N, Real>::Type;
)";
}

}  // namespace jourdain::readback
