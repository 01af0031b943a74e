#include "readback/c_known_text.hpp"

#include <array>

namespace jourdain::readback {

namespace {

using Passage = CPassage;

constexpr std::array<Passage, 5> kDouble = {{
    {"sine_bits", R"(#if defined(JOURDAIN_LIBRARY_SINES)
#elif defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__ROUNDING_MATH__) || defined(_M_FP_FAST)
#define JOURDAIN_LIBRARY_SINES
#elif __FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2 || defined(__INTEL_COMPILER)
#define JOURDAIN_LIBRARY_SINES
#elif defined(__clang__) && __clang_major__ < 11
#define JOURDAIN_LIBRARY_SINES
#endif
#if !defined(JOURDAIN_LIBRARY_SINES)
typedef char @D@sine_bits_fit[sizeof(double) == sizeof(unsigned long long) ? 1 : -1];
static unsigned long long @D@sine_bits(double x) {
  union {
    double value;
    unsigned long long bits;
  } both;

  both.value = x;
  return both.bits;
}

static double @D@sine_value(unsigned long long bits) {
  union {
    double value;
    unsigned long long bits;
  } both;

  both.bits = bits;
  return both.value;
}
#endif
)"},
    {"sine_cosine", R"(#if defined(JOURDAIN_LIBRARY_SINES)
static void @D@sine_cosine(double x, double *s, double *c) {
  *s = sin(x);
  *c = cos(x);
}
#else
static void @D@sine_cosine(double x, double *s, double *c) {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  const unsigned long long one = 1, bits = @D@sine_bits(x), sign = bits & (one << 63);
  const double a = @D@sine_value(bits ^ sign), shifted = a * 0.6366197723675814 + 6755399441055744.0;
  const unsigned long long n = @D@sine_bits(shifted);
  const double k = shifted - 6755399441055744.0;
  const double r = (a - k * 1.570796251296997) - k * 7.549789415861596e-08;
  const double p = k * 5.39030083589187e-15, q = k * 2.0222659584103533e-21;
  const double g = r - p, h = g - q;
  const double l = (((g - h) - q) + ((r - g) - p)) - k * 2.9038559739793605e-28;
  const double z = h * h, y = z * z, half = z * 0.5, w = 1.0 - half;
  const double odd = (-0.1666666666666663 + z * 0.008333333333321915) +
                     y * ((-0.00019841269829453883 + z * 2.7557313580182605e-06) +
                          y * (-2.505074193536228e-08 + z * 1.589591844424868e-10));
  const double even = (0.0416666666666666 + z * -0.0013888888888874474) +
                      y * ((2.4801587289670344e-05 + z * -2.755731440021842e-07) +
                           y * (2.0875729102264816e-09 + z * -1.1359921420814053e-11));
  const unsigned long long sine_bits = @D@sine_bits(h + (h * z * odd + l * w));
  const unsigned long long cosine_bits = @D@sine_bits(w + (((1.0 - w) - half) + (y * even - h * l)));
  const unsigned long long exchange = (sine_bits ^ cosine_bits) & (0 - (n & one));

  if (a <= 1073741824.0) {
    *s = @D@sine_value(sine_bits ^ exchange ^ sign ^ ((n << 62) & (one << 63)));
    *c = @D@sine_value(cosine_bits ^ exchange ^ (((n + one) << 62) & (one << 63)));
  } else {
    *s = sin(x);
    *c = cos(x);
  }
}
#endif
)"},
    {"sine", R"(static double @D@sine(double x) {
  double s, c;

  @D@sine_cosine(x, &s, &c);
  return s;
}
)"},
    {"cosine", R"(static double @D@cosine(double x) {
  double s, c;

  @D@sine_cosine(x, &s, &c);
  return c;
}
)"},
    {"arctangent2", R"(#if defined(JOURDAIN_LIBRARY_SINES)
static double @D@arctangent2(double y, double x) {
  return atan2(y, x);
}
#else
static double @D@arctangent2(double y, double x) {
  const unsigned long long one = 1, y_bits = @D@sine_bits(y), x_bits = @D@sine_bits(x);
  const unsigned long long sign = y_bits & (one << 63), is_behind = x_bits >> 63;
  const unsigned long long b = y_bits ^ sign, a = x_bits ^ (is_behind << 63), is_steep = (a - b) >> 63;
  const unsigned long long exchange = (a ^ b) & (0 - is_steep);
  const double large = @D@sine_value(a ^ exchange), small = @D@sine_value(b ^ exchange);
  const unsigned long long is_wide = (@D@sine_bits(large * 0.5463024898437905) - (b ^ exchange)) >> 63;
  const int wide = (int)is_wide, nothing = (int)(((a ^ exchange) - one) >> 63);
  const double turn = (double)wide;
  const double t = (small - turn * large) / (large + turn * small + (double)nothing), z = t * t;
  const double w = z * z, v = w * w;
  const double low = (-0.3333333333333333 + z * 0.1999999999999723) +
                     w * (-0.142857142851601 + z * 0.11111111068604916);
  const double middle = (-0.09090907407679288 + z * 0.07692268042911367) +
                        w * (-0.06666065366369484 + z * 0.058762025197991216);
  const double high = (-0.05219603216056109 + z * 0.04545914188460735) +
                      w * (-0.035981529310843786 + z * 0.0219654180922859);
  const double angle = t + t * z * (low + v * (middle + v * (high + v * -0.007274827974643591)));
  const unsigned long long is_back = is_steep ^ is_behind;
  const int quarters = (int)(is_steep + ((is_behind & ~is_steep) << 1));
  const double eighths = (double)(2 * quarters + wide - 2 * (int)(is_wide & is_back));
  const unsigned long long part = @D@sine_bits(angle) ^ (is_back << 63);
  const double rest = @D@sine_value(part) + eighths * 3.061616997868383e-17;

  return @D@sine_value(@D@sine_bits(eighths * 0.7853981633974483 + rest) ^ sign);
}
#endif
)"},
}};

constexpr std::array<Passage, 5> kFloat = {{
    {"sine_bits", R"(#if defined(JOURDAIN_LIBRARY_SINES)
#elif defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__ROUNDING_MATH__) || defined(_M_FP_FAST)
#define JOURDAIN_LIBRARY_SINES
#elif __FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2 || defined(__INTEL_COMPILER)
#define JOURDAIN_LIBRARY_SINES
#elif defined(__clang__) && __clang_major__ < 11
#define JOURDAIN_LIBRARY_SINES
#endif
#if !defined(JOURDAIN_LIBRARY_SINES)
typedef char @D@sine_bits_fit[sizeof(float) == sizeof(unsigned) ? 1 : -1];
static unsigned @D@sine_bits(float x) {
  union {
    float value;
    unsigned bits;
  } both;

  both.value = x;
  return both.bits;
}

static float @D@sine_value(unsigned bits) {
  union {
    float value;
    unsigned bits;
  } both;

  both.bits = bits;
  return both.value;
}
#endif
)"},
    {"sine_cosine", R"(#if defined(JOURDAIN_LIBRARY_SINES)
static void @D@sine_cosine(float x, float *s, float *c) {
  *s = sinf(x);
  *c = cosf(x);
}
#else
static void @D@sine_cosine(float x, float *s, float *c) {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  static const unsigned two_over_pi[8] = {40, 3194018707, 2433043071, 165016701, 1295478838, 3634718287,
                                          283381887, 2488855287};
  const unsigned one = 1, bits = @D@sine_bits(x), sign = bits & (one << 31), a = bits ^ sign;
  const unsigned keep = ((a - 1061752796) >> 31) - 1;
  const unsigned above = (a >> 23) - 126, begin = above & ((above >> 31) - 1), m = (a & 8388607) | 8388608;
  const unsigned word = begin / 32, left = 32 - (begin & 31);
  const unsigned long long first = two_over_pi[word], second = two_over_pi[word + 1];
  const unsigned long long third = two_over_pi[word + 2], fourth = two_over_pi[word + 3];
  const unsigned w0 = (unsigned)(((first << 32) | second) >> left);
  const unsigned w1 = (unsigned)(((second << 32) | third) >> left);
  const unsigned w2 = (unsigned)(((third << 32) | fourth) >> left);
  const unsigned long long wide = 1, mantissa = m;
  const unsigned long long turns = ((mantissa * w0) << 32) + mantissa * w1 + ((mantissa * w2) >> 32);
  const unsigned n = (unsigned)((turns + (wide << 61)) >> 62) & keep;
  const unsigned long long rest = turns - ((unsigned long long)n << 62), negative = rest >> 63;
  const unsigned long long f = (rest ^ (0 - negative)) + negative, f1 = f >> 32, f0 = f & 4294967295;
  const unsigned long long r = f1 * 3373259426 + ((f1 * 560513588) >> 32) + ((f0 * 3373259426) >> 32);
  const float r1 = (float)(int)(r >> 38) * 1.1920929e-07f;
  const float r2 = (float)(int)((r >> 14) & 16777215) * 7.1054274e-15f;
  const float r3 = (float)(int)(r & 16383) * 4.3368087e-19f;
  const float sum = r1 + r2;
  const float h = @D@sine_value((@D@sine_bits(sum) & keep) | (a & ~keep));
  const float l = @D@sine_value(@D@sine_bits((r2 - (sum - r1)) + r3) & keep);
  const float z = h * h, half = z * 0.5f, w = 1.0f - half;
  const float odd = -0.16666655f + z * (0.008332189f + z * -0.00019518277f);
  const float even = 0.041666646f + z * (-0.0013887313f + z * 2.4432964e-05f);
  const unsigned flip = ((unsigned)negative << 31) & keep;
  const unsigned sine_bits = @D@sine_bits(h + (h * z * odd + l * w)) ^ flip;
  const unsigned cosine_bits = @D@sine_bits(w + (((1.0f - w) - half) + (z * z * even - h * l)));
  const unsigned exchange = (sine_bits ^ cosine_bits) & (0 - (n & one));

  if (a < 2139095040) {
    *s = @D@sine_value(sine_bits ^ exchange ^ sign ^ ((n << 30) & (one << 31)));
    *c = @D@sine_value(cosine_bits ^ exchange ^ (((n + one) << 30) & (one << 31)));
  } else {
    *s = x - x;
    *c = x - x;
  }
}
#endif
)"},
    {"sine", R"(static float @D@sine(float x) {
  float s, c;

  @D@sine_cosine(x, &s, &c);
  return s;
}
)"},
    {"cosine", R"(static float @D@cosine(float x) {
  float s, c;

  @D@sine_cosine(x, &s, &c);
  return c;
}
)"},
    {"arctangent2", R"(#if defined(JOURDAIN_LIBRARY_SINES)
static float @D@arctangent2(float y, float x) {
  return atan2f(y, x);
}
#else
static float @D@arctangent2(float y, float x) {
  const unsigned one = 1, y_bits = @D@sine_bits(y), x_bits = @D@sine_bits(x);
  const unsigned sign = y_bits & (one << 31), is_behind = x_bits >> 31;
  const unsigned b = y_bits ^ sign, a = x_bits ^ (is_behind << 31), is_steep = (a - b) >> 31;
  const unsigned exchange = (a ^ b) & (0 - is_steep);
  const float large = @D@sine_value(a ^ exchange), small = @D@sine_value(b ^ exchange);
  const unsigned is_wide = (@D@sine_bits(large * 0.5463025f) - (b ^ exchange)) >> 31;
  const int wide = (int)is_wide, nothing = (int)(((a ^ exchange) - one) >> 31);
  const float turn = (float)wide;
  const float t = (small - turn * large) / (large + turn * small + (float)nothing), z = t * t;
  const float low = (-0.3333333f + z * 0.19999681f) + z * z * (-0.1427416f + z * 0.1094557f);
  const float angle = t + t * z * (low + z * z * z * z * (-0.079587296f + z * 0.037864342f));
  const unsigned is_back = is_steep ^ is_behind;
  const int quarters = (int)(is_steep + ((is_behind & ~is_steep) << 1));
  const float eighths = (float)(2 * quarters + wide - 2 * (int)(is_wide & is_back));
  const unsigned part = @D@sine_bits(angle) ^ (is_back << 31);
  const float rest = @D@sine_value(part) + eighths * 1.5695824e-07f;

  return @D@sine_value(@D@sine_bits(eighths * 0.785398f + rest) ^ sign);
}
#endif
)"},
}};

/// What those of the same name compute.
constexpr std::array<Passage, 4> kMeanings = {{
    {"sine_cosine", R"(static void @D@sine_cosine(@R@ x, @R@ *s, @R@ *c) {
  *s = sin@F@(x);
  *c = cos@F@(x);
}
)"},
    {"sine", R"(static @R@ @D@sine(@R@ x) {
  return sin@F@(x);
}
)"},
    {"cosine", R"(static @R@ @D@cosine(@R@ x) {
  return cos@F@(x);
}
)"},
    {"arctangent2", R"(static @R@ @D@arctangent2(@R@ y, @R@ x) {
  return atan2@F@(y, x);
}
)"},
}};

}  // namespace

void CKnownTexts::add_own_sines(const CText& c) {
  const auto add_all = [&](const auto& passages) {
    for (const Passage& passage : passages) {
      CKnownText& made = add(passage, c);
      for (const Passage& meaning : kMeanings)
        if (made.name == meaning.name) {
          made.meaning_text = filled(meaning.text, c);
          made.meaning = tokenize(made.name, made.meaning_text);
        }
    }
  };
  if (c.is_float)
    add_all(kFloat);
  else
    add_all(kDouble);
}

}  // namespace jourdain::readback
