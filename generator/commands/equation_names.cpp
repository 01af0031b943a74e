#include "commands/equation_names.hpp"

#include <fmt/format.h>

#include "dynamics/harmonics.hpp"
#include "loops/record/loop_plan.hpp"
#include "model/coordinates.hpp"

namespace jourdain::commands {

std::string Spelling::operator()(const std::string& name) const {
  return latex_ ? dynamics::latex_name(name) : name;
}

std::string Spelling::unused(const std::string& wanted, const std::string& suffix) {
  std::string name = wanted;
  for (int i = 1; !take(name); ++i) name = wanted + suffix + (i == 1 ? "" : fmt::format("{}", i));
  return name;
}

namespace {

/// Of M, G, g and g_t as LaTeX has them; plain text has brackets.
void reserve_entries(Spelling& spelling, std::size_t velocities, std::size_t rows) {
  for (std::size_t i = 0; i < velocities; ++i) {
    for (std::size_t j = 0; j < velocities; ++j) spelling.reserve(fmt::format("M_{{{},{}}}", i, j));
    for (std::size_t r = 0; r < rows; ++r) spelling.reserve(fmt::format("G_{{{},{}}}", r, i));
  }
  for (std::size_t r = 0; r < rows; ++r) {
    spelling.reserve(fmt::format("g_{{{}}}", r));
    spelling.reserve(fmt::format("g_{{t,{}}}", r));
  }
}

}  // namespace

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
  if (latex) reserve_entries(names.spelling, layout.velocity_count(), loops::row_names(mechanism).size());
  std::vector<model::Parameter*> others;
  for (model::Parameter& parameter : names.mechanism.parameters)
    if (!names.spelling.take(parameter.name)) others.push_back(&parameter);
  for (model::Parameter* parameter : others) {
    const std::string printed = names.spelling.unused(parameter->name, "_p");
    names.changes.push_back({names.spelling(printed), parameter->name});
    parameter->name = printed;
  }
  return names;
}

}  // namespace jourdain::commands
