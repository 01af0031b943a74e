// Lets a Panda arm fall for a second and drives Andrews' squeezing mechanism for 30 ms; prints where they end.
#include <cstdio>

#include "panda.hpp"
#include "squeezer.hpp"

namespace {

template <int count>
void print(const char* name, const double (&y)[count]) {
  std::printf("%s", name);
  for (const double position : y) std::printf(" %.17g", position);
  std::printf("\n");
}

}  // namespace

int main() {
  const panda::Model<> arm{panda::Parameters<>()};
  panda::State<> falling = panda::initial_state(arm);
  for (int i = 0; i < 1000; ++i) panda::rk4_step(arm, falling, {}, 1e-3);
  print("panda", falling.y);

  const squeezer::Model<> mechanism{squeezer::Parameters<>()};
  squeezer::State<> driven = squeezer::initial_state(mechanism);
  for (int i = 0; i < 3000; ++i) squeezer::rk4_step(mechanism, driven, {}, 1e-5);
  if (!squeezer::Model<>::loops_closed(driven)) return 1;
  print("squeezer", driven.y);
}
