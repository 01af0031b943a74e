/* Lets a Panda arm fall for a second and drives Andrews' squeezing mechanism for 30 ms; prints where they end. */
#include <stdio.h>

#include "panda.h"
#include "squeezer.h"

static void print(const char* name, const double* y, int count) {
  int i;
  printf("%s", name);
  for (i = 0; i < count; ++i) printf(" %.17g", y[i]);
  printf("\n");
}

static void fall(void) {
  panda_parameters parameters;
  panda_model arm;
  panda_state state;
  const panda_input nothing = {{0}};
  int i;
  panda_default_parameters(&parameters);
  panda_set_model(&arm, &parameters);
  state = panda_initial_state(&arm);
  for (i = 0; i < 1000; ++i) panda_rk4_step(&arm, &state, &nothing, 1e-3);
  print("panda", state.y, panda_position_count);
}

static void drive(void) {
  squeezer_parameters parameters;
  squeezer_model mechanism;
  squeezer_state state;
  const squeezer_input nothing = {0};
  int i;
  squeezer_default_parameters(&parameters);
  squeezer_set_model(&mechanism, &parameters);
  state = squeezer_initial_state(&mechanism);
  for (i = 0; i < 3000; ++i) squeezer_rk4_step(&mechanism, &state, &nothing, 1e-5);
  print("squeezer", state.y, squeezer_position_count);
}

int main(void) {
  fall();
  drive();
  return 0;
}
