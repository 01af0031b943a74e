#include "readback/known_text.hpp"

#include <utility>

namespace jourdain::readback {

namespace {

constexpr const char* kTime = R"(template <class Real = double>
struct Time {
  Real high, low, rest;

  JOURDAIN_FUNCTION Time() noexcept : high(Real(0.0)), low(Real(0.0)), rest(Real(0.0)) {}
  JOURDAIN_FUNCTION Time(const Real& t) noexcept : high(t), low(Real(0.0)), rest(Real(0.0)) {}
  JOURDAIN_FUNCTION Time(const Real& t, const Real& more) noexcept : high(t), low(more), rest(Real(0.0)) {}
  JOURDAIN_FUNCTION operator Real() const noexcept { return high; }
};

template <class Real> JOURDAIN_FUNCTION
Time<Real> operator+(const Time<Real>& t, const Real& h) noexcept {
  Time<Real> later;
  const Real step = h + t.rest;
  const Real low = t.low + step;
  later.rest = step - (low - t.low);
  later.high = t.high + low;
  later.low = low - (later.high - t.high);
  return later;
}

template <class Real> JOURDAIN_FUNCTION
Time<Real>& operator+=(Time<Real>& t, const Real& h) noexcept {
  t = t + h;
  return t;
}
)";

constexpr const char* kAngle =
    R"(template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real& a, const Real& b, const Real& product, const Real& scale) noexcept {
  const Real more = a * scale, much = b * scale, a1 = (more + a) - more, b1 = (much + b) - much, a0 = a - a1, b0 = b - b1;
  return ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0;
}
JOURDAIN_FUNCTION inline double product_error(double a, double b, double product) noexcept {
  return product_error<double>(a, b, product, 134217728);
}
JOURDAIN_FUNCTION inline float product_error(float a, float b, float product) noexcept { return product_error<float>(a, b, product, 4096); }
template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real&, const Real&, const Real&) noexcept { return Real(0.0); }
template <class Real>
struct Angle {
  Real high, low;

  JOURDAIN_FUNCTION Angle(const Real& value) noexcept : high(value), low(Real(0.0)) {}
  JOURDAIN_FUNCTION Angle(const Time<Real>& t) noexcept : high(t.high), low(t.low) {}
  JOURDAIN_FUNCTION Angle(const Real& a, const Real& b) noexcept : high(a + b), low(Real(0.0)) {
    const Real part = high - a;
    low = (a - (high - part)) + (b - part);
  }
  JOURDAIN_FUNCTION explicit operator Real() const noexcept { return high; }

  JOURDAIN_FUNCTION friend Angle operator-(const Angle& a) noexcept { return Angle(-a.high, -a.low); }
  JOURDAIN_FUNCTION friend Angle operator+(const Angle& a, const Angle& b) noexcept {
    const Angle sum(a.high, b.high);
    return Angle(sum.high, sum.low + (a.low + b.low));
  }
  JOURDAIN_FUNCTION friend Angle operator-(const Angle& a, const Angle& b) noexcept { return a + -b; }
  JOURDAIN_FUNCTION friend Angle operator*(const Angle& a, const Angle& b) noexcept {
    const Real product = a.high * b.high;
    return Angle(product, product_error(a.high, b.high, product) + (a.high * b.low + a.low * b.high));
  }
  JOURDAIN_FUNCTION friend Angle operator/(const Angle& a, const Angle& b) noexcept {
    const Real quotient = a.high / b.high, product = quotient * b.high;
    const Real rest = (a.high - product) - product_error(quotient, b.high, product);
    return Angle(quotient, (rest + (a.low - quotient * b.low)) / b.high);
  }
};

template <class Real> JOURDAIN_FUNCTION
void sine_cosine(const Angle<Real>& x, Real& s, Real& c) noexcept {
  Real s0, c0, s1, c1;
  sine_cosine(x.high, s0, c0);
  sine_cosine(x.low, s1, c1);
  s = s0 * c1 + c0 * s1;
  c = c0 * c1 - s0 * s1;
}
template <class Real> JOURDAIN_FUNCTION
Real sine(const Angle<Real>& x) noexcept {
  Real s, c;
  sine_cosine(x, s, c);
  return s;
}
template <class Real> JOURDAIN_FUNCTION
Real cosine(const Angle<Real>& x) noexcept {
  Real s, c;
  sine_cosine(x, s, c);
  return c;
}
)";

// Of packs: numbers, sines and cosines that a pack may bring itself.
constexpr const char* kNumbers = R"(namespace detail {

namespace hooks {

struct Plain {};
struct Lanes : Plain {};
struct Value : Lanes {};
struct Conversion : Value {};
struct Own : Conversion {};

template <class Real> JOURDAIN_FUNCTION
auto number(double x, Own) noexcept -> decltype(Real(from_literal(static_cast<const Real*>(nullptr), x))) {
  return from_literal(static_cast<const Real*>(nullptr), x);
}
template <class Real> JOURDAIN_FUNCTION
auto number(double x, Conversion, int Real::* = nullptr) noexcept -> decltype(Real(x)) { return Real(x); }
template <class Real> JOURDAIN_FUNCTION
auto number(double x, Value) noexcept -> decltype(Real(static_cast<typename Real::value_type>(x))) {
  return Real(static_cast<typename Real::value_type>(x));
}
template <class Real> JOURDAIN_FUNCTION
auto number(double x, Lanes) noexcept -> decltype(void((*static_cast<Real*>(nullptr))[0]), Real{}) {
  Real lanes{};
  auto lane = lanes[0];
  lane = static_cast<decltype(lane)>(x);
  for (unsigned i = 0; i < sizeof(lanes) / sizeof(lane); ++i) lanes[i] = lane;
  return lanes;
}
template <class Real> JOURDAIN_FUNCTION
Real number(double x, Plain) noexcept { return Real(x); }

template <class Real> JOURDAIN_FUNCTION
auto both(const Real& x, Real& s, Real& c, int) noexcept -> decltype(void(sine_cosine(x, s, c))) {
  sine_cosine(x, s, c);
}

}

template <class Real> JOURDAIN_FUNCTION
Real number(double x) noexcept { return hooks::number<Real>(x, hooks::Own()); }
template <class Real> JOURDAIN_FUNCTION
Real number(int k) noexcept { return hooks::number<Real>(static_cast<double>(k), hooks::Own()); }

}
)";

constexpr const char* kNumberOfTime = R"(namespace detail {

template <class Real> JOURDAIN_FUNCTION
Real number(const Time<Real>& t) noexcept { return t.high; }

}
)";

constexpr const char* kNumberOfAngle = R"(template <class Real> JOURDAIN_FUNCTION
Real number(const Angle<Real>& angle) noexcept { return angle.high; }
)";

constexpr const char* kPackSines = R"(namespace hooks {

template <class Real> JOURDAIN_FUNCTION
void both(const Real& x, Real& s, Real& c, long) noexcept {
  s = sine(x);
  c = cosine(x);
}

}

template <class Real> JOURDAIN_FUNCTION
void sine_cosine(const Real& x, Real& s, Real& c) noexcept { hooks::both(x, s, c, 0); }
)";

/// What the last one computes where a pack brings nothing; one that does has to compute the same.
constexpr const char* kSines = R"(template <class Real> JOURDAIN_FUNCTION
void sine_cosine(const Real& x, Real& s, Real& c) noexcept {
  s = sine(x);
  c = cosine(x);
}
)";

// The double's own sine and cosine; what they compute is compared with 113 bits in tests/embed.
constexpr const char* kOwnSines =
    R"(#if defined(__FAST_MATH__) || defined(_M_FP_FAST) || __FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2
#error "emitted with --own-sines: sums have to be rounded as they are written, without -ffast-math or x87"
#endif
template <class V, class I> JOURDAIN_FUNCTION
#if defined(__GNUC__)
__attribute__((always_inline))
#endif
inline void turn(const V& x, V& s, V& c) noexcept {
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
                y * ((-0.00019841269829453883 + z * 2.7557313580182605e-06) + y * (-2.505074193536228e-08 + z * 1.589591844424868e-10));
  const V even = (0.0416666666666666 + z * -0.0013888888888874474) +
                 y * ((2.4801587289670344e-05 + z * -2.755731440021842e-07) + y * (2.0875729102264816e-09 + z * -1.1359921420814053e-11));
  const I sine_bits = __builtin_bit_cast(I, h + (h * z * odd + l * w));
  const I cosine_bits = __builtin_bit_cast(I, w + (((1.0 - w) - half) + (y * even - h * l)));
  const I exchange = (sine_bits ^ cosine_bits) & (zero - (n & one));
  s = __builtin_bit_cast(V, sine_bits ^ exchange ^ sign ^ ((n << 62) & (one << 63)));
  c = __builtin_bit_cast(V, cosine_bits ^ exchange ^ (((n + one) << 62) & (one << 63)));
}
JOURDAIN_FUNCTION inline bool is_turned(double x) noexcept { return x <= 1073741824.0 && x >= -1073741824.0; }
JOURDAIN_FUNCTION inline void sine_cosine(const double& x, double& s, double& c) noexcept {
  if (is_turned(x)) {
    turn<double, unsigned long long>(x, s, c);
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
JOURDAIN_FUNCTION inline void sine_cosine2(const double& x0, double& s0, double& c0, const double& x1, double& s1, double& c1) noexcept {
#if defined(__GNUC__) && !defined(__CUDA__) && !defined(__CUDACC__) && (defined(__SSE2__) || defined(__aarch64__))
  if (is_turned(x0) && is_turned(x1)) {
    typedef double Lanes __attribute__((vector_size(16)));
    typedef unsigned long long Bits __attribute__((vector_size(16)));
    Lanes s, c;
    turn<Lanes, Bits>(Lanes{x0, x1}, s, c);
    s0 = s[0];
    c0 = c[0];
    s1 = s[1];
    c1 = c[1];
    return;
  }
#endif
  sine_cosine(x0, s0, c0);
  sine_cosine(x1, s1, c1);
}
JOURDAIN_FUNCTION inline void sine_cosine4(const double& x0, double& s0, double& c0, const double& x1, double& s1, double& c1,
                                           const double& x2, double& s2, double& c2, const double& x3, double& s3, double& c3) noexcept {
#if defined(__GNUC__) && !defined(__CUDA__) && !defined(__CUDACC__) && (defined(__SSE2__) || defined(__aarch64__))
  if (is_turned(x0) && is_turned(x1) && is_turned(x2) && is_turned(x3)) {
    typedef double Lanes __attribute__((vector_size(32)));
    typedef unsigned long long Bits __attribute__((vector_size(32)));
    Lanes s, c;
    turn<Lanes, Bits>(Lanes{x0, x1, x2, x3}, s, c);
    s0 = s[0];
    c0 = c[0];
    s1 = s[1];
    c1 = c[1];
    s2 = s[2];
    c2 = c[2];
    s3 = s[3];
    c3 = c[3];
    return;
  }
#endif
  sine_cosine(x0, s0, c0);
  sine_cosine(x1, s1, c1);
  sine_cosine(x2, s2, c2);
  sine_cosine(x3, s3, c3);
}
)";

constexpr const char* kLibrarySines =
    R"(JOURDAIN_FUNCTION inline double sine(double x) noexcept { return ::sin(x); }
JOURDAIN_FUNCTION inline double cosine(double x) noexcept { return ::cos(x); }
)";

/// The text with its conversions written for packs.
std::string for_packs(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool converts = text.compare(i, 5, "Real(") == 0 && !result.ends_with("operator ");
    result += converts ? "detail::number<Real>(" : text.substr(i, 1);
    if (converts) i += 4;
  }
  return result;
}

KnownText known(const char* scope, const char* type, const std::string& text, const char* meaning = nullptr) {
  KnownText made;
  made.scope = scope;
  made.type = type;
  made.text = std::make_unique<std::string>(text);
  made.tokens = tokenize(type, *made.text);
  if (meaning) made.meaning = tokenize(type, meaning);
  return made;
}

}  // namespace

const std::vector<KnownText>& known_texts(bool packs) {
  static const std::vector<KnownText> plain = [] {
    std::vector<KnownText> list;
    list.push_back(known("", "Time", kTime));
    list.push_back(known("detail", "Angle", kAngle));
    list.push_back(known("detail", "", kOwnSines, kLibrarySines));
    return list;
  }();
  static const std::vector<KnownText> of_packs = [] {
    std::vector<KnownText> list;
    list.push_back(known("", "Time", for_packs(kTime)));
    list.push_back(known("detail", "Angle", for_packs(kAngle)));
    list.push_back(known("detail", "", kOwnSines, kLibrarySines));
    list.push_back(known("", "", kNumbers));
    list.push_back(known("", "", kNumberOfTime));
    list.push_back(known("detail", "", kNumberOfAngle));
    list.push_back(known("detail", "", kPackSines, kSines));
    return list;
  }();
  return packs ? of_packs : plain;
}

}  // namespace jourdain::readback
