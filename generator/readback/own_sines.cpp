#include "readback/own_sines.hpp"

namespace jourdain::readback {

const char* own_sines() {
  return R"(#if defined(JOURDAIN_LIBRARY_SINES)
#elif defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__ROUNDING_MATH__) || defined(_M_FP_FAST)
#define JOURDAIN_LIBRARY_SINES
#elif __FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2 || defined(__INTEL_COMPILER)
#define JOURDAIN_LIBRARY_SINES
#elif defined(__clang__) && __clang_major__ < 11
#define JOURDAIN_LIBRARY_SINES
#elif !defined(__clang__) && ((defined(__GNUC__) && __GNUC__ < 11) || defined(__CUDACC__))
#define JOURDAIN_LIBRARY_SINES
#endif
#if defined(JOURDAIN_LIBRARY_SINES)
JOURDAIN_FUNCTION inline double sine(double x) noexcept { return ::sin(x); }
JOURDAIN_FUNCTION inline double cosine(double x) noexcept { return ::cos(x); }
JOURDAIN_FUNCTION inline float sine(float x) noexcept { return ::sinf(x); }
JOURDAIN_FUNCTION inline float cosine(float x) noexcept { return ::cosf(x); }
#else
template <class V, class I> JOURDAIN_FUNCTION
#if defined(__GNUC__)
__attribute__((always_inline))
#endif
inline void sine_cosine_in_range(const V& x, V& s, V& c) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  const unsigned long long one = 1, zero = 0;
  const I bits = __builtin_bit_cast(I, x), sign = bits & (one << 63);
  const V a = __builtin_bit_cast(V, bits ^ sign), shifted = a * 0.6366197723675814 + 6755399441055744.0;
  const I n = __builtin_bit_cast(I, shifted);
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
  const I sine_bits = __builtin_bit_cast(I, h + (h * z * odd + l * w));
  const I cosine_bits = __builtin_bit_cast(I, w + (((1.0 - w) - half) + (y * even - h * l)));
  const I exchange = (sine_bits ^ cosine_bits) & (zero - (n & one));
  s = __builtin_bit_cast(V, sine_bits ^ exchange ^ sign ^ ((n << 62) & (one << 63)));
  c = __builtin_bit_cast(V, cosine_bits ^ exchange ^ (((n + one) << 62) & (one << 63)));
}
JOURDAIN_FUNCTION inline bool is_in_range(double x) noexcept { return x <= 1073741824.0 && x >= -1073741824.0; }
JOURDAIN_FUNCTION inline void sine_cosine(const double& x, double& s, double& c) noexcept {
  if (is_in_range(x)) {
    sine_cosine_in_range<double, unsigned long long>(x, s, c);
  } else {
    s = ::sin(x);
    c = ::cos(x);
  }
}
JOURDAIN_FUNCTION inline double sine(double x) noexcept {
  double s, c;
  sine_cosine(x, s, c);
  return s;
}
JOURDAIN_FUNCTION inline double cosine(double x) noexcept {
  double s, c;
  sine_cosine(x, s, c);
  return c;
}
JOURDAIN_FUNCTION inline void sine_cosine(const float& x, float& s, float& c) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  const unsigned two_over_pi[8] = {40, 3194018707, 2433043071, 165016701, 1295478838, 3634718287,
                                   283381887, 2488855287};
  const unsigned one = 1, bits = __builtin_bit_cast(unsigned, x), sign = bits & (one << 31), a = bits ^ sign;
  const unsigned keep = ((a - 1061752796) >> 31) - 1;
  const unsigned above = (a >> 23) - 126, begin = above & ((above >> 31) - 1), m = (a & 8388607) | 8388608;
  const unsigned word = begin / 32, left = 32 - (begin & 31);
  const unsigned long long first = two_over_pi[word], second = two_over_pi[word + 1];
  const unsigned long long third = two_over_pi[word + 2], fourth = two_over_pi[word + 3];
  const unsigned w0 = static_cast<unsigned>(((first << 32) | second) >> left);
  const unsigned w1 = static_cast<unsigned>(((second << 32) | third) >> left);
  const unsigned w2 = static_cast<unsigned>(((third << 32) | fourth) >> left);
  const unsigned long long wide = 1, mantissa = m;
  const unsigned long long turns = ((mantissa * w0) << 32) + mantissa * w1 + ((mantissa * w2) >> 32);
  const unsigned n = static_cast<unsigned>((turns + (wide << 61)) >> 62) & keep;
  const unsigned long long rest = turns - (static_cast<unsigned long long>(n) << 62), negative = rest >> 63;
  const unsigned long long f = (rest ^ (0 - negative)) + negative, f1 = f >> 32, f0 = f & 4294967295;
  const unsigned long long r = f1 * 3373259426 + ((f1 * 560513588) >> 32) + ((f0 * 3373259426) >> 32);
  const float r1 = static_cast<float>(static_cast<int>(r >> 38)) * 1.1920929e-07f;
  const float r2 = static_cast<float>(static_cast<int>((r >> 14) & 16777215)) * 7.1054274e-15f;
  const float r3 = static_cast<float>(static_cast<int>(r & 16383)) * 4.3368087e-19f;
  const float sum = r1 + r2;
  const float h = __builtin_bit_cast(float, (__builtin_bit_cast(unsigned, sum) & keep) | (a & ~keep));
  const float l = __builtin_bit_cast(float, __builtin_bit_cast(unsigned, (r2 - (sum - r1)) + r3) & keep);
  const float z = h * h, half = z * 0.5f, w = 1.0f - half;
  const float odd = -0.16666655f + z * (0.008332189f + z * -0.00019518277f);
  const float even = 0.041666646f + z * (-0.0013887313f + z * 2.4432964e-05f);
  const unsigned flip = (static_cast<unsigned>(negative) << 31) & keep;
  const unsigned sine_bits = __builtin_bit_cast(unsigned, h + (h * z * odd + l * w)) ^ flip;
  const unsigned cosine_bits = __builtin_bit_cast(unsigned, w + (((1.0f - w) - half) + (z * z * even - h * l)));
  const unsigned exchange = (sine_bits ^ cosine_bits) & (0 - (n & one));

  if (a < 2139095040) {
    s = __builtin_bit_cast(float, sine_bits ^ exchange ^ sign ^ ((n << 30) & (one << 31)));
    c = __builtin_bit_cast(float, cosine_bits ^ exchange ^ (((n + one) << 30) & (one << 31)));
  } else {
    s = x - x;
    c = x - x;
  }
}
JOURDAIN_FUNCTION inline float sine(float x) noexcept {
  float s, c;
  sine_cosine(x, s, c);
  return s;
}
JOURDAIN_FUNCTION inline float cosine(float x) noexcept {
  float s, c;
  sine_cosine(x, s, c);
  return c;
}
#endif
)";
}

const char* own_arctangent() {
  return R"(#if defined(JOURDAIN_LIBRARY_SINES)
JOURDAIN_FUNCTION inline double arctangent2(double y, double x) noexcept { return ::atan2(y, x); }
JOURDAIN_FUNCTION inline float arctangent2(float y, float x) noexcept { return ::atan2f(y, x); }
#else
JOURDAIN_FUNCTION inline double arctangent2(double y, double x) noexcept {
  using Bits = unsigned long long;
  const Bits one = 1, y_bits = __builtin_bit_cast(Bits, y), x_bits = __builtin_bit_cast(Bits, x);
  const Bits sign = y_bits & (one << 63), is_behind = x_bits >> 63;
  const Bits b = y_bits ^ sign, a = x_bits ^ (is_behind << 63), is_steep = (a - b) >> 63;
  const Bits exchange = (a ^ b) & (0 - is_steep);
  const double large = __builtin_bit_cast(double, a ^ exchange), small = __builtin_bit_cast(double, b ^ exchange);
  const Bits is_wide = (__builtin_bit_cast(Bits, large * 0.5463024898437905) - (b ^ exchange)) >> 63;
  const int wide = static_cast<int>(is_wide), nothing = static_cast<int>(((a ^ exchange) - one) >> 63);
  const double turn = static_cast<double>(wide);
  const double t = (small - turn * large) / (large + turn * small + static_cast<double>(nothing)), z = t * t;
  const double w = z * z, v = w * w;
  const double low = (-0.3333333333333333 + z * 0.1999999999999723) +
                     w * (-0.142857142851601 + z * 0.11111111068604916);
  const double middle = (-0.09090907407679288 + z * 0.07692268042911367) +
                        w * (-0.06666065366369484 + z * 0.058762025197991216);
  const double high = (-0.05219603216056109 + z * 0.04545914188460735) +
                      w * (-0.035981529310843786 + z * 0.0219654180922859);
  const double angle = t + t * z * (low + v * (middle + v * (high + v * -0.007274827974643591)));
  const Bits is_back = is_steep ^ is_behind;
  const int quarters = static_cast<int>(is_steep + ((is_behind & ~is_steep) << 1));
  const double eighths = static_cast<double>(2 * quarters + wide - 2 * static_cast<int>(is_wide & is_back));
  const Bits part = __builtin_bit_cast(Bits, angle) ^ (is_back << 63);
  const double rest = __builtin_bit_cast(double, part) + eighths * 3.061616997868383e-17;
  return __builtin_bit_cast(double, __builtin_bit_cast(Bits, eighths * 0.7853981633974483 + rest) ^ sign);
}
JOURDAIN_FUNCTION inline float arctangent2(float y, float x) noexcept {
  using Bits = unsigned;
  const Bits one = 1, y_bits = __builtin_bit_cast(Bits, y), x_bits = __builtin_bit_cast(Bits, x);
  const Bits sign = y_bits & (one << 31), is_behind = x_bits >> 31;
  const Bits b = y_bits ^ sign, a = x_bits ^ (is_behind << 31), is_steep = (a - b) >> 31;
  const Bits exchange = (a ^ b) & (0 - is_steep);
  const float large = __builtin_bit_cast(float, a ^ exchange), small = __builtin_bit_cast(float, b ^ exchange);
  const Bits is_wide = (__builtin_bit_cast(Bits, large * 0.5463025f) - (b ^ exchange)) >> 31;
  const int wide = static_cast<int>(is_wide), nothing = static_cast<int>(((a ^ exchange) - one) >> 31);
  const float turn = static_cast<float>(wide);
  const float t = (small - turn * large) / (large + turn * small + static_cast<float>(nothing)), z = t * t;
  const float low = (-0.3333333f + z * 0.19999681f) + z * z * (-0.1427416f + z * 0.1094557f);
  const float angle = t + t * z * (low + z * z * z * z * (-0.079587296f + z * 0.037864342f));
  const Bits is_back = is_steep ^ is_behind;
  const int quarters = static_cast<int>(is_steep + ((is_behind & ~is_steep) << 1));
  const float eighths = static_cast<float>(2 * quarters + wide - 2 * static_cast<int>(is_wide & is_back));
  const Bits part = __builtin_bit_cast(Bits, angle) ^ (is_back << 31);
  const float rest = __builtin_bit_cast(float, part) + eighths * 1.5695824e-07f;
  return __builtin_bit_cast(float, __builtin_bit_cast(Bits, eighths * 0.785398f + rest) ^ sign);
}
#endif
)";
}

const char* library_sines() {
  return R"(JOURDAIN_FUNCTION inline double sine(double x) noexcept { return ::sin(x); }
JOURDAIN_FUNCTION inline double cosine(double x) noexcept { return ::cos(x); }
JOURDAIN_FUNCTION inline float sine(float x) noexcept { return ::sinf(x); }
JOURDAIN_FUNCTION inline float cosine(float x) noexcept { return ::cosf(x); }
)";
}

const char* library_arctangent() {
  return R"(JOURDAIN_FUNCTION inline double arctangent2(double y, double x) noexcept { return ::atan2(y, x); }
JOURDAIN_FUNCTION inline float arctangent2(float y, float x) noexcept { return ::atan2f(y, x); }
)";
}

}  // namespace jourdain::readback
