/* SPDX-License-Identifier: MIT
 *
 * Many states of one model, stepped side by side in vectors and by several threads, for C and for programs that load
 * models that they do not know. jourdain/ensemble_interface.hpp makes the functions from an emitted model. Every number
 * passes as a double, states one after the other. An ensemble takes memory of its own and is for one thread at a time.
 * Where a call needs more and there is none it answers JOURDAIN_WRONG_CALL, and nothing was done. */
#ifndef JOURDAIN_ENSEMBLE_H
#define JOURDAIN_ENSEMBLE_H

#include <stddef.h>

#include "jourdain_interface.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Changes with the layout of what follows. */
#define JOURDAIN_ENSEMBLE_VERSION 1

/* Inputs of a run: before step i, counted from 0, of the state that is `k` in the ensemble, those that begin at
 * values[k * by_state + i * by_step]. */
typedef struct jourdain_inputs {
  const double* values;
  size_t by_state, by_step; /* 0: the same for all */
} jourdain_inputs;

typedef struct jourdain_ensemble {
  int version;    /* JOURDAIN_ENSEMBLE_VERSION */
  int real_bytes; /* of the numbers that the model computes with */
  int lanes;      /* states that are stepped at once */
  int position_count, velocity_count, input_count, parameter_count;
  int stepper_count;
  const char* const*
      steppers; /* "rk4_step", …: what the model was emitted with of euler, semi_implicit_euler, heun,
                                  rk4 and rk5 */

  /* `count` states as the description starts at these parameters (null: the default ones), inputs zero. Null where
   * there is no memory, count is 0 or a parameter is not finite as the model keeps it. */
  void* (*create)(size_t count, const double* parameters);
  void (*destroy)(void* ensemble); /* null: nothing is done */

  /* Of states `first` to `first + count - 1`. A state that is set is trusted again. `t` where states hold no time: 0 or
   * not looked at; it may be null then. */
  jourdain_status (*get_states)(const void* ensemble, size_t first, size_t count, double* t, double* y,
                                double* z);
  jourdain_status (*set_states)(void* ensemble, size_t first, size_t count, const double* t, const double* y,
                                const double* z);
  jourdain_status (*set_inputs)(void* ensemble, size_t first, size_t count, const double* u);
  /* States stay as they are: what depends on parameters, as loops do, may have to be set anew. Once one of them has its
   * own, every block of states has. */
  jourdain_status (*set_parameters)(void* ensemble, size_t first, size_t count, const double* parameters);

  /* `steps` steps of length h, s, by so many threads (0: as many as the machine runs at once). Inputs are held (null),
   * or read before each step and kept as they are at the last one. Answers JOURDAIN_NOT_FINITE only for h or an input,
   * as the model keeps them, JOURDAIN_WRONG_CALL also for an h that is 0 there but not here, and has done nothing then:
   * what became of each state, `get_trusted` says. */
  jourdain_status (*run)(void* ensemble, int stepper, double h, size_t steps, size_t threads,
                         const jourdain_inputs* inputs);
  /* Of each state 1 where all of it was finite after every step since it was set, and its loops were closed, with
   * parameters for which that is proven, else 0. */
  jourdain_status (*get_trusted)(const void* ensemble, size_t first, size_t count, unsigned char* trusted);
} jourdain_ensemble;

#ifdef __cplusplus
}
#endif

#endif
