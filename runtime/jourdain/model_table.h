/* SPDX-License-Identifier: MIT
 *
 * An emitted model as a table of C functions, so that one program can load any model in any number type. Every number
 * passes as `parts` consecutive doubles whose sum it is: one for models that compute in double or float. */
#ifndef JOURDAIN_MODEL_TABLE_H
#define JOURDAIN_MODEL_TABLE_H

/* Inputs: `held` over the step, or where `at` is not null its values at the state of each stage. */
typedef struct jourdain_inputs {
  const double* held;
  void (*at)(void* context, const double* t, const double* y, const double* z, double* u);
  void* context;
} jourdain_inputs;

typedef struct jourdain_method {
  const char* name; /* of the stepper, without "_step" */
  int order;
  int evaluations; /* of forward_dynamics per step; of residual where it is implicit */
  int history;     /* earlier steps whose rates it remembers */
  int implicit;    /* 1: linearly implicit, remembers accelerations */
  long operations; /* arithmetic operations per step */
  /* Makes `count` steps of length h (s) from t, y, z and replaces them by the result. `memory` is the caller's: a
   * double that counts the earlier steps in it, then their rates of y, newest step first, then those of z; where it is
   * implicit a double that tells whether there are any, then dz/dt. Zero at the start of a trajectory, null where it
   * remembers nothing. */
  void (*steps)(double* t, double* y, double* z, const jourdain_inputs* inputs, const double* h, long count,
                double* memory);
} jourdain_method;

/* How loops were closed, the worst of some steps. */
typedef struct jourdain_closing {
  double regularity; /* of what was solved */
  double opening;    /* square of how far positions were moved, rad or m */
  double beyond;     /* positive: a position was outside the range for which something is proven */
  double
      left_open; /* largest |g| after those that moved positions beyond greatest_opening, m or without unit */
} jourdain_closing;

typedef struct jourdain_model_table {
  int parts;           /* doubles per number */
  int position_count;  /* entries of y */
  int velocity_count;  /* entries of z */
  int input_count;     /* entries of u */
  int parameter_count; /* tunable parameters */
  int output_count;    /* numbers of all outputs */
  int method_count;
  double unit_roundoff;     /* largest relative error of one rounding */
  long dynamics_operations; /* arithmetic operations of the rates of y and z at one state */
  /* Names in order, closed by a null pointer. */
  const char* const* position_names;
  const char* const* velocity_names;
  const char* const* input_names;
  const char* const* parameter_names;
  const jourdain_method* methods;
  /* Values of all parameters from now on; not while another thread computes. */
  void (*set_parameters)(const double* values);
  /* y and z that the description starts from, at t = 0; the loops are closed at the parameters' default values. */
  void (*initial_state)(double* y, double* z);
  /* dy/dt and dz/dt. */
  void (*rates)(const double* t, const double* y, const double* z, const double* u, double* ydot,
                double* zdot);
  /* Derivatives of dz/dt by displacements and by z, row by row; null where not emitted. */
  void (*derivatives)(const double* t, const double* y, const double* z, const double* u, double* zdot_y,
                      double* zdot_z);
  /* Generalized forces (N m, N) that are missing for dz/dt at u = 0; null where not emitted. */
  void (*inverse_dynamics)(const double* t, const double* y, const double* z, const double* zdot,
                           double* tau);
  /* J */
  void (*kinetic_energy)(const double* t, const double* y, const double* z, double* energy);
  void (*potential_energy)(const double* t, const double* y, const double* z, double* energy);
  /* All outputs of the description, in its order, matrices row by row; null where there are none. */
  void (*outputs)(const double* t, const double* y, const double* z, const double* u, double* values);
  /* Of a mechanism with closed loops; zero and null where there are none. */
  int constraint_count;                /* rows of all loops */
  const char* const* constraint_names; /* closed by a null pointer */
  /* How far the loops are open, g (m; rows without a length: without unit), and its rate. */
  void (*constraint_residual)(const double* t, const double* y, const double* z, double* g, double* g_rate);
  /* What steps end with: moves y and z towards the closed loops. */
  void (*correct)(const double* t, double* y, double* z);
  double least_regularity, greatest_opening; /* not to be trusted below and beyond; NaN is beyond */
  void (*closing)(jourdain_closing* worst);  /* of all steps of the last call of `steps` on this thread */
} jourdain_model_table;

#endif
