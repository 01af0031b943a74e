/* Calls an FMU of FMI 3.0, linked in, in any order with any arguments that a caller could hand over: nulls, references that
 * are not there, numbers that are none. Every call has to answer, and an error with a line. Arguments: token, calls, seed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3.h"

enum { MOST = 6 };

static unsigned long long seed;
static long lines, errors, calls;

static unsigned draw(unsigned count) {
  seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (unsigned)(seed >> 33) % count;
}

static double draw_number(void) {
  switch (draw(12)) {
    case 0:
      return NAN;
    case 1:
      return INFINITY;
    case 2:
      return 1e300;
    default:
      return draw(1000) / 500.0 - 1.0;
  }
}

static void log_line(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                     fmi3String message) {
  (void)environment;
  (void)category;
  (void)message;
  if (status >= fmi3Discard) ++lines;
}

static void check(fmi3Instance c, long before, fmi3Status status, unsigned which) {
  ++calls;
  if (status == fmi3OK) return;
  ++errors;
  if (status <= fmi3Error && status != fmi3Warning && (!c || lines == before + 1)) return;
  printf("call %u answers %d with %ld lines\n", which, (int)status, lines - before);
  exit(1);
}

static double now;

static fmi3Status call(fmi3Instance c, unsigned which, fmi3FMUState *state, fmi3Byte *bytes, size_t room) {
  fmi3ValueReference list[MOST], known[MOST];
  double numbers[MOST], results[32] = {0}, next;
  size_t k, count = draw(MOST), size = 0;
  bool flags[5];
  const fmi3ValueReference *const references = draw(20) ? list : NULL;
  double *const values = draw(20) ? numbers : NULL;
  const size_t value_count = draw(20) ? count : draw(MOST), known_count = draw(MOST);
  int32_t integers[MOST];

  for (k = 0; k < MOST; ++k) {
    list[k] = draw(60);
    known[k] = draw(30);
    numbers[k] = draw_number();
  }
  switch (which) {
    case 0:
    case 1:
      now = draw(3) ? 0.0 : numbers[0];
      return fmi3EnterInitializationMode(c, false, 0.0, now, draw(5) == 0, numbers[1]);
    case 2:
      return fmi3ExitInitializationMode(c);
    case 3:
      return draw(10) ? fmi3OK : fmi3Terminate(c);
    case 4:
      return draw(4) ? fmi3OK : fmi3Reset(c);
    case 5:
      return fmi3GetFloat64(c, references, count, values, value_count);
    case 6:
      return fmi3SetFloat64(c, references, count, values, value_count);
    case 7:
      return fmi3GetFMUState(c, draw(20) ? state : NULL);
    case 8:
      return fmi3SetFMUState(c, *state);
    case 9:
      return fmi3SerializedFMUStateSize(c, *state, &size);
    case 10:
      if (draw(2)) bytes[draw((unsigned)room)] ^= 1;
      return fmi3SerializeFMUState(c, *state, bytes, draw(2) ? room : draw((unsigned)room));
    case 11:
      return fmi3DeserializeFMUState(c, bytes, room, state);
    case 12:
      return fmi3GetDirectionalDerivative(c, references, count, known, known_count, values, known_count,
                                          draw(9) ? results : NULL, count);
    case 13:
      return fmi3GetAdjointDerivative(c, references, count, known, known_count, values, count,
                                      draw(9) ? results : NULL, known_count);
    case 14:
      return fmi3EnterEventMode(c);
    case 15:
      return fmi3UpdateDiscreteStates(c, &flags[0], &flags[1], &flags[2], draw(20) ? &flags[3] : NULL, &flags[4],
                                      &next);
    case 16:
      return fmi3EnterContinuousTimeMode(c);
    case 17:
      return fmi3CompletedIntegratorStep(c, true, draw(20) ? &flags[0] : NULL, &flags[1]);
    case 18:
      return fmi3SetTime(c, numbers[0]);
    case 19:
      return fmi3GetContinuousStates(c, results, draw(2) ? 4 : 13);
    case 20:
      for (k = 0; k < 32; ++k) results[k] = draw(200) ? 0.1 : draw_number();
      return fmi3SetContinuousStates(c, results, draw(2) ? 4 : 13);
    case 21:
      return fmi3GetContinuousStateDerivatives(c, results, draw(2) ? 4 : 13);
    case 22:
      return fmi3GetNumberOfContinuousStates(c, draw(9) ? &size : NULL);
    case 23:
      return fmi3GetInt32(c, references, count, integers, count);
    case 24:
      return fmi3EnterStepMode(c);
    default: {
      const fmi3Status status =
          fmi3DoStep(c, now, numbers[1] / 100, true, &flags[0], &flags[1], &flags[2], draw(20) ? &next : NULL);

      if (status == fmi3OK) now = next;
      return status;
    }
  }
}

int main(int argc, char **argv) {
  const long count = argc > 3 ? strtol(argv[2], NULL, 10) : 0;
  fmi3Instance one[2];
  fmi3FMUState state[2] = {NULL, NULL};
  size_t room = 0;
  fmi3Byte *bytes;
  long k;

  if (count == 0) return 2;
  seed = strtoull(argv[3], NULL, 10);
  one[0] = fmi3InstantiateModelExchange("exchange", argv[1], NULL, false, true, NULL, log_line);
  one[1] =
      fmi3InstantiateCoSimulation("step", argv[1], NULL, false, true, false, false, NULL, 0, NULL, log_line, NULL);
  if (!one[0] || !one[1] || fmi3GetFMUState(one[1], &state[1]) != fmi3OK) return 3;
  if (fmi3SerializedFMUStateSize(one[1], state[1], &room) != fmi3OK) return 4;
  bytes = (fmi3Byte *)malloc(room);
  if (!bytes || fmi3SerializeFMUState(one[1], state[1], bytes, room) != fmi3OK) return 5;
  for (k = 0; k < count; ++k) {
    const unsigned which = draw(28), i = draw(2);
    const long before = lines;
    const fmi3Instance c = draw(100) ? one[i] : NULL;

    check(c, before, call(c, which, &state[i], bytes, room), which);
  }
  for (k = 0; k < 2; ++k) {
    fmi3FreeFMUState(one[k], &state[k]);
    fmi3FreeInstance(one[k]);
  }
  free(bytes);
  printf("%ld calls, %ld errors\n", calls, errors);
  return 0;
}
