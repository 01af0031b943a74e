// Inputs given by expressions of time, or by a motion that they make the mechanism follow.
#pragma once

#include <array>
#include <map>

#include "jourdain/model_table.h"
#include "model/read/scenario.hpp"
#include "studies/inputs.hpp"

namespace jourdain::studies {

/// One expression of t per input.
class ExpressionInputs : public Inputs {
 public:
  ExpressionInputs(std::vector<model::Expression> inputs, std::vector<double> parameters)
      : inputs_(std::move(inputs)), parameters_(std::move(parameters)) {}

  std::vector<double> at(double t) const override;
  std::vector<LongReal> at(const LongReal& t) const override;
  bool has_kinks() const override;

 private:
  std::vector<model::Expression> inputs_;
  std::vector<double> parameters_;
};

/// Inputs that make every coordinate follow its motion: the forces that inverse dynamics says are missing,
/// each given to the first actuator of its coordinate.
class FollowingInputs : public Inputs {
 public:
  /// The tables must outlive this; `long_table` may be null where no 50 digits are asked for.
  FollowingInputs(const model::Mechanism& mechanism, std::vector<model::Expression> motion,
                  std::vector<double> parameters, const jourdain_model_table& table,
                  const jourdain_model_table* long_table);

  std::vector<double> at(double t) const override;
  std::vector<LongReal> at(const LongReal& t) const override;
  bool has_kinks() const override;
  /// y and z of the motion at time t (s).
  std::vector<double> state_at(double t) const;

 private:
  struct Drive {
    std::size_t input = 0;
    double gear_ratio = 1;
  };
  template <class Real>
  std::vector<Real> inputs_at(const Real& t, const jourdain_model_table& table) const;

  std::vector<model::Expression> motion_;  // by coordinate
  std::vector<double> parameters_;
  std::vector<Drive> drives_;  // by coordinate
  std::size_t input_count_ = 0;
  const jourdain_model_table& table_;
  const jourdain_model_table* long_table_;
  mutable std::map<std::array<double, 4>, std::vector<LongReal>>
      known_;  // by time: many methods ask for the same ones
};

}  // namespace jourdain::studies
