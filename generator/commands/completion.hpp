// Completion of commands, options and their words for shells.
#pragma once

#include <string>
#include <vector>

#include "commands/command_text.hpp"

namespace jourdain::commands {

/// To be sourced by bash, or put where bash-completion looks.
std::string bash_completion(const std::vector<CommandText>& commands);

/// A function of zsh's completion system, `_jourdain`.
std::string zsh_completion(const std::vector<CommandText>& commands);

}  // namespace jourdain::commands
