// SPDX-License-Identifier: MIT
// Several numbers side by side for emitted code, in vectors of GCC and Clang: include NAME_kernels.hpp and use
// NAME::Model<jourdain::Pack<double, 4>>; best with what `jourdain compile --packs` writes, which takes sine and cosine
// of an angle at once.
//
// Each lane has the bits that double, or float, has under the same options, where sums and products are not fused
// (-ffp-contract=off), but for sines of floats, which are taken in double, less than 0.51 ulp off. Entries of tables
// and functions of the C library (exp and its like) are taken lane by lane, as are roots without -fno-math-errno.
#pragma once

#if !defined(__GNUC__)
#error "jourdain/pack.hpp needs vectors as GCC and Clang have them"
#endif
#if (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    (defined(__ASSOCIATIVE_MATH__) && !defined(__clang__))
#error "jourdain/pack.hpp: no -ffast-math, -Ofast, -ffinite-math-only, nor g++'s -fassociative-math"
#endif

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace jourdain {

/// Lanes that the vectors of the machine hold that is compiled for: 64 bytes with AVX-512, 32 with AVX, else 16.
template <class Real>
inline constexpr std::size_t natural_lanes =
#if defined(__AVX512F__)
    64
#elif defined(__AVX__)
    32
#else
    16
#endif
    / sizeof(Real);

// Clang takes vectors of 512 bits in halves in functions whose arguments are no such vectors.
#if defined(__clang__) && defined(__AVX512F__)
#define JOURDAIN_PACK_FUNCTION __attribute__((always_inline, min_vector_width(512)))
#else
#define JOURDAIN_PACK_FUNCTION __attribute__((always_inline))
#endif

namespace detail {

template <class T, std::size_t count>
struct VectorOf {
  typedef T Type __attribute__((vector_size(count * sizeof(T))));
};

}  // namespace detail

/// Of packs whose sines are computed, each by itself.
struct ComputedSines {
  template <class Number>
  JOURDAIN_PACK_FUNCTION static void take(const typename Number::Vector& x, typename Number::Vector& s,
                                          typename Number::Vector& c) noexcept {
    Number::compute_sines(x, s, c);
  }
};

/// `lanes` numbers, double or float; a power of two from 2 on. `Sines`: what sine_cosine asks.
template <class Real, std::size_t lanes, class Sines = ComputedSines>
struct Pack {
  static_assert(std::is_same_v<Real, double> || std::is_same_v<Real, float>, "of double or float");
  static_assert(lanes >= 2 && (lanes & (lanes - 1)) == 0, "a power of two");
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  static constexpr std::size_t size = lanes;
  using value_type = Real;
  using Vector = typename detail::VectorOf<Real, lanes>::Type;
  using BitVector = typename detail::VectorOf<Bits, lanes>::Type;
  /// All bits of a lane where something holds, none where not.
  struct Mask {
    BitVector bits;
  };

  Vector values;

  Pack() = default;  // no numbers yet; Pack{} is zeros
  explicit Pack(double x) noexcept : values(Vector{} + static_cast<Real>(x)) {
    // x + 0 would lose the sign of a negative zero.
    if (x == 0) values = std::signbit(x) ? -Vector{} : Vector{};
  }

  Real operator[](std::size_t lane) const noexcept { return values[lane]; }
  void set(std::size_t lane, Real x) noexcept { values[lane] = x; }

  friend Pack operator+(const Pack& a, const Pack& b) noexcept { return of(a.values + b.values); }
  friend Pack operator-(const Pack& a, const Pack& b) noexcept { return of(a.values - b.values); }
  friend Pack operator*(const Pack& a, const Pack& b) noexcept { return of(a.values * b.values); }
  friend Pack operator/(const Pack& a, const Pack& b) noexcept { return of(a.values / b.values); }
  friend Pack operator-(const Pack& a) noexcept { return of(-a.values); }

  friend Mask operator<(const Pack& a, const Pack& b) noexcept { return {(BitVector)(a.values < b.values)}; }
  friend Pack select(const Mask& mask, const Pack& a, const Pack& b) noexcept {
    return of((Vector)(((BitVector)a.values & mask.bits) | ((BitVector)b.values & ~mask.bits)));
  }
  friend Pack fabs(const Pack& a) noexcept {
    const Bits one = 1;
    return of((Vector)((BitVector)a.values & ~(BitVector{} + (one << (8 * sizeof(Real) - 1)))));
  }

  /// f of each lane.
  template <class F>
  friend Pack each(const Pack& a, const F& f) noexcept {
    Pack result;
    for (std::size_t k = 0; k < lanes; ++k) result.values[k] = f(a.values[k]);
    return result;
  }
  template <class F>
  friend Pack each(const Pack& a, const Pack& b, const F& f) noexcept {
    Pack result;
    for (std::size_t k = 0; k < lanes; ++k) result.values[k] = f(a.values[k], b.values[k]);
    return result;
  }

  /// Of each lane the value at its number, that of an end beyond the ends.
  template <class Value>
  __attribute__((always_inline)) friend Pack table_entry(const Value* table, int last,
                                                         const Pack& numbers) noexcept {
    const Vector i = numbers.values, none = {}, end = none + static_cast<Real>(last);
    const BitVector above = (BitVector)i & (BitVector)(i > none),
                    is_within = (BitVector)((Vector)above < end);
    const Vector within = (Vector)((above & is_within) | ((BitVector)end & ~is_within));
    int places[lanes];
    const auto whole = __builtin_convertvector(within, typename detail::VectorOf<int, lanes>::Type);
    std::memcpy(places, &whole, sizeof places);
    Pack entries;
    take(table, places, std::make_index_sequence<lanes>(), entries.values);
    return entries;
  }

  friend Pack sqrt(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::sqrt(x); });
  }
  friend Pack floor(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::floor(x); });
  }
  friend Pack exp(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::exp(x); });
  }
  friend Pack log(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::log(x); });
  }
  friend Pack sinh(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::sinh(x); });
  }
  friend Pack cosh(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::cosh(x); });
  }
  friend Pack tanh(const Pack& a) noexcept {
    return each(a, [](Real x) { return std::tanh(x); });
  }
  friend Pack pow(const Pack& a, const Pack& b) noexcept {
    return each(a, b, [](Real x, Real p) { return std::pow(x, p); });
  }
  friend Pack atan(const Pack& a) noexcept { return atan2(a, Pack(1)); }
  /// As emitted code takes it, with its bits: less than 2 ulp off.
  friend Pack atan2(const Pack& y, const Pack& x) noexcept {
    Pack angle;
    arctangents(y.values, x.values, angle.values);
    return angle;
  }

  friend void sine_cosine(const Pack& x, Pack& s, Pack& c) noexcept {
    Sines::template take<Pack>(x.values, s.values, c.values);
  }
  JOURDAIN_PACK_FUNCTION static void compute_sines(const Vector& x, Vector& s, Vector& c) noexcept {
    if constexpr (sizeof(Real) == 8) {
      sines_of_doubles(x, s, c);
    } else {
      sines_of_floats(x, s, c);
    }
  }
  friend Pack sin(const Pack& x) noexcept {
    Pack s, c;
    sine_cosine(x, s, c);
    return s;
  }
  friend Pack cos(const Pack& x) noexcept {
    Pack s, c;
    sine_cosine(x, s, c);
    return c;
  }

 private:
  static Pack of(const Vector& values) noexcept {
    Pack result;
    result.values = values;
    return result;
  }
  static void sines_of_doubles(const Vector& x, Vector& s, Vector& c) noexcept;
  static void sines_of_floats(const Vector& x, Vector& s, Vector& c) noexcept;
  template <class Value, std::size_t... k>
  __attribute__((always_inline)) static void take(const Value* table, const int* places,
                                                  std::index_sequence<k...>, Vector& entries) noexcept {
    entries = Vector{static_cast<Real>(table[places[k]])...};
  }
  static void arctangents(const Vector& y, const Vector& x, Vector& result) noexcept;
  static void keep_in_range(const Vector& x, const Vector& magnitude, Vector& s, Vector& c) noexcept;
  static void call_library(const Vector& x, Vector& s, Vector& c) noexcept;
};

namespace detail {

/// Sine and cosine of |x| in a quadrant, of what is left of it: exchanged and with the signs that they have there.
template <class I, class V>
JOURDAIN_PACK_FUNCTION inline void turn(const I& sine_bits, const I& cosine_bits, const I& n, const I& sign,
                                        V& s, V& c) noexcept {
  const std::uint64_t one = 1, zero = 0;
  const I exchange = (sine_bits ^ cosine_bits) & (zero - (n & one));
  s = (V)(sine_bits ^ exchange ^ sign ^ ((n << 62) & (one << 63)));
  c = (V)(cosine_bits ^ exchange ^ (((n + one) << 62) & (one << 63)));
}

}  // namespace detail

/// As the emitted functions do it for double and float (see there for the sources of the numbers).
template <class Real, std::size_t lanes, class Sines>
JOURDAIN_PACK_FUNCTION inline void Pack<Real, lanes, Sines>::arctangents(const Vector& y, const Vector& x,
                                                                         Vector& result) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  using V = Vector;
  using I = BitVector;
  constexpr bool is_double = sizeof(Real) == 8;
  constexpr int last = is_double ? 63 : 31;
  const Bits zero = 0, one = 1;
  const auto number = [](double value) { return static_cast<Real>(value); };
  const I unit = (I)(V{} + number(1));  // 1 in the lanes where something holds: & (zero - it)
  const I y_bits = (I)y, x_bits = (I)x, sign = y_bits & (one << last), is_behind = x_bits >> last;
  const I b = y_bits ^ sign, a = x_bits ^ (is_behind << last), is_steep = (a - b) >> last;
  const I exchange = (a ^ b) & (zero - is_steep);
  const V large = (V)(a ^ exchange), small = (V)(b ^ exchange);
  const I is_wide =
      ((I)(large * number(is_double ? 0.5463024898437905 : 0.5463025)) - (b ^ exchange)) >> last;
  const V turn = (V)(unit & (zero - is_wide)),
          nothing = (V)(unit & (zero - (((a ^ exchange) - one) >> last)));
  const V t = (small - turn * large) / (large + turn * small + nothing), z = t * t;
  V angle;
  if constexpr (is_double) {
    const V w = z * z, v = w * w;
    const V low =
        (-0.3333333333333333 + z * 0.1999999999999723) + w * (-0.142857142851601 + z * 0.11111111068604916);
    const V middle = (-0.09090907407679288 + z * 0.07692268042911367) +
                     w * (-0.06666065366369484 + z * 0.058762025197991216);
    const V high = (-0.05219603216056109 + z * 0.04545914188460735) +
                   w * (-0.035981529310843786 + z * 0.0219654180922859);
    angle = t + t * z * (low + v * (middle + v * (high + v * -0.007274827974643591)));
  } else {
    const V low = (-0.3333333f + z * 0.19999681f) + z * z * (-0.1427416f + z * 0.1094557f);
    angle = t + t * z * (low + z * z * z * z * (-0.079587296f + z * 0.037864342f));
  }
  const I is_back = is_steep ^ is_behind;
  const V steep = (V)(unit & (zero - is_steep)), behind = (V)(unit & (zero - (is_behind & ~is_steep))),
          back = (V)(unit & (zero - (is_wide & is_back)));
  const V eighths = steep * number(2) + behind * number(4) + turn - back * number(2);
  const V part = (V)((I)angle ^ (is_back << last));
  const V rest = part + eighths * number(is_double ? 3.061616997868383e-17 : 1.5695824e-07);
  result = (V)((I)(eighths * number(is_double ? 0.7853981633974483 : 0.785398) + rest) ^ sign);
}

namespace detail {

/// Whether each lane is a number of at most the limit.
template <class Real, std::size_t lanes, class V>
JOURDAIN_PACK_FUNCTION inline bool are_at_most(const V& x, Real limit) noexcept {
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64 && sizeof(Real) == 8)
    return _mm512_cmp_pd_mask((__m512d)x, _mm512_set1_pd(limit), _CMP_LE_OQ) == 0xff;
  else if constexpr (sizeof(V) == 64)
    return _mm512_cmp_ps_mask((__m512)x, _mm512_set1_ps(limit), _CMP_LE_OQ) == 0xffff;
#endif
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32 && sizeof(Real) == 8)
    return _mm256_movemask_pd(_mm256_cmp_pd((__m256d)x, _mm256_set1_pd(limit), _CMP_LE_OQ)) == 0xf;
  else if constexpr (sizeof(V) == 32)
    return _mm256_movemask_ps(_mm256_cmp_ps((__m256)x, _mm256_set1_ps(limit), _CMP_LE_OQ)) == 0xff;
#endif
  const auto within = x <= limit;
  bool all = true;
  for (std::size_t i = 0; i < lanes; ++i) all &= within[i] != 0;
  return all;
}

}  // namespace detail

/// Of `magnitude`, |x|, up to 2^30 as they are; by the C library where a lane is beyond.
template <class Real, std::size_t lanes, class Sines>
JOURDAIN_PACK_FUNCTION inline void Pack<Real, lanes, Sines>::keep_in_range(const Vector& x,
                                                                           const Vector& magnitude, Vector& s,
                                                                           Vector& c) noexcept {
  if (__builtin_expect(detail::are_at_most<Real, lanes>(magnitude, Real{1073741824}), 1)) return;
  const Vector angles = x;
  Vector sines = s, cosines = c;
  call_library(angles, sines, cosines);
  s = sines;
  c = cosines;
}

template <class Real, std::size_t lanes, class Sines>
__attribute__((noinline, cold)) void Pack<Real, lanes, Sines>::call_library(const Vector& x, Vector& s,
                                                                            Vector& c) noexcept {
  for (std::size_t i = 0; i < lanes; ++i)
    if (!(std::fabs(x[i]) <= Real{1073741824})) {
      s[i] = static_cast<Real>(std::sin(static_cast<double>(x[i])));
      c[i] = static_cast<Real>(std::cos(static_cast<double>(x[i])));
    }
}

/// Up to 2^30 as the emitted functions for double do it (see there for its sources); beyond, and for what is no number,
/// by the C library.
template <class Real, std::size_t lanes, class Sines>
JOURDAIN_PACK_FUNCTION inline void Pack<Real, lanes, Sines>::sines_of_doubles(const Vector& x, Vector& s,
                                                                              Vector& c) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  using V = Vector;
  using I = BitVector;
  const std::uint64_t one = 1;
  const I bits = (I)x, sign = bits & (one << 63);
  const V a = (V)(bits ^ sign), shifted = a * 0.6366197723675814 + 6755399441055744.0;
  const I n = (I)shifted;
  const V k = shifted - 6755399441055744.0;
  const V r = (a - k * 1.570796251296997) - k * 7.549789415861596e-08;
  const V p = k * 5.39030083589187e-15, q = k * 2.0222659584103533e-21;
  const V g = r - p, h = g - q;
  const V l = (((g - h) - q) + ((r - g) - p)) - k * 2.9038559739793605e-28;
  const V z = h * h, y = z * z, half = z * 0.5, w = 1.0 - half;
  const V odd = (-0.1666666666666663 + z * 0.008333333333321915) +
                y * ((-0.00019841269829453883 + z * 2.7557313580182605e-06) +
                     y * (-2.505074193536228e-08 + z * 1.589591844424868e-10));
  const V even = (0.0416666666666666 + z * -0.0013888888888874474) +
                 y * ((2.4801587289670344e-05 + z * -2.755731440021842e-07) +
                      y * (2.0875729102264816e-09 + z * -1.1359921420814053e-11));
  detail::turn((I)(h + (h * z * odd + l * w)), (I)(w + (((1.0 - w) - half) + (y * even - h * l))), n, sign, s,
               c);
  keep_in_range(x, a, s, c);
}

/// Up to 2^30 in double, with pi/2 in parts whose products with n are exact but for the last, and with polynomials that
/// are good to 2^-33 (Remez exchange); beyond, and for what is no number, by the C library.
template <class Real, std::size_t lanes, class Sines>
JOURDAIN_PACK_FUNCTION inline void Pack<Real, lanes, Sines>::sines_of_floats(const Vector& x, Vector& s,
                                                                             Vector& c) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  constexpr std::size_t count = natural_lanes<double> < lanes ? natural_lanes<double> : lanes;
  using F = typename detail::VectorOf<float, count>::Type;
  using V = typename detail::VectorOf<double, count>::Type;
  using I = typename detail::VectorOf<std::uint64_t, count>::Type;
  const std::uint64_t one = 1;
  F part, sines, cosines;
  for (std::size_t first = 0; first < lanes; first += count) {
    std::memcpy(&part, reinterpret_cast<const char*>(&x) + first * sizeof(float), sizeof part);
    const V wide = __builtin_convertvector(part, V);
    const I bits = (I)wide, sign = bits & (one << 63);
    const V a = (V)(bits ^ sign), shifted = a * 0.6366197723675814 + 6755399441055744.0;
    const I n = (I)shifted;
    const V k = shifted - 6755399441055744.0;
    const V h = ((a - k * 1.570796251296997) - k * 7.549789415861596e-08) - k * 5.390302858158119e-15;
    const V z = h * h, y = z * z;
    const V odd = (-0.1666666664162689 + z * 0.00833332938593308) +
                  y * (-0.000198393348503717 + z * 2.7183116319069146e-06);
    const V even = (0.04166664686638351 + z * -0.0013887367512708504) + y * 2.4438451232557072e-05;
    V wide_sines, wide_cosines;
    detail::turn((I)(h + h * z * odd), (I)((1.0 - z * 0.5) + y * even), n, sign, wide_sines, wide_cosines);
    sines = __builtin_convertvector(wide_sines, F);
    cosines = __builtin_convertvector(wide_cosines, F);
    std::memcpy(reinterpret_cast<char*>(&s) + first * sizeof(float), &sines, sizeof part);
    std::memcpy(reinterpret_cast<char*>(&c) + first * sizeof(float), &cosines, sizeof part);
  }
  const Bits magnitude = 0x7fffffff;
  keep_in_range(x, (Vector)((BitVector)x & magnitude), s, c);
}

}  // namespace jourdain
