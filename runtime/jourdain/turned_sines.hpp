// SPDX-License-Identifier: MIT
// Ensembles whose steps compute sines once and turn them:
//
//     #include <jourdain/turned_sines.hpp>
//
//     using jourdain::TurnedSines;
//     jourdain::Ensemble<panda::Model, double, jourdain::natural_lanes<double>, TurnedSines> ensemble(10000);
//     ensemble.run(jourdain::rk4, 1e-3, 500);
//
// The first stage of a step computes the sine and the cosine of each angle. The stages after it turn them by what the
// angle has changed, d, where that is at most 1/8 rad:
//
//     sin(a + d) = sin a + (sin a (cos d - 1) + cos a sin d),
//
// with polynomials up to d^9 and d^8 in double, d^5 and d^4 in float: Taylor's for sin d, for cos d - 1 those that meet
// it at the zeros of Chebyshev's, good to 2e-18 and 7e-10. They are at most 1.6e-16 off, 7.2e-8 in float: absolute, of
// 4e7 angles. Lanes that change by more have theirs computed. So results differ from those of other ensembles by
// rounding, and still depend neither on the number of threads nor on what lies beside a state.
#pragma once

#include <cstddef>
#include <utility>

#include "pack.hpp"
#include "stepping.hpp"

namespace jourdain {

namespace detail {

template <class Number, class Model, class State>
auto ask_position_rate(const Model& model, const State& state, int)
    -> decltype(void(position_rate(model, state, std::declval<Number (&)[Model::position_count]>()))) {
  Number rates[Model::position_count];
  position_rate(model, state, rates);
}
template <class Number, class Model, class State>
void ask_position_rate(const Model&, const State&, long) {}

template <class Number, class Model, class State, class Input>
auto ask_accelerations(const Model& model, const State& state, const Input& input, int)
    -> decltype(void(forward_dynamics(model, state, input,
                                      std::declval<Number (&)[Model::velocity_count]>()))) {
  Number rates[Model::velocity_count];
  forward_dynamics(model, state, input, rates);
}
template <class Number, class Model, class State, class Input>
void ask_accelerations(const Model&, const State&, const Input&, long) {}

}  // namespace detail

/// Of packs and ensembles whose steps turn sines: heun, rk4 and rk5 of the namespace. All else computes them.
struct TurnedSines {
  /// Angles of a stage that are kept; those of others are computed.
  static constexpr std::size_t most = 64;

  /// The sines of a step of a block, while it is made.
  template <class Number>
  class Stages {
   public:
    using Vector = typename Number::Vector;

    /// Of a step that asks for `angles` at each of its stages, always in one order.
    Stages(std::size_t angles, int stages) noexcept
        : angles_(angles), stages_(stages), outer_(current<Number>) {
      current<Number> = this;
    }
    /// Of an emitted step, which asks for rates at each stage.
    template <class Model, class State, class Input>
    Stages(const Model& model, const State& state, const Input& input, int stages) noexcept
        : Stages(angles_of_rates(model, state, input), stages) {}
    ~Stages() { current<Number> = outer_; }
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

    /// Of the next angle of this stage.
    JOURDAIN_PACK_FUNCTION void take(const Vector& x, Vector& s, Vector& c) noexcept {
      const std::size_t i = next_++;
      const int stage = stage_;
      if (next_ == angles_) {
        next_ = 0;
        ++stage_;
      }
      if (stage > 0 && stage < stages_ && i < most) {
        turn(x, i, s, c);
        return;
      }
      Number::compute_sines(x, s, c);
      if (stage > 0 || i >= most) return;
      kept_[i] = {x, s, c};
    }

   private:
    struct Kept {
      Vector angle, sine, cosine;
    };

    /// As many for all states and parameters: emitted functions have no branches. Hidden: libraries with models of one
    /// name have each its own.
    template <class Model, class State, class Input>
    __attribute__((visibility("hidden"))) static std::size_t angles_of_rates(const Model& model,
                                                                             const State& state,
                                                                             const Input& input) noexcept {
      static const std::size_t count = [&] {
        Stages counting(0, 1);
        detail::ask_position_rate<Number>(model, state, 0);
        detail::ask_accelerations<Number>(model, state, input, 0);
        return counting.next_;
      }();
      return count;
    }

    JOURDAIN_PACK_FUNCTION void turn(const Vector& x, std::size_t i, Vector& s, Vector& c) const noexcept;
    static void compute_far(const Vector& x, const Vector& squares, Vector& s, Vector& c) noexcept;

    std::size_t angles_, next_ = 0;
    int stages_, stage_ = 0;
    Stages* outer_;
    Kept kept_[most];
  };

  template <class Number>
  inline static thread_local Stages<Number>* current = nullptr;

  template <class Number>
  JOURDAIN_PACK_FUNCTION static void take(const typename Number::Vector& x, typename Number::Vector& s,
                                          typename Number::Vector& c) noexcept {
    if (Stages<Number>* const stages = current<Number>)
      stages->take(x, s, c);
    else
      Number::compute_sines(x, s, c);
  }
};

template <class Number>
JOURDAIN_PACK_FUNCTION inline void TurnedSines::Stages<Number>::turn(const Vector& x, std::size_t i,
                                                                     Vector& s, Vector& c) const noexcept {
#if defined(__clang__)
#pragma clang fp reassociate(off)
#endif
  using Real = typename Number::value_type;
  const auto number = [](double value) { return static_cast<Real>(value); };
  const Kept& kept = kept_[i];
  const Vector d = x - kept.angle, z = d * d, sine = kept.sine, cosine = kept.cosine;
  Vector cubic, change;  // (sin d - d) / d^3, cos d - 1
  if constexpr (sizeof(Real) == 8) {
    const Vector y = z * z;
    cubic = (-1.0 / 6 + z * (1.0 / 120)) + y * (-1.0 / 5040 + z * (1.0 / 362880));
    change = z * ((-0.4999999999999999 + z * 0.04166666666640392) +
                  y * (-0.0013888888048085412 + z * 2.4792977040825343e-05));
  } else {
    cubic = number(-1.0 / 6) + z * number(1.0 / 120);
    change = z * (number(-0.49999995762629934) + z * number(0.04164497057518008));
  }
  const Vector turned = d + d * z * cubic;
  s = sine + (sine * change + cosine * turned);
  c = cosine + (cosine * change - sine * turned);
  if (__builtin_expect(!detail::are_at_most<Real, Number::size>(z, number(1.0 / 64)), 0)) {
    const Vector far = x, squares = z;
    Vector sines = s, cosines = c;
    compute_far(far, squares, sines, cosines);
    s = sines;
    c = cosines;
  }
}

/// Of the lanes whose angle has changed by more, or is no number.
template <class Number>
__attribute__((noinline, cold)) void TurnedSines::Stages<Number>::compute_far(const Vector& x,
                                                                              const Vector& squares,
                                                                              Vector& s, Vector& c) noexcept {
  using Bits = typename Number::BitVector;
  Vector sines, cosines;
  Number::compute_sines(x, sines, cosines);
  const Bits near = (Bits)(squares <= static_cast<typename Number::value_type>(1.0 / 64));
  s = (Vector)(((Bits)s & near) | ((Bits)sines & ~near));
  c = (Vector)(((Bits)c & near) | ((Bits)cosines & ~near));
}

template <class Real, std::size_t lanes>
struct StagesOf<Pack<Real, lanes, TurnedSines>> {
  using Type = TurnedSines::Stages<Pack<Real, lanes, TurnedSines>>;
};

}  // namespace jourdain
