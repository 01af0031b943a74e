/* What blocks of Simulink see of it, as far as emitted ones use it: names and arguments of its published functions, over a
   plain struct that block.c runs. */
#ifndef SIMSTRUC_H
#define SIMSTRUC_H

#include <stddef.h>

typedef int int_T;

typedef struct {
  double* numbers;
  size_t count;
} mxArray;

typedef struct SimStruct {
  const mxArray* parameters;
  int parameter_count, expected_parameters;
  int input_ports, input_width, feeds_through, contiguous;
  int output_ports, output_widths[3];
  double *input, *outputs[3];
  double sample_time, offset;
  int sample_times, work_vectors, work_width, work_type, continuous_states, discrete_states;
  void* work;
  const char* error;
} SimStruct;

enum { SS_UINT8 = 3 };

#define ssSetNumSFcnParams(S, n) ((void)((S)->expected_parameters = (n)))
#define ssGetNumSFcnParams(S) ((S)->expected_parameters)
#define ssGetSFcnParamsCount(S) ((S)->parameter_count)
#define ssSetSFcnParamTunable(S, k, is) ((void)(S), (void)(k), (void)(is))
#define ssGetSFcnParam(S, k) (&(S)->parameters[k])
#define ssSetNumContStates(S, n) ((void)((S)->continuous_states = (n)))
#define ssSetNumDiscStates(S, n) ((void)((S)->discrete_states = (n)))
#define ssSetNumInputPorts(S, n) ((S)->input_ports = (n), 1)
#define ssSetInputPortWidth(S, port, n) ((void)(port), (void)((S)->input_width = (n)))
#define ssSetInputPortRequiredContiguous(S, port, is) ((void)(port), (void)((S)->contiguous = (is)))
#define ssSetInputPortDirectFeedThrough(S, port, is) ((void)(port), (void)((S)->feeds_through = (is)))
#define ssSetNumOutputPorts(S, n) ((S)->output_ports = (n), 1)
#define ssSetOutputPortWidth(S, port, n) ((void)((S)->output_widths[port] = (n)))
#define ssSetNumSampleTimes(S, n) ((void)((S)->sample_times = (n)))
#define ssSetSampleTime(S, k, h) ((void)(k), (void)((S)->sample_time = (h)))
#define ssGetSampleTime(S, k) ((void)(k), (S)->sample_time)
#define ssSetOffsetTime(S, k, t) ((void)(k), (void)((S)->offset = (t)))
#define ssSetNumDWork(S, n) ((void)((S)->work_vectors = (n)))
#define ssSetDWorkWidth(S, k, n) ((void)(k), (void)((S)->work_width = (n)))
#define ssSetDWorkDataType(S, k, type) ((void)(k), (void)((S)->work_type = (type)))
#define ssGetDWork(S, k) ((void)(k), (S)->work)
#define ssGetInputPortRealSignal(S, port) ((void)(port), (const double*)(S)->input)
#define ssGetOutputPortRealSignal(S, port) ((S)->outputs[port])
#define ssSetErrorStatus(S, text) ((void)((S)->error = (text)))
#define mxGetPr(array) ((array)->numbers)
#define mxGetNumberOfElements(array) ((array)->count)

#endif
