#include "programs/steppers.hpp"

namespace jourdain::programs {

namespace {

Stepper implicit(const char* name, int order, int stages, const char* comment, int reduced_order) {
  Stepper stepper;
  stepper.name = name;
  stepper.order = order;
  stepper.evaluations = stages;
  stepper.comment = comment;
  stepper.implicit = true;
  stepper.reduced_order = reduced_order;
  return stepper;
}

}  // namespace

const std::vector<Stepper>& all_steppers() {
  static const std::vector<Stepper> steppers = {
      {"euler", 1, 1, 0, {}, "explicit Euler method of order 1"},
      {"semi_implicit_euler",
       1,
       1,
       0,
       {},
       "semi-implicit Euler method of order 1: velocities first, positions with the new velocities"},
      {"heun", 2, 2, 0, {}, "Heun method (explicit trapezoidal rule) of order 2"},
      {"rk4", 4, 4, 0, {}, "classical Runge-Kutta method of order 4"},
      {"rk5", 5, 6, 0, {}, "Runge-Kutta method of order 5 by Dormand and Prince, six stages"},
      {"adams_bashforth2",
       2,
       1,
       1,
       {"rk4"},
       "Adams-Bashforth method of order 2; the first step is one of rk4_step"},
      {"adams_bashforth3",
       3,
       1,
       2,
       {"rk4"},
       "Adams-Bashforth method of order 3; the first two steps are those of rk4_step"},
      implicit("linearly_implicit_euler", 1, 1, "linearly implicit Euler method of order 1, L-stable", 1),
      implicit("ros34pw2", 3, 4, "W-method ROS34PW2 of order 3 by Rang and Angermann, L-stable", 3),
      implicit("rosw43", 4, 5, "Rosenbrock method of order 4 (W-method of order 3), L-stable", 3),
      implicit("rodas4", 4, 6, "Rosenbrock method RODAS of order 4 by Hairer and Wanner, L-stable", 0),
  };
  return steppers;
}

const Stepper* find_stepper(const std::string& name) {
  for (const Stepper& stepper : all_steppers())
    if (stepper.name == name) return &stepper;
  return nullptr;
}

}  // namespace jourdain::programs
