#include "commands/run_length.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>

namespace jourdain::commands {

namespace {

constexpr double kLongestRun = 1e9;
/// Less of a step than this is rounding of what was typed.
constexpr double kNoticeableRest = 1e-3;

}  // namespace

std::optional<long> steps_asked_for(double duration, double step) {
  const double exact = duration / step;
  if (!(exact >= 1 && exact <= kLongestRun)) {
    fmt::print(stderr,
               "error: --duration {:g} at --step {:g} is {:.3g} steps; between 1 and {:g} are possible\n",
               duration, step, exact, kLongestRun);
    return {};
  }
  const long steps = std::lround(exact);
  const auto whole = static_cast<double>(steps);
  if (std::fabs(exact - whole) > kNoticeableRest)
    fmt::print(stderr,
               "note: --duration {} is {:.10g} steps of --step {}: {} are made, up to t = {:.10g} s\n",
               duration, exact, step, steps, whole * step);
  return steps;
}

}  // namespace jourdain::commands
