// The pendulum of models/ in closed form.
#pragma once

#include <cmath>

namespace jourdain::tests {

/// Jacobi's sn, cn and dn by the arithmetic-geometric mean (Abramowitz and Stegun 16.4).
struct Jacobi {
  long double sn, cn, dn;
};

inline Jacobi jacobi(long double u, long double modulus) {
  constexpr int kLevels = 12;
  long double a[kLevels + 1], c[kLevels + 1];
  a[0] = 1;
  c[0] = modulus;
  long double b = std::sqrt(1 - modulus * modulus);
  for (int i = 0; i < kLevels; ++i) {
    a[i + 1] = (a[i] + b) / 2;
    c[i + 1] = (a[i] - b) / 2;
    b = std::sqrt(a[i] * b);
  }
  long double phi = std::ldexp(a[kLevels] * u, kLevels);
  for (int i = kLevels; i > 0; --i) phi = (phi + std::asin(c[i] * std::sin(phi) / a[i])) / 2;
  const long double sn = std::sin(phi);
  return {sn, std::cos(phi), std::sqrt(1 - modulus * modulus * sn * sn)};
}

/// Angle from the downward vertical of a pendulum released at rest at −90°: sin(θ/2) = −k cd(ω t), k = sin 45°.
inline long double exact_pendulum_angle(long double t) {
  const long double omega = std::sqrt(9.81L), k = std::sqrt(0.5L);
  const Jacobi j = jacobi(omega * t, k);
  return -2 * std::asin(k * j.cn / j.dn);
}

}  // namespace jourdain::tests
