// Lets a Panda arm fall for 0.2 s and drives Andrews' squeezing mechanism for 3 ms, in float; prints where they end, in
// millionths of a radian.
#include "board.h"
#include "panda.hpp"
#include "squeezer.hpp"

namespace {

void print(float value) {
  board_write(" ");
  board_write_number(static_cast<int64_t>(value * 1e6f + (value < 0 ? -0.5f : 0.5f)));
  board_write("e-6");
}

template <class Model>
void run(const char* name, float h, int steps) {
  const Model model;
  typename Model::State state = initial_state(model);
  for (int i = 0; i < steps; ++i) rk4_step(model, state, typename Model::Input{}, h);
  board_write(name);
  for (const float y : state.y) print(y);
  board_write("\n");
}

}  // namespace

int main() {
  run<panda::Model<float>>("panda", 1e-3f, 200);
  run<squeezer::Model<float>>("squeezer", 1e-5f, 300);
  return 0;
}
