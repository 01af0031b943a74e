// What an emitted step takes, counted from its statements and those of what it calls.
#pragma once

#include "emit/step_functions.hpp"

namespace jourdain::emit {

/// A step, with the additions, products, quotients and square roots of one call with held inputs, after the first
/// steps of a trajectory. Numbers made of literals are constants; moving the clock takes kClockOperations.
struct StepRecord {
  const programs::Stepper* stepper = nullptr;
  long operations = 0;
};

/// Of the steps among `functions`, in their order.
std::vector<StepRecord> step_records(const programs::SceneFacts& scene,
                                     const std::vector<programs::FunctionInfo>& functions,
                                     const ir::Module& module);

/// Additions that move the clock once: time is a sum of three numbers.
inline constexpr long kClockOperations = 7;

}  // namespace jourdain::emit
