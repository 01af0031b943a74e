// Work that is counted instead of timed: what a study finds out depends neither on the machine nor on what
// else it does.
#pragma once

#include <algorithm>

#include "jourdain/model_table.h"

namespace jourdain::studies {

/// Nominal times, s, about those of a desktop processor. Budgets in seconds are in these.
inline constexpr double kOperationTime = 6e-10;     ///< of emitted code in double
inline constexpr double kStepTime = 3e-8;           ///< of a step beside its operations
inline constexpr double kLongOperationTime = 2e-7;  ///< in 50 digits

/// Of one step in double.
inline double step_time(const jourdain_method& method) {
  return kStepTime + kOperationTime * static_cast<double>(method.operations);
}

/// Of one step in 50 digits.
inline double long_step_time(const jourdain_method& method) {
  return kLongOperationTime * static_cast<double>(method.operations + 10);
}

/// Of the rates of a state in 50 digits: a step of the method that asks for them at the least cost, for each
/// time it asks.
inline double long_rates_time(const jourdain_model_table& table) {
  double least = 0;
  for (int m = 0; m < table.method_count; ++m) {
    const jourdain_method& method = table.methods[m];
    const double time = long_step_time(method) / std::max(1, method.evaluations);
    if (!method.implicit && (least == 0 || time < least)) least = time;
  }
  return least;
}

/// A budget that work is taken from.
class Budget {
 public:
  explicit Budget(double seconds) : left_(seconds) {}

  void spend(double seconds) { left_ -= seconds; }
  double left() const { return left_; }
  bool is_over() const { return left_ < 0; }

 private:
  double left_;
};

}  // namespace jourdain::studies
