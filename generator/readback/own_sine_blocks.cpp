#include "readback/own_sine_blocks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace jourdain::readback {

namespace {

constexpr const char* kByLane = R"(template <class Real, class Lanes> __attribute__((noinline, cold))
void sine_cosine_by_lane(const Lanes& x, Lanes& s, Lanes& c) noexcept {
  for (unsigned i = 0; i < sizeof(x) / sizeof(Real); ++i) {
    Real sine, cosine;
    sine_cosine(x[i], sine, cosine);
    s[i] = sine;
    c[i] = cosine;
  }
}
)";

constexpr const char* kFloatKernel =
    R"(template <class V, class I, class S, class W> __attribute__((always_inline))
inline void float_sine_cosine_in_range(const V& x, V& s, V& c) noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  const unsigned nothing = 0, one = 1, word = 32;
  const unsigned long long wide = 1, zero = 0, low = 4294967295, word1 = 3194018707, word2 = 2433043071;
  const unsigned long long word3 = 165016701, first = 174992710547, second = (word1 << 32) | word2;
  const unsigned long long third = (word2 << 32) | word3;
  const I bits = __builtin_bit_cast(I, x), sign = bits & (one << 31), a = bits ^ sign;
  const I keep = ((a - 1061752796) >> 31) - one;
  const I above = (a >> 23) - 126, begin = above & ((above >> 31) - one);
  const W m = __builtin_convertvector((a & 8388607) | 8388608, W);
  const W left = __builtin_convertvector(word - begin, W), kept = __builtin_convertvector(keep, W);
  const W w0 = (first >> left) & low, w1 = (second >> left) & low, w2 = (third >> left) & low;
  const W turns = ((m * w0) << 32) + m * w1 + ((m * w2) >> 32);
  const W quarter = ((turns + (wide << 61)) >> 62) & kept;
  const W rest = turns - (quarter << 62), minus = rest >> 63;
  const W f = (rest ^ (zero - minus)) + minus, f1 = f >> 32, f0 = f & low;
  const W r = f1 * 3373259426 + ((f1 * 560513588) >> 32) + ((f0 * 3373259426) >> 32);
  const V r1 = __builtin_convertvector(__builtin_convertvector(r >> 38, S), V) * 1.1920929e-07f;
  const V r2 = __builtin_convertvector(__builtin_convertvector((r >> 14) & 16777215, S), V) * 7.1054274e-15f;
  const V r3 = __builtin_convertvector(__builtin_convertvector(r & 16383, S), V) * 4.3368087e-19f;
  const V sum = r1 + r2;
  const V h = __builtin_bit_cast(V, (__builtin_bit_cast(I, sum) & keep) | (a & ~keep));
  const V l = __builtin_bit_cast(V, __builtin_bit_cast(I, (r2 - (sum - r1)) + r3) & keep);
  const V z = h * h, half = z * 0.5f, w = 1.0f - half;
  const V odd = -0.16666655f + z * (0.008332189f + z * -0.00019518277f);
  const V even = 0.041666646f + z * (-0.0013887313f + z * 2.4432964e-05f);
  const I n = __builtin_convertvector(quarter, I), negative = __builtin_convertvector(minus, I);
  const I flip = (negative << 31) & keep;
  const I sine_bits = __builtin_bit_cast(I, h + (h * z * odd + l * w)) ^ flip;
  const I cosine_bits = __builtin_bit_cast(I, w + (((1.0f - w) - half) + (z * z * even - h * l)));
  const I exchange = (sine_bits ^ cosine_bits) & (nothing - (n & one));
  s = __builtin_bit_cast(V, sine_bits ^ exchange ^ sign ^ ((n << 30) & (one << 31)));
  c = __builtin_bit_cast(V, cosine_bits ^ exchange ^ (((n + one) << 30) & (one << 31)));
}
)";

std::string where(const char* vectors, const std::string& text) {
  return fmt::format(
      "#if !defined(JOURDAIN_LIBRARY_SINES)\n#if defined(__GNUC__) && !defined(__CUDA__) && "
      "!defined(__CUDACC__) && "
      "{}\n{}#endif\n#endif\n",
      vectors, text);
}

std::string block(bool is_float, int count, const char* inlined) {
  const char* real = is_float ? "float" : "double";
  const int lanes = is_float || count > 2 ? 4 : 2;
  std::vector<std::string> parameters, angles, above, results;
  for (int i = 0; i < lanes; ++i) angles.push_back(fmt::format("x{}", i < count ? i : count - 1));
  for (int i = 0; i < count; ++i) {
    parameters.push_back(fmt::format("const {0}& x{1}, {0}& s{1}, {0}& c{1}", real, i));
    above.push_back(fmt::format("above[{}]", i));
    results.push_back(fmt::format("s{0} = s[{0}]; c{0} = c[{0}];", i));
  }
  std::string types, kernel = "sine_cosine_in_range<Lanes, Bits>";
  if (is_float) {
    kernel = "float_sine_cosine_in_range<Lanes, Bits, Integers, Words>";
    types =
        "typedef unsigned Bits __attribute__((vector_size(16)));\n"
        "typedef int Integers __attribute__((vector_size(16)));\n"
        "typedef unsigned long long Words __attribute__((vector_size(32)));\n"
        "const unsigned one = 1, largest = 1325400063;\n";
  } else {
    types = fmt::format(
        "typedef unsigned long long Bits __attribute__((vector_size({})));\n"
        "const unsigned long long one = 1, largest = 4742290407621132288;\n",
        8 * lanes);
  }
  return fmt::format(
      "JOURDAIN_FUNCTION __attribute__(({inlined})) inline void sine_cosine{count}({parameters}) noexcept "
      "{{\n"
      "typedef {real} Lanes __attribute__((vector_size({bytes})));\n{types}"
      "const Lanes x = {{{angles}}};\n"
      "const Bits above = largest - (__builtin_bit_cast(Bits, x) & ~(one << {sign}));\n"
      "Lanes s, c;\n"
      "if (({above}) >> {sign}) {{\n"
      "const Lanes each = x; Lanes sines, cosines; sine_cosine_by_lane<{real}>(each, sines, cosines);\n"
      "s = sines; c = cosines;\n"
      "}} else {{ {kernel}(x, s, c); }}\n"
      "{results}\n}}\n",
      fmt::arg("inlined", inlined), fmt::arg("count", count), fmt::arg("real", real),
      fmt::arg("types", types), fmt::arg("parameters", fmt::join(parameters, ", ")),
      fmt::arg("bytes", (is_float ? 4 : 8) * lanes), fmt::arg("angles", fmt::join(angles, ", ")),
      fmt::arg("above", fmt::join(above, " | ")), fmt::arg("sign", is_float ? 31 : 63),
      fmt::arg("kernel", kernel), fmt::arg("results", fmt::join(results, " ")));
}

}  // namespace

std::vector<std::string> own_sine_blocks() {
  constexpr const char* kVectors = "(defined(__SSE2__) || defined(__aarch64__))";
  std::vector<std::string> texts = {where(kVectors, kByLane), where("defined(__SSE2__)", kFloatKernel)};
  for (const int count : {2, 3, 4})
    for (const char* inlined : {"always_inline", "noinline"}) {
      texts.push_back(where(kVectors, block(false, count, inlined)));
      texts.push_back(
          where(count == 2 ? "defined(__AVX2__)" : "defined(__SSE2__)", block(true, count, inlined)));
    }
  return texts;
}

}  // namespace jourdain::readback
