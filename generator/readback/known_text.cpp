#include "readback/known_text.hpp"

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

}  // namespace

const std::array<KnownText, 2>& known_texts() {
  static const std::array<KnownText, 2> texts = {
      {{"", "Time", tokenize("Time", kTime)}, {"detail", "Angle", tokenize("Angle", kAngle)}}};
  return texts;
}

}  // namespace jourdain::readback
