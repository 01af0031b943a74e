// Two models, one of them twice with different parameters, stepped by eight threads at once: each must end with the
// bits that one thread alone ends with.
#include <array>
#include <cstdio>
#include <cstring>
#include <thread>
#include <vector>

#include "cart_pole.hpp"
#include "double_pendulum.hpp"

namespace {

constexpr int kSteps = 500;

std::vector<double> run(int which) {
  std::vector<double> end;
  if (which % 2 == 0) {
    double_pendulum::Model<double>::Parameters parameters;
    parameters.l1 += 0.1 * which;
    const double_pendulum::Model<double> model(parameters);
    auto state = initial_state(model);
    for (int k = 0; k < kSteps; ++k) rk4_step(model, state, {}, 1e-3);
    end.insert(end.end(), state.y, state.y + 2);
    end.insert(end.end(), state.z, state.z + 2);
  } else {
    const cart_pole::Model<double> model;
    auto state = initial_state(model);
    for (int k = 0; k < kSteps; ++k) rk4_step(model, state, {{0.1 * which}}, 1e-3);
    end.insert(end.end(), state.y, state.y + 2);
    end.insert(end.end(), state.z, state.z + 2);
  }
  return end;
}

}  // namespace

int main() {
  std::array<std::vector<double>, 8> together;
  std::vector<std::thread> threads;
  for (int k = 0; k < 8; ++k)
    threads.emplace_back([k, &together] { together[static_cast<std::size_t>(k)] = run(k); });
  for (std::thread& thread : threads) thread.join();
  int different = 0;
  for (int k = 0; k < 8; ++k) {
    const std::vector<double> alone = run(k);
    different += std::memcmp(alone.data(), together[static_cast<std::size_t>(k)].data(),
                             alone.size() * sizeof(double)) != 0;
    if (k > 1 && alone == together[static_cast<std::size_t>(k - 2)])
      ++different;  // other parameters, other ends
  }
  std::printf("%d\n", different);
  return different;
}
