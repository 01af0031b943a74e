// SPDX-License-Identifier: MIT
// Many states of one emitted model, each stepped by a thread of a graphics processor:
//
//     #include <jourdain/device_ensemble.hpp>  // first: it marks emitted functions for the device
//     #include "panda_kernels.hpp"             // of: jourdain compile panda.toml
//
//     jourdain::DeviceEnsemble<panda::Model> ensemble(100000);
//     ensemble.run(jourdain::rk4, 1e-3, 500);  // 500 steps of 1 ms
//     const panda::State<> last = ensemble.state(99999);
//
// For nvcc, clang's CUDA mode and hipcc; other compilers step on the host, one state after the other.
#pragma once

#include "device.hpp"
#include "stepping.hpp"

namespace jourdain {

namespace detail {

template <class Part, class Real>
JOURDAIN_FUNCTION constexpr std::size_t numbers_of() {
  static_assert(std::is_trivially_copyable_v<Part>, "numbers alone");
  static_assert(std::is_empty_v<Part> || sizeof(Part) % sizeof(Real) == 0, "numbers alone");
  return std::is_empty_v<Part> ? 0 : sizeof(Part) / sizeof(Real);
}

// Number i of state k lies at i count + k: threads beside each other read beside each other.
template <class Part, class Real>
JOURDAIN_FUNCTION Part load(const Real* all, std::size_t count, std::size_t k) {
  constexpr std::size_t size = numbers_of<Part, Real>();
  Part part{};
  if constexpr (size > 0) {
    Real numbers[size];
    for (std::size_t i = 0; i < size; ++i) numbers[i] = all[i * count + k];
    copy(&part, numbers, sizeof(Part));
  }
  return part;
}
template <class Part, class Real>
JOURDAIN_FUNCTION void store(Real* all, std::size_t count, std::size_t k, const Part& part) {
  constexpr std::size_t size = numbers_of<Part, Real>();
  if constexpr (size > 0) {
    Real numbers[size];
    copy(numbers, &part, sizeof(Part));
    for (std::size_t i = 0; i < size; ++i) all[i * count + k] = numbers[i];
  }
}

/// What one thread of the device does: all steps of one state.
template <class Model, class Stepper, class Before>
struct StepEach {
  using Real = typename Model::Scalar;
  using State = typename Model::State;
  using Input = typename Model::Input;

  Stepper stepper;
  Before before;
  Real h;
  std::size_t steps, count;
  const Model* model;
  Real *states, *inputs;
  const Real* parameters;  // null where all have the model's
  unsigned char* failed;

  JOURDAIN_FUNCTION void operator()(std::size_t k) const {
    if (parameters)
      step(with_parameters(*model, load<typename Model::Parameters>(parameters, count, k), 0), k);
    else
      step(*model, k);
  }

  JOURDAIN_FUNCTION void step(const Model& m, std::size_t k) const {
    State state = load<State>(states, count, k);
    Input input = load<Input>(inputs, count, k);
    Real nothing = 0;  // stays zero where all are numbers
    bool closed = true;
    for (std::size_t i = 0; i < steps; ++i) {
      before(k, i, state, input);
      if constexpr (std::is_invocable_v<const Stepper&, const Model&, State&, const Input&, const Real&,
                                        std::size_t>)
        stepper(m, state, input, h, k);
      else
        stepper(m, state, input, h);
      add_nothing(state, nothing);
      if constexpr (HasLoops<Model>::value) closed = closed && Model::loops_closed(state);
    }
    store(states, count, k, state);
    store(inputs, count, k, input);
    if (!(nothing == 0 && closed)) failed[k] = 1;
  }
};

}  // namespace detail

/// What `run` calls before each step unless it is given something else.
struct NothingBefore {
  template <class State, class Input>
  JOURDAIN_FUNCTION void operator()(std::size_t, std::size_t, const State&, Input&) const {}
};

/// States of NAME::Model in double or float. One thread of the host uses it at a time.
template <template <class> class ModelOf, class Real = double>
class DeviceEnsemble {
 public:
  using Model = ModelOf<Real>;
  using State = typename Model::State;
  using Input = typename Model::Input;
  using Parameters = typename Model::Parameters;

  /// `count` states, all as the description starts, with inputs of zero. Throws std::invalid_argument without any, and
  /// like all functions here std::runtime_error with the words of the device where it fails.
  explicit DeviceEnsemble(std::size_t count, const Parameters& parameters = Parameters())
      : count_(checked(count)),
        common_(parameters),
        model_(1, Model(parameters)),
        states_(count * detail::numbers_of<State, Real>()),
        inputs_(count * detail::numbers_of<Input, Real>()),
        parameters_(0),
        failed_(count, 0) {
    const State start = initial_state(Model(parameters));
    for (std::size_t k = 0; k < count; ++k) put(states_, k, start);
  }

  std::size_t count() const noexcept { return count_; }

  State state(std::size_t k) const { return get<State>(states_, k); }
  /// The state is trusted again.
  void set_state(std::size_t k, const State& state) {
    put(states_, k, state);
    failed_.write()[k] = 0;
  }
  Input input(std::size_t k) const { return get<Input>(inputs_, k); }
  void set_input(std::size_t k, const Input& input) { put(inputs_, k, input); }
  Parameters parameters(std::size_t k) const { return has_own_ ? get<Parameters>(parameters_, k) : common_; }
  /// Of state k alone, which stays as it is: what depends on parameters, as loops do, may have to be set anew.
  void set_parameters(std::size_t k, const Parameters& parameters) {
    if (!has_own_) {
      parameters_ = OnDevice<Real>(count_ * detail::numbers_of<Parameters, Real>());
      for (std::size_t i = 0; i < count_; ++i) put(parameters_, i, common_);
      has_own_ = true;
    }
    put(parameters_, k, parameters);
  }

  /// The data of the functions that the user of emitted code defines, Model::Functions, of all states.
  template <class Functions>
  void set_functions(const Functions& functions) {
    model_.write()[0].functions = functions;
  }

  /// `steps` steps of length h (s) of all states. Before each one before(k, step, state, input) is called on the
  /// device, and may set state k's input. A stepper is called with model, state, input and h, and where it takes that,
  /// k, for what methods remember from step to step. Both are copied to the device: they hold numbers, and pointers to
  /// what lies there (OnDevice).
  template <class Stepper, class Before = NothingBefore>
  void run(const Stepper& stepper, Real h, std::size_t steps, const Before& before = Before()) {
    const Real* own = has_own_ ? parameters_.read_on_device() : nullptr;
    detail::run_on_device(
        detail::StepEach<Model, Stepper, Before>{stepper, before, h, steps, count_, model_.read_on_device(),
                                                 states_.write_on_device(), inputs_.write_on_device(), own,
                                                 failed_.write_on_device()},
        count_);
  }

  /// Whether all of state k was finite after every step since it was set, and its loops closed, as the model judges
  /// (loops_closed), with parameters for which that is proven (loops_proven).
  bool trusted(std::size_t k) const {
    return !failed_.read()[k] && detail::is_proven<Model>(parameters(k), 0);
  }
  std::size_t untrusted_count() const {
    std::size_t found = 0;
    for (std::size_t k = 0; k < count_; ++k) found += !trusted(k);
    return found;
  }

 private:
  static_assert(std::is_trivially_copyable_v<Model>, "models are copied to the device");

  template <class Part>
  Part get(const OnDevice<Real>& all, std::size_t k) const {
    return detail::load<Part>(all.read().data(), count_, k);
  }
  template <class Part>
  void put(OnDevice<Real>& all, std::size_t k, const Part& part) {
    detail::store(all.write().data(), count_, k, part);
  }

  static std::size_t checked(std::size_t count) {
    if (count == 0) throw std::invalid_argument("an ensemble of no states");
    return count;
  }

  std::size_t count_;
  Parameters common_;
  OnDevice<Model> model_;
  OnDevice<Real> states_, inputs_, parameters_;  // of parameters none until states have their own
  bool has_own_ = false;
  OnDevice<unsigned char> failed_;
};

}  // namespace jourdain
