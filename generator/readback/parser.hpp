// Reads the subset of C++ that models are written in, knowing C++'s grammar and nothing of how they were written.
#pragma once

#include "readback/syntax.hpp"
#include "readback/tokens.hpp"
#include "support/files.hpp"

namespace jourdain::readback {

/// Reads the files in order into `unit`; `packs`: their numbers may be customized. Throws Refusal at what is not
/// understood. The texts must outlive the unit.
void parse(Unit& unit, const std::vector<const support::FileText*>& files, bool packs = false);

}  // namespace jourdain::readback
