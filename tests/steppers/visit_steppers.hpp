// All steppers of a model that was emitted with them.
#pragma once

/// Calls `visit(name, order, history, step)` for each stepper of the model's namespace but those of several steps,
/// `step(state, input, h, history)`; then runs what follows, which may use `remembering` for others.
#define JOURDAIN_VISIT_STEPPERS_AND(ns, Real, visit, ...)                                                    \
  do {                                                                                                       \
    int none = 0;                                                                                            \
    ::ns::Accelerations<Real> accelerations;                                                                 \
    const ::ns::Model<Real> model;                                                                           \
    const auto simple = [&](auto step) {                                                                     \
      return [&model, step](auto& state, const auto& input, Real h, int&) { step(model, state, input, h); }; \
    };                                                                                                       \
    const auto remembering = [&](auto step) {                                                                \
      return [&model, step](auto& state, const auto& input, Real h, auto& history) {                         \
        step(model, state, input, h, history);                                                               \
      };                                                                                                     \
    };                                                                                                       \
    visit("euler", 1, simple([](auto&... a) { ::ns::euler_step(a...); }), none);                             \
    visit("semi_implicit_euler", 1, simple([](auto&... a) { ::ns::semi_implicit_euler_step(a...); }), none); \
    visit("heun", 2, simple([](auto&... a) { ::ns::heun_step(a...); }), none);                               \
    visit("rk4", 4, simple([](auto&... a) { ::ns::rk4_step(a...); }), none);                                 \
    visit("rk5", 5, simple([](auto&... a) { ::ns::rk5_step(a...); }), none);                                 \
    visit("linearly_implicit_euler", 1,                                                                      \
          remembering([](auto&... a) { ::ns::linearly_implicit_euler_step(a...); }), accelerations);         \
    visit("ros34pw2", 3, remembering([](auto&... a) { ::ns::ros34pw2_step(a...); }), accelerations);         \
    visit("rosw43", 4, remembering([](auto&... a) { ::ns::rosw43_step(a...); }), accelerations);             \
    visit("rodas4", 4, remembering([](auto&... a) { ::ns::rodas4_step(a...); }), accelerations);             \
    __VA_ARGS__;                                                                                             \
  } while (false)

#define JOURDAIN_VISIT_ONE_STEP_METHODS(ns, Real, visit) JOURDAIN_VISIT_STEPPERS_AND(ns, Real, visit, )

/// All steppers.
#define JOURDAIN_VISIT_STEPPERS(ns, Real, visit)                                                           \
  JOURDAIN_VISIT_STEPPERS_AND(ns, Real, visit, {                                                           \
    ::ns::RateHistory<1, Real> one;                                                                        \
    ::ns::RateHistory<2, Real> two;                                                                        \
    visit("adams_bashforth2", 2, remembering([](auto&... a) { ::ns::adams_bashforth2_step(a...); }), one); \
    visit("adams_bashforth3", 3, remembering([](auto&... a) { ::ns::adams_bashforth3_step(a...); }), two); \
  })
