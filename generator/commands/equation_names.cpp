#include "commands/equation_names.hpp"

#include <fmt/format.h>

#include "dynamics/harmonics.hpp"
#include "model/coordinates.hpp"

namespace jourdain::commands {

std::string Spelling::operator()(const std::string& name) const {
  return latex_ ? dynamics::latex_name(name) : name;
}

std::string Spelling::unused(const std::string& wanted, const std::string& suffix) {
  std::string name = wanted;
  for (int i = 1; !taken_.insert((*this)(name)).second; ++i)
    name = wanted + suffix + (i == 1 ? "" : fmt::format("{}", i));
  return name;
}

PrintedNames printed_names(const model::Mechanism& mechanism, bool latex) {
  PrintedNames names{mechanism, Spelling(latex), {}};
  const model::CoordinateLayout layout = model::lay_out_coordinates(mechanism);
  const auto reserve = [&names](const char* letter, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      names.spelling.reserve(names.spelling(fmt::format("{}{}", letter, i)));
  };
  reserve("y", layout.position_count());
  reserve("z", layout.velocity_count());
  reserve("u", layout.input_count());
  names.spelling.reserve("t");
  for (model::Parameter& parameter : names.mechanism.parameters) {
    const std::string printed = names.spelling.unused(parameter.name, "_p");
    if (printed != parameter.name) names.changes.push_back({names.spelling(printed), parameter.name});
    parameter.name = printed;
  }
  return names;
}

}  // namespace jourdain::commands
