/* rig with pointers to functions of the user against plain, in which the same expressions stand. */
#include <math.h>
#include <stdio.h>

#include "plain.h"
#include "rig.h"

static double grip(void *context, double slip, double load, double width) {
  ++*(int *)context;
  return load * tanh(slip / width);
}
static double grip_slip(void *context, double slip, double load, double width) {
  const double t = tanh(slip / width);
  ++*(int *)context;
  return load * (1 - t * t) / width;
}
static double grip_load(void *context, double slip, double load, double width) {
  ++*(int *)context;
  (void)load;
  return tanh(slip / width);
}
static double hardening(void *context, double x) {
  ++*(int *)context;
  return x + 3 * x * x * x;
}
static double hardening_x(void *context, double x) {
  ++*(int *)context;
  return 1 + 9 * x * x;
}

static double cam(void *context, double angle, double lift) {
  ++*(int *)context;
  return lift * (1 - cos(angle));
}
static double cam_angle(void *context, double angle, double lift) {
  ++*(int *)context;
  return lift * sin(angle);
}
static double cam_angle_angle(void *context, double angle, double lift) {
  ++*(int *)context;
  return lift * cos(angle);
}
static double cam_angle_angle_angle(void *context, double angle, double lift) {
  ++*(int *)context;
  return -lift * sin(angle);
}

int main(void) {
  rig_parameters rig_parameters_;
  plain_parameters plain_parameters_;
  rig_model rig_;
  plain_model plain_;
  rig_state a;
  plain_state b;
  rig_linearization A;
  plain_linearization B;
  rig_accelerations e = {0, {0}};
  plain_accelerations f = {0, {0}};
  const rig_input u = {{3}};
  const plain_input v = {{3}};
  int calls = 0, i, j;
  double worst = 0;

  rig_default_parameters(&rig_parameters_);
  plain_default_parameters(&plain_parameters_);
  rig_.functions.context = &calls;
  rig_.functions.grip = grip;
  rig_.functions.grip_slip = grip_slip;
  rig_.functions.grip_load = grip_load;
  rig_.functions.hardening = hardening;
  rig_.functions.cam = cam;
  rig_.functions.cam_angle = cam_angle;
  rig_.functions.cam_angle_angle = cam_angle_angle;
  rig_.functions.cam_angle_angle_angle = cam_angle_angle_angle;
  rig_.functions.hardening_x = hardening_x;
  rig_set_model(&rig_, &rig_parameters_);
  plain_set_model(&plain_, &plain_parameters_);
  a = rig_initial_state(&rig_);
  b = plain_initial_state(&plain_);
  for (i = 0; i < 1000; ++i) {
    rig_ros34pw2_step(&rig_, &a, &u, 1e-3, &e);
    plain_ros34pw2_step(&plain_, &b, &v, 1e-3, &f);
    for (j = 0; j < 5; ++j) worst = fmax(worst, fabs(a.z[j] - b.z[j]));
  }
  rig_linearize(&rig_, &a, &u, &A);
  plain_linearize(&plain_, &b, &v, &B);
  for (i = 0; i < 7; ++i)
    for (j = 0; j < 7; ++j) worst = fmax(worst, fabs(A.A[i][j] - B.A[i][j]));
  printf("%.1e %d\n", worst, calls);
  return worst < 1e-9 && calls > 1000 ? 0 : 1;
}
