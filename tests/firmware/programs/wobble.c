/* The library's sine, cosine and arctangent, each result moved to the next number up or down: as good as those of a library
   with errors of one unit in the last place. Linked with --wrap. */
#include <math.h>
#include <string.h>

/* As good as random, the same for the same argument and PATTERN. */
static int goes_up(const void *number, size_t size) {
  unsigned char bytes[8] = {0};
  unsigned hash = PATTERN, i;
  memcpy(bytes, number, size);
  for (i = 0; i < 8; ++i) hash = (hash ^ bytes[i]) * 16777619u;
  return (int)(hash >> 16 & 1u);
}

#define WOBBLING(REAL, NAME, AFTER)                                 \
  REAL __real_##NAME(REAL x);                                       \
  REAL __wrap_##NAME(REAL x) {                                      \
    return AFTER(__real_##NAME(x), goes_up(&x, sizeof x) ? 2 : -2); \
  }
#define WOBBLING2(REAL, NAME, AFTER)                                   \
  REAL __real_##NAME(REAL y, REAL x);                                  \
  REAL __wrap_##NAME(REAL y, REAL x) {                                 \
    return AFTER(__real_##NAME(y, x), goes_up(&y, sizeof y) ? 4 : -4); \
  }

WOBBLING(double, sin, nextafter)
WOBBLING(double, cos, nextafter)
WOBBLING(float, sinf, nextafterf)
WOBBLING(float, cosf, nextafterf)
WOBBLING2(double, atan2, nextafter)
WOBBLING2(float, atan2f, nextafterf)
