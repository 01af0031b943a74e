/* What motion.cpp does, with the model's C text. PREFIX of its names, REAL, STEP (s), HEADER, INPUTS and CLOCK, where states
   have a time, and OUTPUTS, where there are any, are defined by who compiles it. */
#include HEADER

#include <stdint.h>
#include <string.h>

#include "board.h"

#define JOINED(a, b) a##_##b
#define NAMED(a, b) JOINED(a, b)
#define M(name) NAMED(PREFIX, name)

static const int steps = 200, reported = 20;

/* A line: what it is, then the bits of `count` numbers. */
static void write_all(const char *what, const REAL *numbers, size_t count) {
  size_t i;
  board_write(what);
  for (i = 0; i < count; ++i) {
    char text[20], *end = text + sizeof text;
    uint64_t bits = 0;
    unsigned digit;
    memcpy(&bits, &numbers[i], sizeof(REAL));
    *--end = '\0';
    for (digit = 0; digit < 2 * sizeof(REAL); ++digit, bits >>= 4) *--end = "0123456789abcdef"[bits & 15];
    *--end = ' ';
    board_write(end);
  }
  board_write("\n");
}

static void report(const M(model) * model, const M(state) * state, const M(input) * input) {
  REAL zdot[M(velocity_count)], energy;
#ifdef OUTPUTS
  M(output_values) values;
  REAL numbers[sizeof values / sizeof(REAL)];
#endif
  M(forward_dynamics)(model, state, input, zdot);
#ifdef CLOCK
  write_all("t", &state->t.high, 3);
#endif
  write_all("y", state->y, M(position_count));
  write_all("z", state->z, M(velocity_count));
  write_all("forward_dynamics", zdot, M(velocity_count));
  energy = M(kinetic_energy)(model, state);
  write_all("kinetic_energy", &energy, 1);
  energy = M(potential_energy)(model, state);
  write_all("potential_energy", &energy, 1);
#ifdef OUTPUTS
  memset(&values, 0, sizeof values);
  M(outputs)(model, state, input, &values);
  memcpy(numbers, &values, sizeof values);
  write_all("outputs", numbers, sizeof values / sizeof(REAL));
#endif
}

int main(void) {
  M(parameters) parameters;
  M(model) model;
  M(state) state;
  M(input) input;
  int i;
  M(default_parameters)(&parameters);
  M(set_model)(&model, &parameters);
  state = M(initial_state)(&model);
  memset(&input, 0, sizeof input);
#ifdef INPUTS
  {
    REAL value = (REAL)0.25;
    for (i = 0; i < M(input_count); ++i) {
      input.u[i] = value;
      value = -(value + (REAL)0.125);
    }
  }
#endif
  report(&model, &state, &input);
  for (i = 1; i <= steps; ++i) {
    M(rk4_step)(&model, &state, &input, (REAL)STEP);
    if (i % reported == 0) report(&model, &state, &input);
  }
  return 0;
}
