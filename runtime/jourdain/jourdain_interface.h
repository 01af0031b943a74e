/* SPDX-License-Identifier: MIT
 *
 * A model as an instance in memory of the caller, and a table of everything that it has: for programs that load models
 * that they do not know. Every number passes as a double. Nothing is allocated; there is no state but the instances,
 * so that any number of them can be used by any number of threads, one at a time each. */
#ifndef JOURDAIN_INTERFACE_H
#define JOURDAIN_INTERFACE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes with the layout of what follows. */
#define JOURDAIN_INTERFACE_VERSION 2

/* What a variable is to who steps the model; numbers of one role are counted together, see `index`. */
typedef enum jourdain_role {
  JOURDAIN_TIME,
  JOURDAIN_POSITION,      /* entry of y */
  JOURDAIN_VELOCITY,      /* entry of z */
  JOURDAIN_POSITION_RATE, /* entry of dy/dt */
  JOURDAIN_ACCELERATION,  /* entry of dz/dt */
  JOURDAIN_INPUT,         /* entry of u */
  JOURDAIN_OUTPUT,        /* numbers of all outputs, in their order */
  JOURDAIN_PARAMETER,     /* tunable */
  JOURDAIN_CONSTANT       /* baked into the code */
} jourdain_role;

/* What its unit measures. */
typedef enum jourdain_quantity {
  JOURDAIN_QUANTITY_TIME,
  JOURDAIN_QUANTITY_ANGLE,
  JOURDAIN_QUANTITY_LENGTH,
  JOURDAIN_QUANTITY_QUATERNION_PART,
  JOURDAIN_QUANTITY_QUATERNION_RATE,
  JOURDAIN_QUANTITY_ANGULAR_VELOCITY,
  JOURDAIN_QUANTITY_VELOCITY,
  JOURDAIN_QUANTITY_ANGULAR_ACCELERATION,
  JOURDAIN_QUANTITY_ACCELERATION,
  JOURDAIN_QUANTITY_FORCE,
  JOURDAIN_QUANTITY_MOMENT,
  JOURDAIN_QUANTITY_MASS,
  JOURDAIN_QUANTITY_INERTIA,
  JOURDAIN_QUANTITY_ENERGY,
  JOURDAIN_QUANTITY_ROTATION_MATRIX,
  JOURDAIN_QUANTITY_OTHER
} jourdain_quantity;

/* What every call answers; anything but JOURDAIN_OK says that results are not to be used. */
typedef enum jourdain_status {
  JOURDAIN_OK = 0,
  JOURDAIN_WRONG_CALL = 1, /* a null pointer, or something that the model does not have; nothing was done */
  JOURDAIN_NOT_FINITE = 2, /* a number that was given, as the model keeps it, or computed is not finite */
  JOURDAIN_LOOPS_OPEN = 3  /* it cannot be trusted that the loops of the mechanism are closed */
} jourdain_status;

typedef struct jourdain_variable {
  const char* name;
  const char* description;
  const char* unit; /* "1": without dimension; empty: not known */
  jourdain_role role;
  jourdain_quantity quantity;
  int index;                  /* of its first number among those of its role */
  int rows, columns;          /* 1 and 1: a number; a vector has one column */
  const char* const* numbers; /* names of its numbers, row by row */
  const double* start; /* its numbers at the parameters' default values; null: it follows from others */
  int has_range;       /* 1: from `minimum` to `maximum` */
  double minimum, maximum;
  int derivative_of; /* index in the table of variables; -1: no derivative */
  const char* const*
      depends_on; /* for each number '1' or '0' for t, each entry of y, of z and of u; null: not known */
} jourdain_variable;

/* An array that a function takes or fills, row by row. */
typedef struct jourdain_argument {
  const char* name;
  int rows, columns; /* a vector has one column */
  int dimensions;    /* 0: a number, 1: a vector, 2: a matrix */
} jourdain_argument;

/* A function of the instance's parameters, state and inputs. */
typedef struct jourdain_function {
  const char* name;
  const char* description;
  int given_count, result_count;
  const jourdain_argument* given; /* beside the instance */
  const jourdain_argument* results;
  int takes_inputs; /* 0: it is the same at all inputs */
  long operations;  /* arithmetic */
  jourdain_status (*call)(void* instance, const double* const* given, double* const* results);
} jourdain_function;

/* A step of the instance's state. */
typedef struct jourdain_stepper {
  const char* name; /* "rk4_step" */
  const char* description;
  int order;
  int remembers; /* 1: set_state and set_inputs start it anew, steps by others and of another length too */
  long operations;
  /* `count` steps of length h, s, inputs held; ends at the first that does not answer JOURDAIN_OK. A wrong call: an h
   * that is 0 as the model keeps it, but not here. */
  jourdain_status (*step)(void* instance, double h, long count);
} jourdain_stepper;

typedef struct jourdain_interface {
  int version;        /* JOURDAIN_INTERFACE_VERSION */
  const char* name;   /* in front of the C functions */
  const char* title;  /* as the description has it */
  const char* source; /* path of the description */
  const char* sha256; /* of the description */
  const char* generator;
  int real_bytes; /* of the numbers that the model computes with */
  int position_count, velocity_count, input_count, output_count, parameter_count, constraint_count;
  int variable_count, function_count, stepper_count;
  const jourdain_variable* variables;
  const jourdain_function* functions;
  const jourdain_stepper* steppers;

  /* An instance is `size` bytes at a multiple of `alignment`. It holds no pointers: a copy of the bytes is a copy of
   * the instance, anywhere. */
  size_t size, alignment;
  /* At the description's start, with default parameters, inputs zero; null where the memory is null, too small or not
   * aligned. */
  void* (*create)(void* memory, size_t size);
  /* The description's start again; parameters and inputs stay. Loops are closed anew where parameters have other values
   * than at first and close_loops or project is among the functions; else they may be open there. */
  jourdain_status (*reset)(void* instance);
  /* All values of a role, in order. Parameters that are set leave the state as it is; where they change how loops
   * close, `reset`. Those at which loops are not proven to close, where that is proven for others, are not taken:
   * JOURDAIN_LOOPS_OPEN. */
  jourdain_status (*get_parameters)(const void* instance, double* values);
  jourdain_status (*set_parameters)(void* instance, const double* values);
  jourdain_status (*get_inputs)(const void* instance, double* values);
  jourdain_status (*set_inputs)(void* instance, const double* values);
  /* `t` where states hold no time: 0, and not looked at. */
  jourdain_status (*get_state)(const void* instance, double* t, double* y, double* z);
  jourdain_status (*set_state)(void* instance, double t, const double* y, const double* z);
  /* dy/dt and dz/dt; null where forward_dynamics or position_rate was left out. */
  jourdain_status (*rates)(void* instance, double* ydot, double* zdot);
  /* 1 where the last step, or the start, closed all loops by its own account, 0 where it did not; 1 without loops. */
  int (*loops_closed)(const void* instance);
} jourdain_interface;

#ifdef __cplusplus
}
#endif

#endif
