// Manual pages, as man reads them.
#pragma once

#include <vector>

#include "commands/command_text.hpp"
#include "support/files.hpp"

namespace jourdain::commands {

/// jourdain.1, and jourdain-COMMAND.1 for each command.
std::vector<support::FileText> manual_pages(const std::vector<CommandText>& commands);

}  // namespace jourdain::commands
