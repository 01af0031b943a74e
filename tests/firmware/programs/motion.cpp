// The same program on the host and on every target: a model's motion from its start, each number as its bits.
// MODEL, REAL, STEP (s) and KERNELS, the header of the model's bodies, are defined by who compiles it.
#include KERNELS

#include <stdint.h>

#include "board.h"

namespace {

namespace m = MODEL;
using Model = m::Model<REAL>;
using State = Model::State;
using Input = Model::Input;

constexpr int kSteps = 200, kReported = 20;

void write_bits(REAL number) {
  uint64_t bits = 0;
  __builtin_memcpy(&bits, &number, sizeof number);
  char text[20];
  char* end = text + sizeof text;
  *--end = '\0';
  for (unsigned i = 0; i < 2 * sizeof number; ++i, bits >>= 4) *--end = "0123456789abcdef"[bits & 15];
  *--end = ' ';
  board_write(end);
}

// A line: what it is, then the bits of all numbers of `value`, which holds nothing else.
template <class Value>
void write_all(const char* what, const Value& value) {
  REAL numbers[sizeof(Value) / sizeof(REAL)];
  __builtin_memcpy(numbers, &value, sizeof value);
  board_write(what);
  for (const REAL number : numbers) write_bits(number);
  board_write("\n");
}

template <class Type>
auto set_inputs(Type& input, int) -> decltype(void(input.u)) {
  REAL value = REAL(0.25);
  for (REAL& u : input.u) u = value, value = -(value + REAL(0.125));
}
template <class Type>
void set_inputs(Type&, long) {}

template <class Type>
auto write_outputs(const Type& model, const State& state, const Input& input, int) -> typename Type::Outputs {
  typename Type::Outputs values{};
  outputs(model, state, input, values);
  write_all("outputs", values);
  return values;
}
template <class Type>
void write_outputs(const Type&, const State&, const Input&, long) {}

template <class Type>
auto write_time(const Type& state, int) -> decltype(void(state.t)) {
  write_all("t", state.t);
}
template <class Type>
void write_time(const Type&, long) {}

void report(const Model& model, const State& state, const Input& input) {
  REAL zdot[Model::velocity_count];
  m::forward_dynamics(model, state, input, zdot);
  write_time(state, 0);
  write_all("y", state.y);
  write_all("z", state.z);
  write_all("forward_dynamics", zdot);
  write_all("kinetic_energy", m::kinetic_energy(model, state));
  write_all("potential_energy", m::potential_energy(model, state));
  write_outputs(model, state, input, 0);
}

}  // namespace

int main() {
  const Model model;
  State state = m::initial_state(model);
  Input input{};
  set_inputs(input, 0);
  report(model, state, input);
  for (int i = 1; i <= kSteps; ++i) {
    m::rk4_step(model, state, input, REAL(STEP));
    if (i % kReported == 0) report(model, state, input);
  }
  return 0;
}
