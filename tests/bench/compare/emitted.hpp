// An emitted model as a library among others.
#pragma once

#include <algorithm>

#include "bench/compare/library.hpp"

namespace jourdain::compare {

template <class Model>
class Emitted : public Library {
 public:
  explicit Emitted(const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) {
      Values values{initial_state(model_), {}};
      std::copy(sample.y.begin(), sample.y.end(), values.state.y);
      std::copy(sample.z.begin(), sample.z.end(), values.state.z);
      std::copy(sample.zdot.begin(), sample.zdot.end(), values.zdot);
      samples_.push_back(values);
    }
  }

  std::string name() const override { return "Jourdain"; }
  std::string calls(Quantity quantity) const override {
    switch (quantity) {
      case Quantity::kForward:
        return "forward_dynamics";
      case Quantity::kInverse:
        return "inverse_dynamics";
      case Quantity::kMass:
        return "mass_matrix";
      case Quantity::kStep:
        return "rk4_step";
    }
    return "";
  }

  std::vector<double> result(Quantity quantity, std::size_t sample) override {
    State state = samples_[sample].state;
    call(quantity, samples_[sample], state);
    if (quantity == Quantity::kMass) return {*mass_, *mass_ + kCount * kCount};
    if (quantity != Quantity::kStep) return {filled_, filled_ + kCount};
    std::vector<double> values(state.y, state.y + Model::position_count);
    values.insert(values.end(), state.z, state.z + kCount);
    return values;
  }

  void run(Quantity quantity, int times) override {
    if (quantity == Quantity::kStep)
      for (const Values& sample : samples_) {
        State state = sample.state;
        for (int i = 0; i < times; ++i) call(quantity, sample, state);
      }
    else
      for (int i = 0; i < times; ++i)
        for (Values& sample : samples_) call(quantity, sample, sample.state);
  }

 private:
  using State = typename Model::State;
  static constexpr int kCount = Model::velocity_count;

  struct Values {
    State state;
    double zdot[kCount];
  };

  void call(Quantity quantity, const Values& sample, State& state) {
    switch (quantity) {
      case Quantity::kForward:
        return forward_dynamics(model_, sample.state, {}, filled_);
      case Quantity::kInverse:
        return inverse_dynamics(model_, sample.state, sample.zdot, filled_);
      case Quantity::kMass:
        return mass_matrix(model_, sample.state, mass_);
      case Quantity::kStep:
        return rk4_step(model_, state, {}, kStepLength);
    }
  }

  Model model_;
  double filled_[kCount] = {}, mass_[kCount][kCount] = {};
  std::vector<Values> samples_;
};

}  // namespace jourdain::compare
