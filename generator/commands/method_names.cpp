#include "commands/method_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "emit/steppers.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

std::string check_method(const std::string& method) {
  if (emit::find_stepper(method)) return "";
  std::vector<std::string> names;
  for (const emit::Stepper& stepper : emit::all_steppers()) names.push_back(stepper.name);
  const std::string near = support::nearest(method, names);
  return near.empty() ? fmt::format("no method '{}'; there are {}", method, fmt::join(names, ", "))
                      : fmt::format("no method '{}'; did you mean '{}'?", method, near);
}

}  // namespace jourdain::commands
