#include "ir/function_id.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "support/enumerators.hpp"

namespace jourdain::ir {

namespace {

/// In the order of FunctionId.
constexpr std::array kNames = {"initial_state",
                               "position_rate",
                               "mass_matrix",
                               "k_bar",
                               "q_bar",
                               "forward_dynamics",
                               "inverse_dynamics",
                               "kinetic_energy",
                               "potential_energy",
                               "outputs",
                               "close_loops",
                               "project",
                               "constraint_residual",
                               "constraint_forces",
                               "residual",
                               "residual_derivatives",
                               "forward_dynamics_derivatives",
                               "linearize",
                               "sample"};
static_assert(kNames.size() == support::entry_count<FunctionId>());

}  // namespace

const char* name_of(FunctionId function) { return kNames[static_cast<std::size_t>(function)]; }

std::optional<FunctionId> function_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return {};
  return static_cast<FunctionId>(std::distance(kNames.begin(), found));
}

}  // namespace jourdain::ir
