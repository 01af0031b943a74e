// Step lengths from 1e-12 s to where RK4 fails, and a hundred million steps: what is left of the energy.
// Nothing is asserted.
#include <fmt/format.h>

#include <cmath>

#include "embed/emitted_models.hpp"

namespace {

/// Energy after `steps` of length h, off by this share of the largest kinetic energy on the way.
template <class Model>
double energy_error(double h, long steps) {
  using Real = typename Model::Scalar;
  const Model model;
  typename Model::State state = initial_state(model);
  const auto energy = [&] {
    return double(kinetic_energy(model, state)) + double(potential_energy(model, state));
  };
  const double start = energy();
  double largest = double(kinetic_energy(model, state));
  constexpr long kLooks = 1000;
  for (long k = 0; k < kLooks; ++k) {
    for (long i = 0; i < steps / kLooks; ++i) rk4_step(model, state, {}, Real(h));
    largest = std::fmax(largest, double(kinetic_energy(model, state)));
  }
  return std::fabs(energy() - start) / largest;
}

template <class DoubleModel, class FloatModel>
void sweep_steps(const char* name) {
  constexpr long kSteps = 100'000;
  for (int decade = -12; decade <= 0; ++decade) {
    const double h = std::pow(10.0, decade);
    fmt::print("{:<16} {:>8.0e} {:>9} {:>12.1e} {:>12.1e}\n", name, h, kSteps,
               energy_error<DoubleModel>(h, kSteps), energy_error<FloatModel>(h, kSteps));
  }
}

template <class DoubleModel>
void run_long(const char* name) {
  constexpr long kMany = 100'000'000;
  fmt::print("{:<16} {:>8.0e} {:>9} {:>12.1e}\n", name, 1e-3, kMany, energy_error<DoubleModel>(1e-3, kMany));
}

}  // namespace

int main() {
  fmt::print(
      "energy after RK4 steps, off by this share of the largest kinetic energy\n{:<16} {:>8} {:>9} {:>12} "
      "{:>12}\n",
      "model", "h, s", "steps", "double", "float");
  sweep_steps<pendulum::Model<double>, pendulum::Model<float>>("pendulum");
  sweep_steps<double_pendulum::Model<double>, double_pendulum::Model<float>>("double_pendulum");
  sweep_steps<tumbling_body::Model<double>, tumbling_body::Model<float>>("tumbling_body");
  run_long<pendulum::Model<double>>("pendulum");
  run_long<tumbling_body::Model<double>>("tumbling_body");
}
