// SPDX-License-Identifier: MIT
// The functions of jourdain_ensemble.h of one emitted model, in a source of three lines:
//
//     #include "panda_kernels.hpp"           // of: jourdain compile panda.toml --packs
//     #include <jourdain/ensemble_interface.hpp>
//     JOURDAIN_ENSEMBLE(panda_ensemble, panda::Model, double)
//
// declared in C as `const jourdain_ensemble* panda_ensemble(void);`. A last argument `, jourdain::TurnedSines` makes
// ensembles whose steps turn sines (turned_sines.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <exception>
#include <new>
#include <type_traits>

#include "ensemble.hpp"
#include "jourdain_ensemble.h"
#include "turned_sines.hpp"

/// Defines a function of C linkage that gives the table of a model's ensembles in one type of numbers: function, model,
/// real, and where sines are turned, jourdain::TurnedSines.
#define JOURDAIN_ENSEMBLE(function, model, ...)                         \
  extern "C" const jourdain_ensemble* function();                       \
  extern "C" const jourdain_ensemble* function() {                      \
    return &::jourdain::EnsembleInterface<model, __VA_ARGS__>::table(); \
  }

namespace jourdain {

// Tables are of the library that they are compiled into: GCC makes what functions of templates keep one of a whole
// process, so that two libraries with models of one name would have those of the first.
namespace {

template <template <class> class ModelOf, class Real, class Sines = ComputedSines>
class EnsembleInterface {
  static constexpr std::size_t lanes = natural_lanes<Real>;

 public:
  static const jourdain_ensemble& table() {
    static const jourdain_ensemble result = {JOURDAIN_ENSEMBLE_VERSION,
                                             static_cast<int>(sizeof(Real)),
                                             static_cast<int>(lanes),
                                             static_cast<int>(Model::position_count),
                                             static_cast<int>(Model::velocity_count),
                                             static_cast<int>(Model::input_count),
                                             static_cast<int>(numbers_of<Parameters>()),
                                             static_cast<int>(steppers().count),
                                             steppers().names.data(),
                                             create,
                                             destroy,
                                             get_states,
                                             set_states,
                                             set_inputs,
                                             set_parameters,
                                             run,
                                             get_trusted};
    return result;
  }

 private:
  using Many = Ensemble<ModelOf, Real, lanes, Sines>;
  using Model = typename Many::Model;
  using State = typename Many::State;
  using Input = typename Many::Input;
  using Parameters = typename Many::Parameters;
  using Run = void (*)(Many&, double, std::size_t, std::size_t, const jourdain_inputs*);

  static_assert(std::is_floating_point_v<Real>, "ensembles are of double or of float");
  static constexpr std::size_t most_steppers = 5;
  struct Steppers {
    std::array<const char*, most_steppers> names{};
    std::array<Run, most_steppers> runs{};
    std::size_t count = 0;

    template <class Stepper>
    void add(const char* name, const Stepper&) {
      using BlockModel = typename Many::BlockModel;
      if constexpr (std::is_invocable_v<const Stepper&, const BlockModel&, typename BlockModel::State&,
                                        const typename BlockModel::Input&, const typename Many::Number&>) {
        names[count] = name;
        runs[count++] = run_by<Stepper>;
      }
    }
  };

  /// Those that were emitted.
  static const Steppers& steppers() {
    static const Steppers all = [] {
      Steppers list;
      list.add("euler_step", euler);
      list.add("semi_implicit_euler_step", semi_implicit_euler);
      list.add("heun_step", heun);
      list.add("rk4_step", rk4);
      list.add("rk5_step", rk5);
      return list;
    }();
    return all;
  }

  // Emitted structs hold numbers alone; without any they are empty.
  template <class Numbers>
  static constexpr std::size_t numbers_of() {
    static_assert(std::is_trivially_copyable_v<Numbers>, "numbers alone");
    return std::is_empty_v<Numbers> ? 0 : sizeof(Numbers) / sizeof(Real);
  }
  template <class Numbers>
  static Numbers read([[maybe_unused]] const double* values) {
    Numbers result{};
    for (std::size_t i = 0; i < numbers_of<Numbers>(); ++i) {
      const Real value = static_cast<Real>(values[i]);
      std::memcpy(reinterpret_cast<char*>(&result) + i * sizeof(Real), &value, sizeof value);
    }
    return result;
  }
  /// As the model keeps them.
  static bool are_finite(const double* values, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const Real value = static_cast<Real>(values[i]);
      if (!(value - value == 0)) return false;
    }
    return true;
  }

  // Members that a state may lack: without positions, velocities or time.
  template <class S>
  static auto time_of(const S& state, int) -> decltype(static_cast<double>(static_cast<Real>(state.t))) {
    return static_cast<double>(static_cast<Real>(state.t));
  }
  template <class S>
  static double time_of(const S&, long) {
    return 0;
  }
  template <class S>
  static auto set_time(S& state, double t, int) -> decltype(void(state.t)) {
    state.t = static_cast<Real>(t);
  }
  template <class S>
  static void set_time(S&, double, long) {}
  template <class S, class Function>
  static auto on_positions(S& state, const Function& use, int) -> decltype(void(state.y)) {
    use(state.y);
  }
  template <class S, class Function>
  static void on_positions(S&, const Function&, long) {}
  template <class S, class Function>
  static auto on_velocities(S& state, const Function& use, int) -> decltype(void(state.z)) {
    use(state.z);
  }
  template <class S, class Function>
  static void on_velocities(S&, const Function&, long) {}
  template <class S>
  static auto has_time(const S& state, int) -> decltype(void(state.t), true) {
    return true;
  }
  template <class S>
  static bool has_time(const S&, long) {
    return false;
  }

  static constexpr std::size_t ny = static_cast<std::size_t>(Model::position_count);
  static constexpr std::size_t nz = static_cast<std::size_t>(Model::velocity_count);
  static constexpr std::size_t nu = static_cast<std::size_t>(Model::input_count);

  /// Whether there are such states, and where there are numbers an array of them.
  static bool is_wrong(const void* ensemble, std::size_t first, std::size_t count) {
    const auto* many = static_cast<const Many*>(ensemble);
    return !many || first > many->count() || count > many->count() - first;
  }
  static bool is_missing(const void* array, std::size_t numbers) { return !array && numbers > 0; }

  static void* create(std::size_t count, const double* parameters) {
    if (count == 0) return nullptr;
    if (parameters && !are_finite(parameters, numbers_of<Parameters>())) return nullptr;
    try {
      return parameters ? new Many(count, read<Parameters>(parameters)) : new Many(count);
    } catch (const std::exception&) {  // no memory
      return nullptr;
    }
  }
  static void destroy(void* ensemble) { delete static_cast<Many*>(ensemble); }

  static jourdain_status get_states(const void* ensemble, std::size_t first, std::size_t count, double* t,
                                    double* y, double* z) {
    if (is_wrong(ensemble, first, count) || is_missing(y, ny) || is_missing(z, nz))
      return JOURDAIN_WRONG_CALL;
    const Many& many = *static_cast<const Many*>(ensemble);
    for (std::size_t k = 0; k < count; ++k) {
      const State state = many.state(first + k);
      if (t)
        t[k] = time_of(state, 0);
      else if (has_time(state, 0))
        return JOURDAIN_WRONG_CALL;
      const auto write = [](double* to) {
        return [to](const auto& numbers) {
          std::size_t i = 0;
          for (const Real number : numbers) to[i++] = static_cast<double>(number);
        };
      };
      on_positions(state, write(y + k * ny), 0);
      on_velocities(state, write(z + k * nz), 0);
    }
    return JOURDAIN_OK;
  }

  static jourdain_status set_states(void* ensemble, std::size_t first, std::size_t count, const double* t,
                                    const double* y, const double* z) {
    if (is_wrong(ensemble, first, count) || is_missing(y, ny) || is_missing(z, nz))
      return JOURDAIN_WRONG_CALL;
    if (!t && has_time(State{}, 0)) return JOURDAIN_WRONG_CALL;
    if (t && has_time(State{}, 0) && !are_finite(t, count)) return JOURDAIN_NOT_FINITE;
    if (!are_finite(y, count * ny) || !are_finite(z, count * nz)) return JOURDAIN_NOT_FINITE;
    Many& many = *static_cast<Many*>(ensemble);
    for (std::size_t k = 0; k < count; ++k) {
      State state{};
      if (t) set_time(state, t[k], 0);
      const auto read_into = [](const double* from) {
        return [from](auto& numbers) {
          std::size_t i = 0;
          for (Real& number : numbers) number = static_cast<Real>(from[i++]);
        };
      };
      on_positions(state, read_into(y + k * ny), 0);
      on_velocities(state, read_into(z + k * nz), 0);
      many.set_state(first + k, state);
    }
    return JOURDAIN_OK;
  }

  static jourdain_status set_inputs(void* ensemble, std::size_t first, std::size_t count, const double* u) {
    if (is_wrong(ensemble, first, count) || is_missing(u, nu)) return JOURDAIN_WRONG_CALL;
    if (!are_finite(u, count * nu)) return JOURDAIN_NOT_FINITE;
    for (std::size_t k = 0; k < count; ++k)
      static_cast<Many*>(ensemble)->set_input(first + k, read<Input>(u + k * nu));
    return JOURDAIN_OK;
  }

  static jourdain_status set_parameters(void* ensemble, std::size_t first, std::size_t count,
                                        const double* parameters) {
    constexpr std::size_t numbers = numbers_of<Parameters>();
    if (is_wrong(ensemble, first, count) || is_missing(parameters, numbers)) return JOURDAIN_WRONG_CALL;
    if (!are_finite(parameters, count * numbers)) return JOURDAIN_NOT_FINITE;
    try {
      for (std::size_t k = 0; k < count; ++k)
        static_cast<Many*>(ensemble)->set_parameters(first + k, read<Parameters>(parameters + k * numbers));
    } catch (const std::bad_alloc&) {  // by the first of them
      return JOURDAIN_WRONG_CALL;
    }
    return JOURDAIN_OK;
  }

  template <class Stepper>
  static void run_by(Many& many, double h, std::size_t steps, std::size_t threads,
                     const jourdain_inputs* inputs) {
    if (!inputs || nu == 0) return many.run(Stepper{}, static_cast<Real>(h), steps, threads);
    many.run(Stepper{}, static_cast<Real>(h), steps, threads,
             [&](const typename Many::Block& block, std::size_t step) {
               if (inputs->by_step == 0 && step > 0) return;
               for (std::size_t lane = 0; lane < lanes; ++lane) {
                 const std::size_t k = std::min(block.first + lane, many.count() - 1);
                 const double* u = inputs->values + k * inputs->by_state + step * inputs->by_step;
                 set_lane(block.input, lane, u, 0);
               }
             });
  }
  template <class Inputs>
  static auto set_lane(Inputs& inputs, std::size_t lane, const double* values, int)
      -> decltype(void(inputs.u)) {
    std::size_t i = 0;
    for (auto& u : inputs.u) u.set(lane, static_cast<Real>(values[i++]));
  }
  template <class Inputs>
  static void set_lane(Inputs&, std::size_t, const double*, long) {}

  static bool are_finite(const jourdain_inputs& inputs, std::size_t states, std::size_t steps) {
    for (std::size_t k = 0; k < (inputs.by_state ? states : 1); ++k)
      for (std::size_t i = 0; i < (inputs.by_step ? steps : 1); ++i)
        if (!are_finite(inputs.values + k * inputs.by_state + i * inputs.by_step, nu)) return false;
    return true;
  }

  static jourdain_status run(void* ensemble, int stepper, double h, std::size_t steps, std::size_t threads,
                             const jourdain_inputs* inputs) {
    auto* many = static_cast<Many*>(ensemble);
    if (!many || stepper < 0 || static_cast<std::size_t>(stepper) >= steppers().count)
      return JOURDAIN_WRONG_CALL;
    if (inputs && is_missing(inputs->values, nu)) return JOURDAIN_WRONG_CALL;
    if (!are_finite(&h, 1) || (inputs && steps > 0 && !are_finite(*inputs, many->count(), steps)))
      return JOURDAIN_NOT_FINITE;
    if (h != 0 && static_cast<Real>(h) == 0) return JOURDAIN_WRONG_CALL;  // too short for the model's numbers
    try {
      steppers().runs[static_cast<std::size_t>(stepper)](*many, h, steps, threads, inputs);
    } catch (const std::bad_alloc&) {  // before the first step
      return JOURDAIN_WRONG_CALL;
    }
    return JOURDAIN_OK;
  }

  static jourdain_status get_trusted(const void* ensemble, std::size_t first, std::size_t count,
                                     unsigned char* trusted) {
    if (is_wrong(ensemble, first, count) || is_missing(trusted, count)) return JOURDAIN_WRONG_CALL;
    for (std::size_t k = 0; k < count; ++k)
      trusted[k] = static_cast<const Many*>(ensemble)->trusted(first + k) ? 1 : 0;
    return JOURDAIN_OK;
  }
};

}  // namespace

}  // namespace jourdain
