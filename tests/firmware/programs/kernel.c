/* Sine, cosine and arctangent of plain additions, products and quotients in a fixed order, so that every processor whose
   arithmetic is that of IEEE 754 gets the same bits. For the tests alone: arguments of a few turns, no infinities. They
   come before those of libm where they are linked. */
#include <math.h>

#define KERNEL(REAL, NAME)                                                                         \
  /* Of |x| <= pi/4, by Taylor's series. */                                                        \
  static REAL NAME##_near_sine(REAL x) {                                                           \
    const REAL q = x * x;                                                                          \
    REAL sum = 0;                                                                                  \
    int n;                                                                                         \
    for (n = 17; n > 1; n -= 2) sum = (1 - sum) * q / (REAL)(n * (n - 1));                         \
    return x - x * sum;                                                                            \
  }                                                                                                \
  static REAL NAME##_near_cosine(REAL x) {                                                         \
    const REAL q = x * x;                                                                          \
    REAL sum = 0;                                                                                  \
    int n;                                                                                         \
    for (n = 16; n > 0; n -= 2) sum = (1 - sum) * q / (REAL)(n * (n - 1));                         \
    return 1 - sum;                                                                                \
  }                                                                                                \
  /* sin(x + quarters pi/2) */                                                                     \
  static REAL NAME##_turned_sine(REAL x, int quarters) {                                           \
    const int k = (int)(x * (REAL)0.6366197723675814 + (x < 0 ? (REAL)-0.5 : (REAL)0.5));          \
    const REAL near = x - (REAL)k * (REAL)1.5703125 - (REAL)k * (REAL)4.8382679489661923e-4;       \
    const int turn = (k + quarters) & 3;                                                           \
    const REAL size = turn & 1 ? NAME##_near_cosine(near) : NAME##_near_sine(near);                \
    return turn & 2 ? -size : size;                                                                \
  }                                                                                                \
  /* Of 0 <= x <= 1: three times half the angle, then the series. */                               \
  static REAL NAME##_near_arctangent(REAL x) {                                                     \
    REAL q, sum = 0;                                                                               \
    int i, n;                                                                                      \
    for (i = 0; i < 3; ++i) x = x / (1 + NAME##_root(1 + x * x));                                  \
    q = x * x;                                                                                     \
    for (n = 21; n > 0; n -= 2) sum = 1 / (REAL)n - q * sum;                                       \
    return 8 * x * sum;                                                                            \
  }                                                                                                \
  static REAL NAME##_arctangent(REAL y, REAL x) {                                                  \
    const REAL right = (REAL)1.5707963267948966;                                                   \
    const REAL a = x < 0 ? -x : x, b = y < 0 ? -y : y;                                             \
    REAL angle = a == 0 && b == 0 ? 0                                                              \
                 : b <= a         ? NAME##_near_arctangent(b / a)                                  \
                                  : right - NAME##_near_arctangent(a / b);                         \
    if (x < 0) angle = 2 * right - angle;                                                          \
    return y < 0 ? -angle : angle;                                                                 \
  }

#define double_root(x) sqrt(x)
#define float_root(x) sqrtf(x)
KERNEL(double, double)
KERNEL(float, float)

double sin(double x) { return double_turned_sine(x, 0); }
double cos(double x) { return double_turned_sine(x, 1); }
double atan2(double y, double x) { return double_arctangent(y, x); }
float sinf(float x) { return float_turned_sine(x, 0); }
float cosf(float x) { return float_turned_sine(x, 1); }
float atan2f(float y, float x) { return float_arctangent(y, x); }
