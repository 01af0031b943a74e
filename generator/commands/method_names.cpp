#include "commands/method_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "commands/memory_checks.hpp"
#include "programs/steppers.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

std::string check_method(const std::string& method) {
  if (programs::find_stepper(method)) return "";
  std::vector<std::string> names;
  for (const programs::Stepper& stepper : programs::all_steppers()) names.push_back(stepper.name);
  const std::string near = support::nearest(method, names);
  return near.empty() ? fmt::format("no method '{}'; there are {}", method, fmt::join(names, ", "))
                      : fmt::format("no method '{}'; did you mean '{}'?", method, near);
}

std::string check_derivative_terms(const std::vector<std::string>& functions,
                                   programs::DerivativeTerms terms) {
  if (terms == programs::DerivativeTerms::kAll) return "";
  for (const std::string& function : functions) {
    const programs::Stepper* stepper = programs::find_stepper(function.substr(0, function.rfind("_step")));
    if (stepper && stepper->order_with(false) == 0)
      return fmt::format("{} needs all derivatives; leave --derivatives applied out, or take rosw43",
                         stepper->name);
  }
  return "";
}

std::string check_steps(const std::vector<std::string>& functions, const LoadedMechanism& loaded) {
  if (std::string conflict = check_multistep(functions, loaded.mechanism); !conflict.empty()) return conflict;
  if (!loaded.plan() || loaded.plan()->carried().empty()) return "";
  for (const std::string& function : functions) {
    const programs::Stepper* stepper = programs::find_stepper(function.substr(0, function.rfind("_step")));
    if (stepper && stepper->order_with(false) == 0)
      return fmt::format(
          "{} needs the derivatives of velocities that follow from others in '{}', too: take rosw43, or "
          "treatment = \"multipliers\" in [loops]",
          stepper->name, loaded.mechanism.name);
  }
  return "";
}

std::vector<std::string> methods_for(programs::DerivativeTerms terms) {
  std::vector<std::string> names;
  for (const programs::Stepper& stepper : programs::all_steppers())
    if (check_derivative_terms({stepper.name}, terms).empty()) names.push_back(stepper.name);
  return names;
}

std::vector<std::string> default_methods(programs::DerivativeTerms terms, std::size_t velocities) {
  std::vector<std::string> methods = methods_for(terms);
  if (velocities <= kMostVelocities) return methods;
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [](const std::string& m) { return programs::find_stepper(m)->implicit; }),
                methods.end());
  fmt::print(stderr,
             "note: with more than {} velocities linearly implicit methods are left out, whose derivatives "
             "take long to "
             "compile; --methods asks for them\n",
             kMostVelocities);
  return methods;
}

}  // namespace jourdain::commands
