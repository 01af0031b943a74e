// Accuracy of the accelerations where masses, lengths, speeds, angles and stiffnesses are extreme, as a table
// and, for a file name as argument, as CSV; and what denormal numbers cost in time. Nothing is asserted here:
// tests/extremes does.
#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "embed/emitted_models.hpp"
#include "extremes/extreme_sweep.hpp"

namespace {

using namespace jourdain::tests;

constexpr std::uint64_t kSeeds = 6;
/// Where a perturbation of M by rounding changes the accelerations by less than this, first-order theory holds.
constexpr double kFirstOrder = 0.1;

/// A worst value and the exponent where it was found.
struct Worst {
  double value = 0;
  int exponent = 0;

  void take(double candidate, int at) {
    if (candidate <= value) return;
    value = candidate;
    exponent = at;
  }
};

/// One precision over a family.
struct Column {
  Worst backward, backward_over_loss, forward, forward_over_condition, condition;
  int singular = 0, out_of_range = 0;

  void take(const Accuracy& a, int exponent, double unit_roundoff) {
    condition.take(a.conditioning.condition, exponent);
    if (!a.regular) {
      ++singular;
      return;
    }
    if (a.left_range && !std::isfinite(a.backward)) {
      ++out_of_range;
      return;
    }
    backward.take(a.backward, exponent);
    backward_over_loss.take(a.backward / a.loss, exponent);
    forward.take(a.forward, exponent);
    if (a.conditioning.condition * a.loss * unit_roundoff < kFirstOrder)
      forward_over_condition.take(a.forward / (a.conditioning.condition * a.loss), exponent);
  }
};

void print_csv(fmt::ostream& file, const Family& family, const Measurement& m) {
  for (const bool single : {false, true}) {
    const Accuracy& a = single ? m.in_float : m.in_double;
    file.print("\"{}\",\"{}\",{},{},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.3g},{},{}\n", family.name, family.swept,
               m.exponent, m.seed, single ? "float" : "double", a.backward, a.forward,
               a.conditioning.condition, a.conditioning.scaled, a.loss, int(a.regular), int(a.left_range));
  }
}

std::string at(const Worst& worst) { return fmt::format("{:.2g} (2^{})", worst.value, worst.exponent); }

void print_row(const Family& family, const Column& d, const Column& f, std::size_t refused) {
  fmt::print(
      "{:<36} {:<24} 2^{:<5} 2^{:<3} {:>15} {:>15} {:>8.2g} {:>8.2g} {:>8.2g} {:>8.2g} {:>8.2g} {:>8.2g} "
      "{:>9.2g} {:>4} {:>4} {:>4} {:>4}\n",
      family.name, family.swept, family.first, family.last, at(d.backward), at(f.backward),
      d.backward_over_loss.value, f.backward_over_loss.value, d.forward.value, f.forward.value,
      d.forward_over_condition.value, f.forward_over_condition.value, d.condition.value, d.singular,
      f.singular, f.out_of_range, refused);
}

void print_heading() {
  fmt::print(
      "Accelerations of the optimised program against the symbolic equations in 60 digits, worst of {} "
      "random "
      "states\nper value; in units of u = 2^-53 (double) or 2^-24 (float). Descriptions and states are exact "
      "in "
      "either precision, but\nfor the Panda in float, whose error includes rounding its description.\n"
      "  backward   worst row of |M zdot - k_bar + q_bar| by its term sum, and where\n"
      "  /loss      the same by what the family's loss explains (large angles, small moments; otherwise 1)\n"
      "  /cond      forward error by cond(M) and the loss, where u cond(M) times the loss is below {}\n"
      "  sing       states (double, float) where M is singular to working precision or the loss leaves no "
      "digit: "
      "left out of the errors\n"
      "  rng        states where float leaves its range;  ref: scenes that the compiler's validation "
      "refuses\n\n",
      kSeeds, kFirstOrder);
  fmt::print("{:<36} {:<24} {:<13} {:>15} {:>15} {:>17} {:>17} {:>17} {:>9} {:>9} {:>4} {:>4}\n", "family",
             "swept", "range", "backward double", "backward float", "/loss dbl  float", "forward dbl float",
             "/cond dbl  float", "cond(M)", "sing d  f", "rng", "ref");
}

void measure(const Family& family, std::optional<fmt::ostream>& csv) {
  Sweep sweep(family);
  Column in_double, in_float;
  std::size_t refused = 0;
  for (const int exponent : exponents(family)) {
    for (const Measurement& m : sweep.at(exponent, kSeeds)) {
      in_double.take(m.in_double, exponent, 0x1p-53);
      in_float.take(m.in_float, exponent, 0x1p-24);
      if (csv) print_csv(*csv, family, m);
    }
    if (family.in_scene || exponent == family.first) refused += !sweep.refusals().empty();
  }
  print_row(family, in_double, in_float, refused);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Nanoseconds per call of forward_dynamics. The state is out of the compiler's sight, so that no call is left out.
template <class Model>
double block_time(const Model& model, const typename Model::State& state) {
  using Clock = std::chrono::steady_clock;
  constexpr int kCalls = 2000;
  typename Model::Scalar zdot[Model::velocity_count];
  const auto begin = Clock::now();
  for (int i = 0; i < kCalls; ++i) {
    asm volatile("" : : "r"(&state), "r"(zdot) : "memory");
    forward_dynamics(model, state, {}, zdot);
  }
  asm volatile("" : : "r"(zdot) : "memory");
  return std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / kCalls;
}

/// Rates of 1 against rates that are denormal numbers.
template <class Model>
void time_denormals(const std::string& name, const char* precision) {
  using Real = typename Model::Scalar;
  constexpr int kRepeats = 21;
  const Model model;
  typename Model::State usual = initial_state(model), denormal = usual;
  for (Real& z : usual.z) z = 1;
  for (Real& z : denormal.z) z = std::numeric_limits<Real>::min() / 64;
  std::vector<double> with, without;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    without.push_back(block_time(model, usual));
    with.push_back(block_time(model, denormal));
  }
  fmt::print("{:<20} {:<7} {:>9.0f} {:>9.0f} {:>7.2f}\n", name, precision, median(without), median(with),
             median(with) / median(without));
}

}  // namespace

int main(int argc, char** argv) {
  std::optional<fmt::ostream> csv;
  if (argc > 1) {
    csv.emplace(fmt::output_file(argv[1]));
    csv->print(
        "family,swept,exponent,seed,precision,backward_u,forward_u,condition,scaled_condition,loss,regular,"
        "left_range\n");
  }
  print_heading();
  for (const Family& family : extreme_families()) measure(family, csv);
  fmt::print("\n{:<20} {:<7} {:>9} {:>9} {:>7}\n", "forward_dynamics, ns", "", "rates 1", "denormal",
             "ratio");
#define JOURDAIN_TIME(name)                             \
  time_denormals<name::Model<double>>(#name, "double"); \
  time_denormals<name::Model<float>>(#name, "float");
  JOURDAIN_EMITTED_MODELS(JOURDAIN_TIME)
}
