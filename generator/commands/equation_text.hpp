// The equations of motion for people to read.
#pragma once

#include <string>

#include "model/mechanism.hpp"

namespace jourdain::commands {

/// M, k̄ and q̄ with named intermediates, and expanded for up to three coordinates; text or LaTeX. The same bytes on
/// every run.
std::string equations_text(const model::Mechanism& mechanism, bool latex);

}  // namespace jourdain::commands
