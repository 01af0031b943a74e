// The keys of a TOML description for editors: a JSON schema, as Taplo and "Even Better TOML" read it.
#pragma once

#include <string>

namespace jourdain::commands {

/// A schema (draft 4, which is what Taplo knows) of model::key_sections(). It knows tables, keys, words and numbers of
/// entries, and what each key means; what depends on other keys, on units or on names is the command's to say.
std::string model_schema();

}  // namespace jourdain::commands
