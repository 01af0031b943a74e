#include "readback/known_text.hpp"

#include <utility>

#include "readback/function_texts.hpp"
#include "readback/lanes_text.hpp"
#include "readback/own_sine_blocks.hpp"
#include "readback/own_sines.hpp"

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

constexpr const char* kProductError =
    R"(template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real& a, const Real& b, const Real& product, const Real& scale) noexcept {
  const Real more = a * scale, much = b * scale, a1 = (more + a) - more, b1 = (much + b) - much, a0 = a - a1, b0 = b - b1;
  return ((a1 * b1 - product) + a1 * b0 + a0 * b1) + a0 * b0;
}
JOURDAIN_FUNCTION inline double product_error(double a, double b, double product) noexcept {
  return product_error<double>(a, b, product, 134217728);
}
JOURDAIN_FUNCTION inline float product_error(float a, float b, float product) noexcept { return product_error<float>(a, b, product, 4096); }
)";

constexpr const char* kWideProductError = R"(template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real&, const Real&, const Real&) noexcept { return Real(0.0); }
)";

// Of packs: split as their lanes have to be.
constexpr const char* kPacksProductError = R"(namespace hooks {

JOURDAIN_FUNCTION inline double splitting(double) noexcept { return 134217728; }
JOURDAIN_FUNCTION inline double splitting(float) noexcept { return 4096; }

template <class Real> JOURDAIN_FUNCTION
auto product_error(const Real& a, const Real& b, const Real& product, int) noexcept
    -> decltype(void(splitting(a[0])), Real{}) {
  return detail::product_error(a, b, product, detail::number<Real>(splitting(a[0])));
}
template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real&, const Real&, const Real&, long) noexcept { return detail::number<Real>(0.0); }

}  // namespace hooks

template <class Real> JOURDAIN_FUNCTION
Real product_error(const Real& a, const Real& b, const Real& product) noexcept {
  return hooks::product_error(a, b, product, 0);
}
)";

constexpr const char* kAngle = R"(template <class Real>
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

constexpr const char* kNearby =
    R"(#if defined(__GNUC__) && defined(__x86_64__) && !defined(__INTEL_COMPILER) && !defined(__CUDA__) && !defined(__CUDACC__)
#define JOURDAIN_NEARBY
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#undef JOURDAIN_NEARBY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(undefined_behavior_sanitizer)
#undef JOURDAIN_NEARBY
#endif
#endif
template <class Window> JOURDAIN_FUNCTION
inline Window& nearby(Window& window) noexcept {
#if defined(JOURDAIN_NEARBY)
  if (sizeof(Window) <= 256) {
    char* middle = reinterpret_cast<char*>(&window) + 128;
    __asm__("" : "+r"(middle));
    return *reinterpret_cast<Window*>(middle - 128);
  }
#endif
  return window;
}
#undef JOURDAIN_NEARBY
)";

/// What that returns.
constexpr const char* kWindow = R"(template <class Window> JOURDAIN_FUNCTION
inline Window& nearby(Window& window) noexcept { return window; }
)";

constexpr const char* kInlined = R"(#if !defined(JOURDAIN_INLINED)
#if defined(__GNUC__) && defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && !defined(__NO_INLINE__) && (defined(__x86_64__) || defined(__aarch64__))
#define JOURDAIN_INLINED inline __attribute__((always_inline))
#else
#define JOURDAIN_INLINED
#endif
#endif
#if !defined(JOURDAIN_STAGES)
#define JOURDAIN_STAGES
#endif
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

void add_choosing_texts(std::vector<KnownText>& list, bool packs) {
  list.push_back(known("detail", "", choice()));
  list.push_back(known("detail", "", packs ? for_packs(entries()) : entries()));
  for (const ChoosingText& text : choosing_texts())
    list.push_back(known("detail", "", packs ? for_packs(text.cpp) : text.cpp, text.cpp_meaning.c_str()));
}

KnownText sines() {
  KnownText made = known("detail", "", own_sines(), library_sines());
  made.is_own_sines = true;
  return made;
}

}  // namespace

const std::vector<KnownText>& known_texts(bool packs) {
  static const std::vector<KnownText> plain = [] {
    std::vector<KnownText> list;
    list.push_back(known("", "Time", kTime));
    list.push_back(known("detail", "Angle", std::string(kProductError) + kWideProductError + kAngle));
    list.push_back(sines());
    for (const std::string& text : own_sine_blocks()) list.push_back(known("detail", "", text));
    list.push_back(known("detail", "", own_arctangent(), library_arctangent()));
    list.push_back(known("detail", kLanesType, lanes_text()));
    list.push_back(known("detail", "", kNearby, kWindow));
    list.push_back(known("detail", "", kInlined));
    add_choosing_texts(list, false);
    return list;
  }();
  static const std::vector<KnownText> of_packs = [] {
    std::vector<KnownText> list;
    list.push_back(known("", "Time", for_packs(kTime)));
    list.push_back(
        known("detail", "Angle", for_packs(kProductError) + kPacksProductError + for_packs(kAngle)));
    list.push_back(sines());
    for (const std::string& text : own_sine_blocks()) list.push_back(known("detail", "", text));
    list.push_back(known("detail", "", own_arctangent(), library_arctangent()));
    list.push_back(known("detail", kLanesType, lanes_text()));
    list.push_back(known("detail", "", kNearby, kWindow));
    list.push_back(known("detail", "", kInlined));
    list.push_back(known("", "", kNumbers));
    list.push_back(known("", "", kNumberOfTime));
    list.push_back(known("detail", "", kNumberOfAngle));
    list.push_back(known("detail", "", kPackSines, kSines));
    add_choosing_texts(list, true);
    return list;
  }();
  return packs ? of_packs : plain;
}

}  // namespace jourdain::readback
