/* SPDX-License-Identifier: MIT
 *
 * An emitted model as a table of C functions, so that one program can load any model. Quantities are double whatever
 * number type the model computes in. */
#ifndef JOURDAIN_MODEL_TABLE_H
#define JOURDAIN_MODEL_TABLE_H

typedef struct jourdain_model_table {
  int position_count; /* entries of y */
  int velocity_count; /* entries of z */
  int input_count;    /* entries of u */
  /* Names in order, closed by a null pointer. */
  const char* const* position_names;
  const char* const* velocity_names;
  const char* const* input_names;
  /* y and z that the description starts from, at t = 0. */
  void (*initial_state)(double* y, double* z);
  /* Makes `count` steps of length h (s) from t, y, z; u is held. The result replaces t, y and z. */
  void (*rk4_steps)(double* t, double* y, double* z, const double* u, double h, long count);
  /* J */
  double (*kinetic_energy)(double t, const double* y, const double* z);
  double (*potential_energy)(double t, const double* y, const double* z);
} jourdain_model_table;

#endif
