// Time of one step for every model, double and float: interleaved repeats, medians, and ratios to
// double within the same run, because machines are shared and noisy. Nothing is asserted here.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "embed/emitted_models.hpp"

namespace {

using Clock = std::chrono::steady_clock;

/// Nanoseconds per call of `step` over a block of calls.
template <class Step>
double block_time(Step&& step, int calls) {
  const auto begin = Clock::now();
  for (int i = 0; i < calls; ++i) step();
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / calls;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// A model at its initial state; each call advances it by a step that is short enough for every model here.
template <class Model>
struct Runner {
  using Real = typename Model::Scalar;
  Model model;
  typename Model::State state = initial_state(model);
  typename Model::Input input{};
  void operator()() { rk4_step(model, state, input, Real(1e-4)); }
};

template <class DoubleModel, class FloatModel>
void measure(const std::string& name) {
  constexpr int kCalls = 2000, kRepeats = 21;
  Runner<DoubleModel> in_double;
  Runner<FloatModel> in_float;
  std::vector<double> double_times, float_times;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    double_times.push_back(block_time(in_double, kCalls));
    float_times.push_back(block_time(in_float, kCalls));
  }
  const double reference = median(double_times);
  // The states are printed so that no compiler may leave the steps out.
  fmt::print("{:<20} {:>10.0f} {:>10.0f} {:>8.2f}   {:g}, {:g}\n", name, reference, median(float_times),
             median(float_times) / reference,
             static_cast<double>(kinetic_energy(in_double.model, in_double.state)),
             static_cast<double>(kinetic_energy(in_float.model, in_float.state)));
}

}  // namespace

int main() {
  fmt::print("{:<20} {:>10} {:>10} {:>8}   {}\n", "rk4_step, ns", "double", "float", "ratio",
             "kinetic energy at the end");
#define JOURDAIN_MEASURE(name) measure<name::Model<double>, name::Model<float>>(#name);
  JOURDAIN_EMITTED_MODELS(JOURDAIN_MEASURE)
}
