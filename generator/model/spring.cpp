#include "model/spring.hpp"

#include <fmt/format.h>

namespace jourdain::model {

std::vector<Expression*> Spring::expressions() {
  std::vector<Expression*> list = {&stiffness, &damping, &free_length, &law};
  if (potential) list.push_back(&*potential);
  return list;
}

std::string Spring::assumption() {
  return fmt::format(
      "a spring's length is sqrt(|dr|^2 + ({:g} m)^2), so that its direction is defined at zero length",
      kLengthSmoothing);
}

}  // namespace jourdain::model
