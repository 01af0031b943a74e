/* Two models behind the C interface, one of them twice with different parameters, stepped by eight threads at once: each
   must end with the bits that one thread alone ends with. */
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "cart_pole_interface.h"
#include "double_pendulum_interface.h"

enum { kSteps = 500, kThreads = 8 };

typedef struct {
  int which;
  int failed;
  double end[4];
} run_record;

static void* run(void* argument) {
  run_record* record = (run_record*)argument;
  double_pendulum_instance pendulum;
  cart_pole_instance cart;
  const int even = record->which % 2 == 0;
  const jourdain_interface* table = even ? double_pendulum_interface() : cart_pole_interface();
  void* self = even ? table->create(&pendulum, sizeof pendulum) : table->create(&cart, sizeof cart);
  double t, parameters[16], input;

  record->failed = self == NULL || table->parameter_count > 16;
  if (record->failed) return NULL;
  if (even) {
    record->failed |= table->get_parameters(self, parameters) != JOURDAIN_OK;
    parameters[0] += 0.1 * record->which;
    record->failed |= table->set_parameters(self, parameters) != JOURDAIN_OK;
  } else {
    input = 0.1 * record->which;
    record->failed |= table->set_inputs(self, &input) != JOURDAIN_OK;
  }
  record->failed |= table->steppers[0].step(self, 1e-3, kSteps) != JOURDAIN_OK;
  record->failed |= table->get_state(self, &t, record->end, record->end + 2) != JOURDAIN_OK;
  return NULL;
}

int main(void) {
  pthread_t threads[kThreads];
  run_record together[kThreads], alone[kThreads];
  int k, different = 0;

  for (k = 0; k < kThreads; ++k) {
    together[k].which = k;
    alone[k].which = k;
    if (pthread_create(&threads[k], NULL, run, &together[k]) != 0) return 99;
  }
  for (k = 0; k < kThreads; ++k) pthread_join(threads[k], NULL);
  for (k = 0; k < kThreads; ++k) {
    run(&alone[k]);
    different += together[k].failed || alone[k].failed;
    different += memcmp(alone[k].end, together[k].end, sizeof alone[k].end) != 0;
    if (k > 1) different += memcmp(alone[k].end, alone[k - 2].end, sizeof alone[k].end) == 0;
  }
  printf("%d\n", different);
  return different;
}
