// What a roboticist asks of a model: links, joints, frames, what y, z and u consist of, parameters, outputs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "commands/load.hpp"

namespace jourdain::commands {

/// An object with a list for each kind of thing; words as in the emitted NAME.json. Numbers are those at the
/// parameters' default values; what they depend on is named beside them.
nlohmann::ordered_json model_facts(const LoadedMechanism& loaded, const CompiledModel& compiled);

/// The facts as tables, those without rows left out.
std::string facts_text(const nlohmann::ordered_json& facts);

}  // namespace jourdain::commands
