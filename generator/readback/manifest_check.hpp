// NAME.json against the model, the programs and what was counted.
#pragma once

#include <string>

#include "readback/expected.hpp"
#include "readback/findings.hpp"

namespace jourdain::readback {

/// Every key must be known and every number and name must be what the other files have; sentences are only read.
void check_manifest(const std::string& text, const Expected& expected, Findings& findings);

}  // namespace jourdain::readback
