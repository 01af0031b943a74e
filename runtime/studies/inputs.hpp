// Inputs of a model over time.
#pragma once

#include <memory>
#include <vector>

#include "jourdain/long_real.hpp"

namespace jourdain::studies {

/// Values of all inputs (N m, N, or as the description says) as functions of time, in double and in 50 digits.
class Inputs {
 public:
  virtual ~Inputs() = default;
  virtual std::vector<double> at(double t) const = 0;
  virtual std::vector<LongReal> at(const LongReal& t) const = 0;
  /// Values or their rates may jump at some times.
  virtual bool has_kinks() const { return false; }
};

/// Inputs that do not change.
class ConstantInputs : public Inputs {
 public:
  explicit ConstantInputs(std::vector<double> values) : values_(std::move(values)) {}

  std::vector<double> at(double) const override { return values_; }
  std::vector<LongReal> at(const LongReal&) const override {
    return std::vector<LongReal>(values_.begin(), values_.end());
  }

 private:
  std::vector<double> values_;
};

}  // namespace jourdain::studies
