// Sines of packs of which one lane is out of range, or no number: by the C library there, in all others as without it.
#include <jourdain/pack.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>

namespace {

template <class Real>
bool same(Real a, Real b) {
  return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b));
}

template <class Real, std::size_t lanes>
int wrong() {
  const Real beyond = static_cast<Real>(1.5e9), none = std::numeric_limits<Real>::infinity();
  jourdain::Pack<Real, lanes> usual;
  for (std::size_t k = 0; k < lanes; ++k) usual.set(k, static_cast<Real>(0.3 + 1.1 * static_cast<double>(k)));
  jourdain::Pack<Real, lanes> s, c, usual_s, usual_c;
  sine_cosine(usual, usual_s, usual_c);
  int count = 0;
  for (const Real x : {beyond, -beyond, none, -none, none - none, static_cast<Real>(1073741824)})
    for (std::size_t one = 0; one < lanes; ++one) {
      jourdain::Pack<Real, lanes> angles = usual;
      angles.set(one, x);
      sine_cosine(angles, s, c);
      for (std::size_t k = 0; k < lanes; ++k) {
        if (k != one) {
          count += !same(s[k], usual_s[k]) || !same(c[k], usual_c[k]);
        } else if (std::fabs(x) <= 1073741824) {
          count += !(std::fabs(static_cast<double>(s[k]) - std::sin(static_cast<double>(x))) < 1e-7);
          count += !(std::fabs(static_cast<double>(c[k]) - std::cos(static_cast<double>(x))) < 1e-7);
        } else {
          count += !same(s[k], static_cast<Real>(std::sin(static_cast<double>(x))));
          count += !same(c[k], static_cast<Real>(std::cos(static_cast<double>(x))));
        }
      }
    }
  return count;
}

}  // namespace

int main() {
  std::printf("%d %d %d %d %d %d %d\n", wrong<double, 2>(), wrong<double, 4>(), wrong<double, 8>(),
              wrong<double, 16>(), wrong<float, 4>(), wrong<float, 8>(), wrong<float, 16>());
}
