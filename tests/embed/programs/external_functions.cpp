// rig with functions of the user against plain, in which the same expressions stand.
#include <cmath>
#include <cstdio>

#include "plain.hpp"
#include "rig.hpp"
#include "rig_functions.hpp"

namespace {

double worst = 0;

void compare(double a, double b) {
  const double off = std::fabs(a - b) / (1 + std::fabs(b));
  if (!(off <= worst)) worst = off;
}

template <class A, class B>
void compare_states(const A& a, const B& b) {
  for (int i = 0; i < 2; ++i) compare(a.y[i], b.y[i]);
  for (int i = 0; i < 5; ++i) compare(a.z[i], b.z[i]);
}

}  // namespace

int main() {
  const rig::Model<> rig_model;
  const plain::Model<> plain_model;
  rig::State<> a = rig::initial_state(rig_model), c = a;
  plain::State<> b = plain::initial_state(plain_model), d = b;
  const rig::Input<> u{{3}};
  const plain::Input<> v{{3}};
  rig::Accelerations<> e;
  plain::Accelerations<> f;
  for (int i = 0; i < 2000; ++i) {
    rig::rk4_step(rig_model, a, u, 1e-3);
    plain::rk4_step(plain_model, b, v, 1e-3);
    rig::ros34pw2_step(rig_model, c, u, 1e-3, e);
    plain::ros34pw2_step(plain_model, d, v, 1e-3, f);
    compare_states(a, b);
    compare_states(c, d);
    rig::Outputs<> p;
    plain::Outputs<> q;
    rig::outputs(rig_model, a, u, p);
    plain::outputs(plain_model, b, v, q);
    compare(p.held, q.held);
  }
  rig::Linearization<> A;
  plain::Linearization<> B;
  rig::linearize(rig_model, a, u, A);
  plain::linearize(plain_model, b, v, B);
  double size = 0;
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) compare(A.A[i][j], B.A[i][j]);
    for (int j = 0; j < 7; ++j) size += std::fabs(A.A[i][j]);
    compare(A.B[i][0], B.B[i][0]);
  }
  for (int j = 0; j < 7; ++j) compare(A.C[0][j], B.C[0][j]);

  rig::Model<> stronger;
  stronger.functions.gain = 1.5;
  double weak[5], strong[5];
  rig::forward_dynamics(rig_model, a, u, weak);
  rig::forward_dynamics(stronger, a, u, strong);
  const bool differs = std::fabs(strong[0] - weak[0]) > 1e-3;
  std::printf("%.1e %.1f %d\n", worst, size, differs);
  return worst < 1e-9 && size > 10 && differs ? 0 : 1;
}
