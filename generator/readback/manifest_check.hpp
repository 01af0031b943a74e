// NAME.json against the model, the programs and what was counted.
#pragma once

#include <string>

#include "readback/expected.hpp"
#include "readback/findings.hpp"

namespace jourdain::readback {

/// Every key must be known and every number, name and sentence must be what the model and the other files have.
void check_manifest(const std::string& text, const Expected& expected, Findings& findings);

}  // namespace jourdain::readback
