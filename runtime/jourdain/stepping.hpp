// SPDX-License-Identifier: MIT
// Emitted steppers as objects, and how what they end in is judged: what ensembles of all kinds have in common.
#pragma once

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "ensembles look for numbers that are not finite: no -ffast-math, -Ofast, -ffinite-math-only"
#endif

#include <type_traits>
#include <utility>

#ifndef JOURDAIN_FUNCTION
#define JOURDAIN_FUNCTION
#endif

namespace jourdain {

/// What lives as long as a step of several stages by such numbers, made of model, state, input and the stages' number;
/// void: nothing.
template <class Real>
struct StagesOf {
  using Type = void;
};

// Steppers of emitted code, for `run` of an ensemble. They can be called where the model has theirs.
#define JOURDAIN_STEPPER(name, function, count)                                                      \
  struct name##_stepper {                                                                            \
    static constexpr int stages = count;                                                             \
    template <class Model, class State, class Input, class Real>                                     \
    JOURDAIN_FUNCTION auto operator()(const Model& m, State& s, const Input& u, const Real& h) const \
        -> decltype(function(m, s, u, h)) {                                                          \
      using Stages = typename StagesOf<Real>::Type;                                                  \
      if constexpr (std::is_void_v<Stages> || stages == 1) {                                         \
        function(m, s, u, h);                                                                        \
      } else {                                                                                       \
        Stages of_step(m, s, u, stages);                                                             \
        function(m, s, u, h);                                                                        \
      }                                                                                              \
    }                                                                                                \
  };                                                                                                 \
  inline constexpr name##_stepper name {}
JOURDAIN_STEPPER(euler, euler_step, 1);
JOURDAIN_STEPPER(semi_implicit_euler, semi_implicit_euler_step, 1);
JOURDAIN_STEPPER(heun, heun_step, 2);
JOURDAIN_STEPPER(rk4, rk4_step, 4);
JOURDAIN_STEPPER(rk5, rk5_step, 6);
#undef JOURDAIN_STEPPER

namespace detail {

template <class Model>
auto is_proven(const typename Model::Parameters& parameters, int)
    -> decltype(bool(Model::loops_proven(parameters))) {
  return Model::loops_proven(parameters);
}
template <class Model>
bool is_proven(const typename Model::Parameters&, long) {
  return true;
}

template <class Model, class = void>
struct HasLoops : std::false_type {};
template <class Model>
struct HasLoops<Model, decltype(void(Model::loops_closed(std::declval<const typename Model::State&>())))>
    : std::true_type {};

// Differences of numbers with themselves; structs have no arrays of length zero.
template <class State, class Number>
JOURDAIN_FUNCTION auto add_positions(const State& state, Number& sum, int) -> decltype(void(state.y)) {
  for (const Number& y : state.y) sum = sum + (y - y);
}
template <class State, class Number>
JOURDAIN_FUNCTION void add_positions(const State&, Number&, long) {}
template <class State, class Number>
JOURDAIN_FUNCTION auto add_velocities(const State& state, Number& sum, int) -> decltype(void(state.z)) {
  for (const Number& z : state.z) sum = sum + (z - z);
}
template <class State, class Number>
JOURDAIN_FUNCTION void add_velocities(const State&, Number&, long) {}

/// Stays zero where all numbers that are added are finite.
template <class State, class Number>
JOURDAIN_FUNCTION void add_nothing(const State& state, Number& sum) {
  add_positions(state, sum, 0);
  add_velocities(state, sum, 0);
}

/// A model of these parameters that calls its user's functions with the data that `model` has.
template <class Model, class Parameters, class = typename Model::Functions>
JOURDAIN_FUNCTION Model with_parameters(const Model& model, const Parameters& parameters, int) {
  Model result(parameters);
  result.functions = model.functions;
  return result;
}
template <class Model, class Parameters>
JOURDAIN_FUNCTION Model with_parameters(const Model&, const Parameters& parameters, long) {
  return Model(parameters);
}

}  // namespace detail
}  // namespace jourdain
