/* Calls an FMU of FMI 2.0, linked in, in any order with any arguments that a caller could hand over: nulls, references that
 * are not there, numbers that are none. Every call has to answer, and an error with a line. Arguments: GUID, calls, seed. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2.h"

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

static void log_line(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                     fmi2String message, ...) {
  (void)environment;
  (void)name;
  (void)category;
  (void)message;
  if (status >= fmi2Discard) ++lines;
}

static void check(fmi2Component c, long before, fmi2Status status, unsigned which) {
  ++calls;
  if (status == fmi2OK) return;
  ++errors;
  if (status <= fmi2Error && status != fmi2Warning && (!c || lines == before + 1)) return;
  printf("call %u answers %d with %ld lines\n", which, (int)status, lines - before);
  exit(1);
}

static fmi2Status call(fmi2Component c, unsigned which, fmi2FMUstate *state, char *bytes, size_t room) {
  fmi2ValueReference list[MOST], known[MOST];
  double numbers[MOST], results[32] = {0};
  size_t k, count = draw(MOST), size = 0;
  fmi2EventInfo info;
  int flag, other;
  const fmi2ValueReference *const references = draw(20) ? list : NULL;
  double *const values = draw(20) ? numbers : NULL;

  for (k = 0; k < MOST; ++k) {
    list[k] = draw(60);
    known[k] = draw(30);
    numbers[k] = draw_number();
  }
  switch (which) {
    case 0:
      return fmi2SetupExperiment(c, 0, 0.0, draw(3) ? 0.0 : numbers[0], draw(5) == 0, numbers[1]);
    case 1:
      return fmi2EnterInitializationMode(c);
    case 2:
      return fmi2ExitInitializationMode(c);
    case 3:
      return draw(10) ? fmi2OK : fmi2Terminate(c);
    case 4:
      return draw(4) ? fmi2OK : fmi2Reset(c);
    case 5:
      return fmi2GetReal(c, references, count, values);
    case 6:
      return fmi2SetReal(c, references, count, values);
    case 7:
      return fmi2GetFMUstate(c, draw(20) ? state : NULL);
    case 8:
      return fmi2SetFMUstate(c, *state);
    case 9:
      return fmi2SerializedFMUstateSize(c, *state, &size);
    case 10:
      if (draw(2)) bytes[draw((unsigned)room)] ^= 1;
      return fmi2SerializeFMUstate(c, *state, bytes, draw(2) ? room : draw((unsigned)room));
    case 11:
      return fmi2DeSerializeFMUstate(c, bytes, room, state);
    case 12:
      return fmi2GetDirectionalDerivative(c, references, count, known, draw(MOST), values, draw(9) ? results : NULL);
    case 13:
      return fmi2EnterEventMode(c);
    case 14:
      return fmi2NewDiscreteStates(c, draw(20) ? &info : NULL);
    case 15:
      return fmi2EnterContinuousTimeMode(c);
    case 16:
      return fmi2CompletedIntegratorStep(c, 1, draw(20) ? &flag : NULL, &other);
    case 17:
      return fmi2SetTime(c, numbers[0]);
    case 18:
      return fmi2GetContinuousStates(c, results, draw(2) ? 4 : 13);
    case 19:
      for (k = 0; k < 32; ++k) results[k] = draw(200) ? 0.1 : draw_number();
      return fmi2SetContinuousStates(c, results, draw(2) ? 4 : 13);
    case 20:
      return fmi2GetDerivatives(c, results, draw(2) ? 4 : 13);
    case 21:
      return fmi2GetNominalsOfContinuousStates(c, results, draw(2) ? 4 : 13);
    case 22:
      return fmi2GetRealStatus(c, draw(2) ? fmi2LastSuccessfulTime : fmi2Terminated, values);
    case 23:
      return fmi2GetEventIndicators(c, results, draw(2));
    case 24:
      return fmi2SetDebugLogging(c, 1, draw(2), NULL);
    default:
      if (fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &numbers[0]) == fmi2OK)
        return fmi2DoStep(c, numbers[0], numbers[1] / 100, 1);
      --lines;
      return fmi2DoStep(c, numbers[0], numbers[1], 1);
  }
}

int main(int argc, char **argv) {
  const fmi2CallbackFunctions callbacks = {log_line, NULL, NULL, NULL, NULL};
  const long count = argc > 3 ? strtol(argv[2], NULL, 10) : 0;
  fmi2Component one[2];
  fmi2FMUstate state[2] = {NULL, NULL};
  size_t room = 0;
  char *bytes;
  long k;

  if (count == 0) return 2;
  seed = strtoull(argv[3], NULL, 10);
  one[0] = fmi2Instantiate("exchange", fmi2ModelExchange, argv[1], NULL, &callbacks, 0, 1);
  one[1] = fmi2Instantiate("step", fmi2CoSimulation, argv[1], NULL, &callbacks, 0, 1);
  if (!one[0] || !one[1] || fmi2GetFMUstate(one[1], &state[1]) != fmi2OK) return 3;
  if (fmi2SerializedFMUstateSize(one[1], state[1], &room) != fmi2OK) return 4;
  bytes = (char *)malloc(room);
  if (!bytes || fmi2SerializeFMUstate(one[1], state[1], bytes, room) != fmi2OK) return 5;
  for (k = 0; k < count; ++k) {
    const unsigned which = draw(28), i = draw(2);
    const long before = lines;
    const fmi2Component c = draw(100) ? one[i] : NULL;

    check(c, before, call(c, which, &state[i], bytes, room), which);
  }
  for (k = 0; k < 2; ++k) {
    fmi2FreeFMUstate(one[k], &state[k]);
    fmi2FreeInstance(one[k]);
  }
  free(bytes);
  printf("%ld calls, %ld errors\n", calls, errors);
  return 0;
}
