// Inputs from a CSV file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "studies/inputs.hpp"
#include "support/diagnostics.hpp"

namespace jourdain::commands {

/// A header line "time,NAME,…" with any of the inputs' names in any order, then rows of numbers with rising
/// times (s). Between rows the values change linearly, outside them they stay; inputs without a column are
/// zero. Nothing after diagnostics.
std::unique_ptr<studies::Inputs> read_input_table(support::Diagnostics& diagnostics,
                                                  const std::vector<std::string>& input_names);

}  // namespace jourdain::commands
