// States of ensembles that each start and are driven in their own way, and what they have to become.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "jourdain/draws.hpp"
#include "jourdain/stepping.hpp"

namespace jourdain::tests {

inline constexpr std::size_t kCount = 11;  // no multiple of any number of lanes
inline constexpr double kStep = 1e-3;

/// How far numbers of states may be apart, as a share of 1 + their size.
inline constexpr double kNone = 0, kRoundedSines = 1e-5;

template <class State>
double difference(const State& a, const State& b) {
  double worst = 0;
  const auto compare = [&worst](double x, double y) {
    const double apart = std::fabs(x - y) / (1 + std::fabs(y));
    if (!(apart <= worst)) worst = apart;
  };
  for (std::size_t i = 0; i < std::size(a.y); ++i) compare(double(a.y[i]), double(b.y[i]));
  for (std::size_t i = 0; i < std::size(a.z); ++i) compare(double(a.z[i]), double(b.z[i]));
  return worst;
}

/// State k and its inputs, each its own.
template <class Ensemble>
typename Ensemble::State start(const typename Ensemble::Model& model, std::size_t k) {
  auto state = initial_state(model);
  std::uint64_t number = 0;
  for (auto& z : state.z) z += static_cast<std::decay_t<decltype(z)>>(0.3 * normal(1, k, number++));
  return state;
}
template <class Ensemble>
typename Ensemble::Input input(std::size_t k) {
  typename Ensemble::Input input{};
  if constexpr (Ensemble::Model::input_count > 0) {
    std::uint64_t number = 0;
    for (auto& u : input.u) u = static_cast<std::decay_t<decltype(u)>>(normal(2, k, number++));
  }
  return input;
}

template <class Ensemble>
Ensemble started() {
  Ensemble ensemble(kCount);
  const typename Ensemble::Model model;
  for (std::size_t k = 0; k < kCount; ++k) {
    ensemble.set_state(k, start<Ensemble>(model, k));
    ensemble.set_input(k, input<Ensemble>(k));
  }
  return ensemble;
}

/// Each state of an ensemble against itself, stepped alone.
template <class Many>
void expect_scalars(double tolerance) {
  using Real = typename Many::Model::Scalar;
  Many ensemble = started<Many>();
  ensemble.run(rk4, static_cast<Real>(kStep), 60);
  const typename Many::Model model;
  for (std::size_t k = 0; k < kCount; ++k) {
    auto state = start<Many>(model, k);
    const auto begin = state;
    for (int i = 0; i < 60; ++i) rk4_step(model, state, input<Many>(k), static_cast<Real>(kStep));
    EXPECT_GT(difference(begin, state), 1e-6) << k;
    EXPECT_LE(difference(ensemble.state(k), state), tolerance) << k;
    EXPECT_TRUE(ensemble.trusted(k)) << k;
  }
  EXPECT_EQ(ensemble.untrusted_count(), 0u);
}

/// States of which `k` starts otherwise: it alone must not be trusted, and nothing else moves.
template <class Many, class Spoil>
void expect_untrusted(std::size_t k, const Spoil& spoil) {
  Many ensemble = started<Many>(), intact = started<Many>();
  auto spoiled = ensemble.state(k);
  spoil(spoiled);
  ensemble.set_state(k, spoiled);
  ensemble.run(rk4, kStep, 5);
  intact.run(rk4, kStep, 5);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(ensemble.trusted(i), i != k) << i;
    if (i != k) {
      EXPECT_EQ(difference(ensemble.state(i), intact.state(i)), 0) << i;
    }
  }
  EXPECT_EQ(ensemble.untrusted_count(), 1u);
  ensemble.set_state(k, intact.state(k));
  EXPECT_EQ(ensemble.untrusted_count(), 0u);
}

/// The first state, one between and the last, of a model of three coordinates or more.
template <class Many>
void expect_no_numbers_untrusted() {
  using State = typename Many::State;
  for (const std::size_t k : {std::size_t(0), std::size_t(5), kCount - 1}) {
    expect_untrusted<Many>(k, [](State& state) { state.y[2] = std::numeric_limits<double>::quiet_NaN(); });
    expect_untrusted<Many>(k, [](State& state) { state.z[1] = std::numeric_limits<double>::infinity(); });
    expect_untrusted<Many>(k, [](State& state) { state.z[1] = 1e200; });
  }
}

}  // namespace jourdain::tests
