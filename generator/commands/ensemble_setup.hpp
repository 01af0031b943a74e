// What an ensemble of a model is called: its columns, and what decides its numbers.
#pragma once

#include <string>
#include <vector>

#include "commands/ensemble_result.hpp"
#include "commands/ensemble_run.hpp"
#include "commands/run_setup.hpp"
#include "commands/signals.hpp"
#include "commands/spreads.hpp"

namespace jourdain::commands {

/// Of what was drawn and of the ends. What is called like an earlier one, or like the states and the flags of rows,
/// gets an ending.
std::vector<EnsembleColumn> columns_of(const RunModel& model, const Signals& signals,
                                       const std::vector<Spread>& spreads);

/// All but the steps, the number of states, the accuracy and the program. `words` are the spreads as given. Throws
/// EnvironmentError where the compiler does not say its version.
EnsembleFacts facts_of(const RunModel& model, const CompiledModel& compiled, const EnsembleChoices& choices,
                       const std::vector<std::string>& words);

}  // namespace jourdain::commands
